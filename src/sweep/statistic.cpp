// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vsa/not_a_number.hpp"
#include "vsa/quantile.hpp"
#include "vsa/sweep/measure.hpp"

namespace vsa::sweep {

const std::vector<std::string>& statistic_names() {
  static const std::vector<std::string> names{"last",  "first", "mean", "min",      "max",      "peak",
                                              "range", "rms",   "std",  "integral", "quantile", "settle_s"};
  return names;
}

Statistic::Statistic(const Measure& measure) : band_(measure.band), order_(measure.order) {
  const auto& names = statistic_names();
  const auto at = std::find(names.begin(), names.end(), measure.statistic);
  if (at == names.end()) throw std::logic_error("no statistic: " + measure.statistic);
  kind_ = static_cast<Kind>(at - names.begin());
}

void Statistic::add(double time_s, double value) {
  if (count_ == 0) {
    first_ = value;
    first_s_ = time_s;
  } else {
    integral_ += 0.5 * (last_ + value) * (time_s - last_s_);
  }
  ++count_;
  last_ = value;
  last_s_ = time_s;
  sum_ += value;
  // Welford's, which loses nothing where the mean is large.
  const double apart = value - mean_;
  mean_ += apart / static_cast<double>(count_);
  squares_ += apart * (value - mean_);
  min_ = std::min(min_, value);
  max_ = std::max(max_, value);
  whole_ = whole_ && !std::isnan(value);
  if (kind_ == Kind::quantile || kind_ == Kind::settle) {
    times_.push_back(time_s);
    values_.push_back(value);
  }
}

double Statistic::value() const {
  const bool ends = kind_ == Kind::first || kind_ == Kind::last;
  if (count_ == 0 || (!whole_ && !ends)) return kNaN;
  const auto n = static_cast<double>(count_);
  switch (kind_) {
    case Kind::last:
      return last_;
    case Kind::first:
      return first_;
    case Kind::mean:
      return sum_ / n;
    case Kind::min:
      return min_;
    case Kind::max:
      return max_;
    case Kind::peak:
      return std::max(std::abs(min_), std::abs(max_));
    case Kind::range:
      return max_ - min_;
    case Kind::rms:
      return std::sqrt(squares_ / n + mean_ * mean_);
    case Kind::std:
      return std::sqrt(squares_ / n);
    case Kind::integral:
      return integral_;
    case Kind::quantile: {
      std::vector<double> sorted = values_;
      std::sort(sorted.begin(), sorted.end());
      return quantile(sorted, order_);
    }
    case Kind::settle:
      return settled();
  }
  return kNaN;
}

/// From the first sample until the value stays within the band.
double Statistic::settled() const {
  const std::size_t tenth = std::max<std::size_t>(1, values_.size() / 10);
  double rest = 0;
  for (std::size_t i = values_.size() - tenth; i < values_.size(); ++i) rest += values_[i] / static_cast<double>(tenth);
  for (std::size_t i = values_.size(); i > 0; --i) {
    if (std::abs(values_[i - 1] - rest) <= band_) continue;
    return i == values_.size() ? std::numeric_limits<double>::quiet_NaN() : times_[i] - first_s_;
  }
  return 0;
}

}  // namespace vsa::sweep
