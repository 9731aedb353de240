// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "device/lanes/table.hpp"

#include <string>
#include <vector>

#include "vsa/errors.hpp"

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

const LaneTable& lane_table(std::string_view instructions) {
  std::string here;
  for (const LaneTable& table : lane_tables()) {
    if (instructions.empty() || instructions == table.name) return table;
    here += std::string(here.empty() ? "" : ", ") + table.name;
  }
  throw InputError({"", "instructions", std::string(instructions), "this machine doesn't have them", here});
}

}  // namespace vsa::device
