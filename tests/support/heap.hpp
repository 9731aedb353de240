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

/// What a host may take in so many steps for reasons of its own (Gazebo Classic with ODE: 1.6 bytes a step): half of malloc's
/// smallest block a step.
[[nodiscard]] constexpr long may_grow_kB(long steps) { return steps * 16 / 1000; }

}  // namespace vsa::test
