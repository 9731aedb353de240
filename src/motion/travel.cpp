// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/motion/travel.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::motion {
namespace {

double distance(const std::array<double, 2>& a, const std::array<double, 2>& b) noexcept {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

}  // namespace

Travel::Travel(double window_s, double sample_s)
    : window_(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(window_s / sample_s)))) {}

void Travel::add(const std::array<double, 3>& center_of_mass) {
  const Point now{center_of_mass[0], center_of_mass[1]};
  if (ring_.size() < window_) {
    ring_.push_back(now);
    if (ring_.size() == window_) first_ = last_ = mean();
    return;
  }
  ring_[next_] = now;
  next_ = (next_ + 1) % window_;
  const Point smooth = mean();
  path_ += distance(last_, smooth);
  last_ = smooth;
}

void Travel::restart() {
  ring_.clear();
  next_ = 0;
  path_ = 0;
  first_ = last_ = {};
}

double Travel::net_m() const noexcept { return distance(first_, last_); }

Travel::Point Travel::mean() const noexcept {
  Point sum{};
  for (const Point& p : ring_) sum = {sum[0] + p[0], sum[1] + p[1]};
  const auto n = static_cast<double>(ring_.size());
  return {sum[0] / n, sum[1] / n};
}

}  // namespace vsa::motion
