// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Starts for the local solutions from a search of the whole box of bounds on a task's surrogate. NLopt's controlled random search
// (CRS2 with local mutation) with a seed of its own each, then least squares on the surrogate from where it ended.
//
// A parameter whose bounds are positive and two decades apart or more is searched in its logarithm. What the surrogate can't see
// (inertia, damping, presliding) stays at its start.
#pragma once

#include <vector>

#include "vsa/identify/task.hpp"

namespace vsa::identify {

/// How wide a search looks.
struct GlobalOptions {
  int searches = 2;                      ///< each from its own seed
  unsigned seed = 1;                     ///< of the first
  int evaluations_per_parameter = 1000;  ///< at most, of each search
  unsigned threads = 0;                  ///< searches side by side; 0: all that the machine has. They don't change the result
};

/// A place that a search ended at.
struct GlobalPoint {
  std::vector<double> values;  ///< in the order of Task::parameters
  double cost = 0;             ///< of the surrogate, ½ Σ w² r²
};

/// What searches found, and what they couldn't see.
struct GlobalSearch {
  /// Those that are apart by more than 2 % of a searched range, best first; none worse than ten times the best.
  std::vector<GlobalPoint> points;
  std::vector<std::size_t> unseen;  ///< parameters that the surrogate doesn't see
};

/// Equal inputs, seed included, give equal bits. Nothing where the task has no surrogate or it sees no parameter. Throws what the
/// surrogate throws only where that is experiment::Stopped.
[[nodiscard]] GlobalSearch search_globally(const Task& task, const GlobalOptions& options);

}  // namespace vsa::identify
