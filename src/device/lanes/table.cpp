// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "device/lanes/table.hpp"

#include <vector>

namespace vsa::device {

LaneTable lanes_of_any() noexcept;
#if defined(VSA_LANES_X86)
LaneTable lanes_of_avx2() noexcept;
LaneTable lanes_of_avx512() noexcept;
#endif

std::span<const LaneTable> lane_tables() {
  static const std::vector<LaneTable> tables = [] {
    std::vector<LaneTable> found;
#if defined(VSA_LANES_X86)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      found.push_back(lanes_of_avx512());
    if (__builtin_cpu_supports("avx2")) found.push_back(lanes_of_avx2());
#endif
    found.push_back(lanes_of_any());
    return found;
  }();
  return tables;
}

}  // namespace vsa::device
