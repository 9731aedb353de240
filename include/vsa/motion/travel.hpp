// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How far a robot went, without its wriggling. The centre of mass, projected on the ground, is averaged over the last gait period
//     c̄(t) = mean of c over (t − T, t],    path = Σ |c̄(t_k) − c̄(t_{k−1})|,    net = |c̄(end) − c̄(first)|
// so that what a cycle swings to and fro doesn't count. Nothing counts until the first period is full.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace vsa::motion {

/// How far a robot went without its wriggling: the centre of mass, averaged over a gait period.
class Travel {
 public:
  /// T and the time between two samples, s; at least one sample is averaged.
  Travel(double window_s, double sample_s);

  /// The next sample, m; its third coordinate doesn't count.
  void add(const std::array<double, 3>& center_of_mass);
  /// As new.
  void restart();

  /// The first period is full; before that both lengths are 0.
  [[nodiscard]] bool measured() const noexcept { return ring_.size() == window_; }
  [[nodiscard]] double path_m() const noexcept { return path_; }  ///< Σ since the first full period
  [[nodiscard]] double net_m() const noexcept;                    ///< from there to now, as the crow flies

 private:
  using Point = std::array<double, 2>;
  [[nodiscard]] Point mean() const noexcept;

  std::size_t window_;
  std::vector<Point> ring_;
  std::size_t next_ = 0;
  Point first_{}, last_{};
  double path_ = 0;
};

}  // namespace vsa::motion
