// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How far a robot went, without its wriggling. The centre of mass, projected on the ground, is averaged over the last gait period
//     c̄(t) = mean of c over (t − T, t],    path = Σ |c̄(t_k) − c̄(t_{k−1})|,    net = |c̄(end) − c̄(first)|
// so that what a cycle swings to and fro doesn't count. Nothing counts until the first period is full.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace vsa::app {

class Travel {
 public:
  Travel(double window_s, double sample_s)
      : window_(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(window_s / sample_s)))) {}

  void add(const std::array<double, 3>& center_of_mass) {
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

  void restart() {
    ring_.clear();
    next_ = 0;
    path_ = 0;
    first_ = last_ = {};
  }

  [[nodiscard]] bool measured() const noexcept { return ring_.size() == window_; }
  [[nodiscard]] double path_m() const noexcept { return path_; }
  [[nodiscard]] double net_m() const noexcept { return distance(first_, last_); }

 private:
  using Point = std::array<double, 2>;
  static double distance(const Point& a, const Point& b) noexcept { return std::hypot(b[0] - a[0], b[1] - a[1]); }
  [[nodiscard]] Point mean() const noexcept {
    Point sum{};
    for (const Point& p : ring_) sum = {sum[0] + p[0], sum[1] + p[1]};
    const auto n = static_cast<double>(ring_.size());
    return {sum[0] / n, sum[1] / n};
  }

  std::size_t window_;
  std::vector<Point> ring_;
  std::size_t next_ = 0;
  Point first_{}, last_{};
  double path_ = 0;
};

}  // namespace vsa::app
