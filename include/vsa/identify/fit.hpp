// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Bounded least squares with Ceres' trust region (Levenberg–Marquardt, steps ended at the bounds), from several deterministic
// starts. Why Ceres and not NLopt: the problem is a sum of squares whose Jacobian costs 2n + 1 simulations that run side by side; a
// trust region on it needs about ten of them, NLopt's derivative-free methods hundreds of simulations, and its gradient methods
// don't see the squares. Where a task has a surrogate, NLopt finds the starts on it (global_search.hpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "vsa/identify/residuals.hpp"

namespace vsa::identify {

/// How a fit is made: starts, steps and when to stop.
struct FitOptions {
  /// Local solutions at most: one from the type's values (or where the surrogate leads from there, if that is better), the others
  /// from a global search on the surrogate, which may find fewer places; without a surrogate from the best of 4 × as many trials
  /// about the type's values.
  int starts = 3;
  bool global = true;        ///< false: as without a surrogate
  unsigned seed = 1;         ///< of the global search
  int iterations = 20;       ///< of each
  double effect_rad = 2e-3;  ///< of a difference step
  /// The same of the Jacobian that the intervals come from. A simulated unit is rough (encoders' steps, motors that stick and slip:
  /// 0.1 … 0.2 mrad however small the step); that noise in the columns hides how alike two of them are, and with it an interval.
  double interval_effect_rad = 8e-3;
  double tolerance = 1e-3;                           ///< relative decrease of the cost at which a solution ends
  std::function<void(const std::string&)> progress;  ///< gets a line now and then; null: nobody
};

/// What one local solution came to.
struct StartResult {
  std::vector<double> from,     ///< the start
      to;                       ///< the end
  std::vector<double> steps;    ///< of the differences, in Parameter::coordinate()
  double rms_rad = 0;           ///< of the residuals at `to`, unweighted
  double cost = 0;              ///< at `to`, ½ Σ w² r²; by fit(), with what the model held constant on the way there
  int iterations = 0;           ///< that it took
  bool converged = false;       ///< by tolerance, not by their number
  std::size_t evaluations = 0;  ///< simulations of a recording, of a job; a fit counts its own (Residuals)
};

/// A fit: the best of its local solutions, with residuals and Jacobian there.
struct Fit {
  std::vector<double> values;                 ///< the estimate, in the order of Task::parameters
  std::vector<bool> at_bound;                 ///< of each parameter
  std::vector<double> residuals;              ///< unweighted
  std::vector<std::vector<double>> jacobian;  ///< columns, unweighted, by Parameter::coordinate()
  std::vector<double> steps;                  ///< of the differences, as StartResult has them
  double cost = 0,                            ///< ½ Σ w² r²
      rms_rad = 0;                            ///< root mean square, unweighted
  std::vector<StartResult> starts;            ///< the best is first
};

/// Throws what the model throws at the type's own values, and std::runtime_error where no start can be evaluated.
[[nodiscard]] Fit fit(const Residuals& residuals, const FitOptions& options);
/// Where fit() begins: the type's values, and others as the options say. The first is that.
[[nodiscard]] std::vector<std::vector<double>> starting_points(const Residuals& residuals, const FitOptions& options);
/// The fit that these local solutions make, one at least.
[[nodiscard]] Fit best_of(const Residuals& residuals, std::vector<StartResult> starts, const FitOptions& options);
/// Residuals, Jacobian and bounds at `fit.values`, with `fit.steps` as the first guess of the steps.
void evaluate_at(Fit& fit, const Residuals& residuals, double effect_rad);
/// One local solution. `fixed[k]`: parameter k keeps its value. Where it ends the difference steps are found anew, and what the
/// model holds constant, and it goes on as long as that lowers the cost by a percent.
[[nodiscard]] StartResult solve(const Residuals& residuals, const std::vector<double>& from, const std::vector<bool>& fixed,
                                const FitOptions& options);

}  // namespace vsa::identify
