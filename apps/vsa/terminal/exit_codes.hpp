// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::app {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;       ///< a blow-up, a full disk, nobody answers
inline constexpr int kBadInput = 2;     ///< usage, files, names, values
inline constexpr int kSignalled = 128;  ///< + the signal's number: it cut short what had an end

}  // namespace vsa::app
