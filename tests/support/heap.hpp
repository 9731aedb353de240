// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whether a host's memory grows.
#pragma once

#include <vector>

namespace vsa::test {

/// What this process has allocated and not freed (malloc_info), all threads together. What is resident tells less: in the first
/// minute a leak goes into what the host's start has freed.
[[nodiscard]] long heap_in_use_kB();

/// The median of what each part of a run added to the heap of the part before. What leaks grows all the time; what a host takes
/// once, it takes whenever its threads come to it (Gazebo Classic 5 MB at once).
[[nodiscard]] long usual_growth(const std::vector<long>& kB);

/// What may grow in a part of so many steps: half of malloc's smallest block a step. Gazebo Classic takes up to 8 kB whenever it is
/// told to run, however long.
[[nodiscard]] constexpr long may_grow_kB(long steps) { return steps * 16 / 1000; }

}  // namespace vsa::test
