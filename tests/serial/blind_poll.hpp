// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace vsa::serial::test {

/// So many times yet a port is told that nobody has hung up, as the system does while a client's closing is under way.
extern std::atomic<int> blind_polls;

}  // namespace vsa::serial::test
