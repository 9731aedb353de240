// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "study/series.hpp"

#include <cmath>

#include "vsa/errors.hpp"

namespace vsa::study {

using experiment::TimeSeries;

TimeSeries cut(const TimeSeries& s, double from_s, double span_s) {
  TimeSeries out;
  for (std::size_t i = 0; i < s.time_s.size(); ++i) {
    const double t = s.time_s[i] - from_s;
    if (t < 0 || t > span_s || (!out.time_s.empty() && t <= out.time_s.back())) continue;
    out.time_s.push_back(t);
    out.value.push_back(s.value[i]);
  }
  return out;
}

double edge_s(const TimeSeries& reference, std::size_t n) {
  constexpr double kJump = 0.3;
  for (std::size_t i = 1; i < reference.value.size(); ++i) {
    if (std::abs(reference.value[i] - reference.value[i - 1]) < kJump) continue;
    if (n-- == 0) return 0.5 * (reference.time_s[i] + reference.time_s[i - 1]);
  }
  throw InputError({"data/plugin_2015", "reference", "", "has too few steps", "one, and two of the preset"});
}

}  // namespace vsa::study
