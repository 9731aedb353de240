// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace vsa {

/// Of sorted numbers, interpolated between two of them; order 0 … 1. NaN of none.
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double order) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = order * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

}  // namespace vsa
