// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How often the intervals of an identification hold the truth: a unit with known parameters, its branches, errors as real ones are
// (correlated along a branch), and a fit from elsewhere, many times.
#pragma once

#include <functional>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "identify/closed_form.hpp"
#include "vsa/experiment/parallel.hpp"
#include "vsa/identify/bench_model.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::test {

constexpr const char* kCoverageKeys = "elastic.k1_Nm=elastic.k2_Nm,tendon.friction,shaft.friction_Nm,sensor.shaft_zero_rad";
inline const std::vector<double> kCoverageTruth{0.00075, 0.13, 0.03, 0.004};  // the type: 0.00062, 0.1535, 0.02525, 0.00763

/// The shipped unit on a sweep four times as fast as the recordings', exact branches of the truth at two presets as data.
/// `quasi_static`: the model is the surrogate, which costs a hundredth.
inline identify::Task coverage_task(bool quasi_static) {
  experiment::Specimen unit;
  unit.type = "qbmove_maker_pro_6_1";
  unit.library = shipped();
  identify::SweepOptions sweep;
  sweep.period_s = 9.5;
  sweep.amplitude_rad = 2.0;
  identify::Task task;
  task.parameters = identify::parse_parameters(kCoverageKeys, shipped().load(unit.type));
  for (const double preset : {0.0, 0.55}) task.observations.push_back({"synthetic", preset, closed_form(kTruth, preset), 1});
  identify::use_bench(task, unit, sweep);
  if (quasi_static) task.model = task.surrogate;
  for (std::size_t o = 0; o < task.observations.size(); ++o) task.observations[o].data = task.model(kCoverageTruth, o);
  return task;
}

/// What one synthetic recording says: errors of 3 mrad on the exact branches, a fit, its intervals.
struct Trial {
  std::vector<double> value, low, high;
  bool holds(std::size_t k) const { return kCoverageTruth[k] >= low[k] && kCoverageTruth[k] <= high[k]; }
};

inline Trial trial(const identify::Task& exact, std::size_t seed, double correlation) {
  constexpr double kError_rad = 0.003;
  identify::Task task = exact;
  std::mt19937 random(static_cast<unsigned>(seed));
  for (identify::Observation& o : task.observations) {
    add_errors(o.data.rising_rad, kError_rad, correlation, random);
    add_errors(o.data.falling_rad, kError_rad, correlation, random);
    o.weight = 1 / kError_rad;
  }
  const identify::Residuals residuals(task, 1);
  identify::FitOptions options;
  options.starts = 1;
  options.iterations = 8;
  const identify::Fit found = identify::fit(residuals, options);
  const identify::Uncertainty u = identify::uncertainty(residuals, found);
  return {found.values, u.low, u.high};
}

/// Of `recordings` sets with errors, how many intervals of each parameter hold the truth. `tell` hears of each as it ends, by its
/// number from 1, from one thread at a time.
inline std::vector<int> intervals_that_hold(const identify::Task& exact, int recordings, double correlation,
                                            const std::function<void(std::size_t, const Trial&)>& tell = {}) {
  std::vector<int> held(exact.parameters.size(), 0);
  std::mutex one_at_a_time;
  experiment::run_in_parallel(static_cast<std::size_t>(recordings), 0, [&](std::size_t i) {
    const Trial t = trial(exact, i + 1, correlation);
    const std::lock_guard lock(one_at_a_time);
    for (std::size_t k = 0; k < held.size(); ++k) held[k] += t.holds(k) ? 1 : 0;
    if (tell) tell(i + 1, t);
  });
  return held;
}

}  // namespace vsa::test
