// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace vsa {

/// Places of equal keys together, in the order in which each key comes first: of {7, 2, 7} {0, 2} and {1}. Of joints by the root of
/// their tree: those that move each other.
[[nodiscard]] inline std::vector<std::vector<std::size_t>> grouped(std::span<const int> keys) {
  std::vector<int> seen;
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto at = std::find(seen.begin(), seen.end(), keys[i]);
    if (at == seen.end()) {
      seen.push_back(keys[i]);
      out.push_back({i});
    } else {
      out[static_cast<std::size_t>(at - seen.begin())].push_back(i);
    }
  }
  return out;
}

}  // namespace vsa
