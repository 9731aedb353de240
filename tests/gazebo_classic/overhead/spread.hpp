// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace vsa::test {

struct Spread {
  double lower = 0, median = 0, upper = 0;
};

inline Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {at(0.25), at(0.5), at(0.75)};
}

inline std::string text(const Spread& s) {
  std::ostringstream out;
  out.precision(3);
  out << s.median << " (" << s.lower << "–" << s.upper << ")";
  return out.str();
}

}  // namespace vsa::test
