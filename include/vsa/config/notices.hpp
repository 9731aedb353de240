// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Old spellings, as they are met: in a type's file, a robot's element, the environment, a data directory. Libraries of types are made
// in many places, some deep within a study or a sweep, so a program hears of them here, in one.
#pragma once

#include <functional>
#include <string>

namespace vsa::config {

/// Called with a notice each time that an old spelling is met, so several times with the same one, and by whichever thread met it;
/// it doesn't throw.
using NoticeListener = std::function<void(const std::string&)>;

/// One listener for the whole process, in the place of the last one; empty: nobody listens, as at the start.
void listen_to_notices(NoticeListener listener);

}  // namespace vsa::config
