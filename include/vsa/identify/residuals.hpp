// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Residuals and their Jacobian, evaluated on several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "vsa/identify/task.hpp"

namespace vsa::identify {

/// One residual's place.
struct Point {
  std::size_t observation = 0;  ///< into Task::observations
  bool rising = true;           ///< else falling
  std::size_t grid = 0;         ///< index into the data's torque grid
};

/// A model whose branch has fewer than two points counts as this far off.
inline constexpr double kMissing_rad = 0.2;

/// A task's residuals: which points count, and the model's values there, evaluated on several threads. The task must outlive it.
class Residuals {
 public:
  /// `threads` 0: all that the machine has. Throws InputError where an observation has no points.
  Residuals(const Task& task, unsigned threads);

  /// Recording after recording, branch after branch.
  [[nodiscard]] const std::vector<Point>& points() const noexcept { return points_; }
  /// Unweighted, rad. Throws what the model throws.
  [[nodiscard]] std::vector<double> at(const std::vector<double>& values) const;
  /// Several at once; an empty vector where the model threw.
  [[nodiscard]] std::vector<std::vector<double>> at_all(const std::vector<std::vector<double>>& many) const;
  /// Columns dr/dθ_k of the parameters `which`, θ_k in Parameter::coordinate(), by central differences with the steps given,
  /// one-sided at a bound. A side that fails is left out; no columns: both failed.
  [[nodiscard]] std::vector<std::vector<double>> jacobian(const std::vector<double>& values, const std::vector<double>& here,
                                                          const std::vector<double>& steps,
                                                          const std::vector<std::size_t>& which) const;
  /// Steps whose effect on the residuals is about `effect_rad` (root mean square): a simulated unit quantises, so that a step far
  /// below one encoder count measures rounding, and one far above it measures curvature. `first`: where the search begins; may be
  /// empty.
  [[nodiscard]] std::vector<double> steps(const std::vector<double>& values, const std::vector<double>& here, double effect_rad,
                                          std::vector<double> first = {}) const;

  /// w of its recording.
  [[nodiscard]] double weight(std::size_t point) const { return task_.observations[points_[point].observation].weight; }
  [[nodiscard]] double cost(const std::vector<double>& residuals) const;           ///< ½ Σ w² r²
  [[nodiscard]] std::size_t evaluations() const noexcept { return evaluations_; }  ///< simulations so far
  [[nodiscard]] const Task& task() const noexcept { return task_; }                ///< that it was made of
  [[nodiscard]] unsigned threads() const noexcept { return threads_; }             ///< in use

 private:
  const Task& task_;
  unsigned threads_;
  std::vector<Point> points_;
  mutable std::atomic<std::size_t> evaluations_{0};
};

[[nodiscard]] double rms(const std::vector<double>& values);  ///< √(Σ r²/n); NaN of none

/// Root mean squares of one recording's residuals.
struct Misfit {
  std::string name;            ///< of the recording
  double preset = 0;           ///< of the recording
  experiment::Difference rms;  ///< of both branches and of each
};
/// Of each recording, at those values.
[[nodiscard]] std::vector<Misfit> misfits(const Residuals& residuals, const std::vector<double>& values);

}  // namespace vsa::identify
