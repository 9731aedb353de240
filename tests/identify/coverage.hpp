// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How often the intervals of an identification hold the truth: a unit with known parameters, its branches, errors as real ones are
// (correlated along a branch), and a fit from elsewhere, many times.
#pragma once

#include <string>
#include <vector>

#include "identify/closed_form.hpp"
#include "vsa/experiment/parallel.hpp"
#include "vsa/identify/bench_model.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::test {

constexpr const char* kCoverageKeys = "elastic.k1_Nm=elastic.k2_Nm,tendon.friction,shaft.friction_Nm,sensor.shaft_zero_rad";
inline const std::vector<double> kCoverageTruth{0.00075, 0.13, 0.03, 0.004};  // the preset: 0.00062, 0.1535, 0.02525, 0.00763

/// The shipped unit on a sweep four times as fast as the recordings', exact branches of the truth at two presets as data.
/// `quasi_static`: the model is the surrogate, which costs a hundredth.
inline identify::Task coverage_task(bool quasi_static) {
  experiment::Specimen unit;
  unit.preset = "qbmove_maker_pro_6_1";
  unit.library = shipped();
  identify::SweepOptions sweep;
  sweep.period_s = 9.5;
  sweep.amplitude_rad = 2.0;
  identify::Task task;
  task.parameters = identify::parse_parameters(kCoverageKeys, shipped().load(unit.preset));
  for (const double preset : {0.0, 0.55}) task.observations.push_back({"synthetic", preset, closed_form(kTruth, preset), 1});
  identify::use_bench(task, unit, sweep);
  if (quasi_static) task.model = task.surrogate;
  for (std::size_t o = 0; o < task.observations.size(); ++o) task.observations[o].data = task.model(kCoverageTruth, o);
  return task;
}

/// Of `recordings` sets with errors of 3 mrad, how many intervals of each parameter hold the truth.
inline std::vector<int> intervals_that_hold(const identify::Task& exact, int recordings, double correlation) {
  constexpr double kError_rad = 0.003;
  const std::size_t n = exact.parameters.size();
  std::vector<std::vector<int>> held(static_cast<std::size_t>(recordings), std::vector<int>(n, 0));
  experiment::run_in_parallel(held.size(), 0, [&](std::size_t i) {
    identify::Task task = exact;
    std::mt19937 random(static_cast<unsigned>(i) + 1);
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
    for (std::size_t k = 0; k < n; ++k) held[i][k] = kCoverageTruth[k] >= u.low[k] && kCoverageTruth[k] <= u.high[k] ? 1 : 0;
  });
  std::vector<int> out(n, 0);
  for (const auto& one : held) {
    for (std::size_t k = 0; k < n; ++k) out[k] += one[k];
  }
  return out;
}

}  // namespace vsa::test
