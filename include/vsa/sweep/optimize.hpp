// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The best candidates for a plan's searched axes, by a generation at a time: all runs of a generation know nothing of each other, so
// they go to threads, ranks or parts as a sweep's do. What comes next follows from the plan and the numbers so far alone: whoever ran
// what, the same seed finds the same.
//
//   pso    particle swarm               one objective           nsga2   sorting by non-domination    several
//   gaco   ant colony, extended         one                     nspso   particle swarm               several
//                                                               maco    ant colony                   several
//
// All are pagmo's.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "vsa/report/report.hpp"
#include "vsa/sweep/folder.hpp"
#include "vsa/sweep/plan.hpp"

namespace vsa::sweep {

/// Whether this build has an optimiser.
[[nodiscard]] bool has_optimizer() noexcept;

/// What an optimisation found: all candidates that were tried, and which are the best.
struct Optimum {
  Plan plan;                                    ///< with all candidates that were tried, in their order
  std::vector<std::vector<double>> objectives;  ///< of each, as the plan asks; NaN: its runs failed
  std::vector<std::size_t> best;                ///< that no other beats in all objectives, the best of the first objective first
};

/// Makes every run of the plan from `first` on and gives the outcomes of all, by run. It may throw, which ends the search and comes out.
using Evaluate = std::function<std::vector<Outcome>(const Plan& with_candidates, std::size_t first)>;
/// Throws InputError where the plan searches nothing, or this build has no optimiser.
[[nodiscard]] Optimum optimize(const Plan& plan, const Evaluate& evaluate);

/// Of a candidate's runs.
[[nodiscard]] std::vector<double> objectives_of(const Plan& plan, const std::vector<Outcome>& outcomes, std::size_t candidate);
/// Those that none beats: better or equal in all, and better in one.
[[nodiscard]] std::vector<std::size_t> not_beaten(const std::vector<std::vector<double>>& objectives, const Search& search);

/// A line a candidate: number, generation, searched values, objectives, whether it is among the best.
[[nodiscard]] std::string candidates_csv(const Optimum& optimum);
/// The candidates as a page: objectives by generation, searched values by objectives.
[[nodiscard]] report::Report optimum_page(const Optimum& optimum, const std::string& command);

}  // namespace vsa::sweep
