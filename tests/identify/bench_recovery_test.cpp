// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Known parameters from recordings of the simulated bench itself: full dynamics, encoders, noise. Coarse and short: a sweep six
// times as fast as the recordings', two parameters.
#include <gtest/gtest.h>

#include <random>

#include "closed_form.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/bench_model.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::identify {
namespace {

constexpr const char* kType = "qbmove_maker_pro_6_1";
constexpr const char* kKeys = "tendon.friction,sensor.shaft_zero_rad";

SweepOptions fast() {
  SweepOptions o;
  o.period_s = 6;
  o.amplitude_rad = 2.2;
  return o;
}

experiment::Specimen specimen() {
  experiment::Specimen s;
  s.type = kType;
  s.library = test::shipped();
  return s;
}

Observation noisy_recording(const std::vector<double>& truth, double preset, unsigned seed) {
  experiment::Specimen unit = specimen();
  unit.overrides = overrides(parse_parameters(kKeys, test::shipped().load(kType)), truth);
  experiment::LoadRecording r = simulated_recording(unit, preset, fast());
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.002);
  for (double& d : r.deflection_rad) d += noise(random);
  Observation out{"simulated", preset, experiment::branches(r), 1};
  out.weight = scatter_weight(out.data);
  return out;
}

TEST(BenchRecovery, FindsKnownParametersWithinFourOfItsStandardErrors) {
  const std::vector<double> truth{0.10, 0.004};
  Task task;
  task.parameters = parse_parameters(kKeys, test::shipped().load(kType));
  ASSERT_GT(std::abs(task.parameters[0].start - truth[0]), 0.02) << "the start must not be the answer";
  for (double preset : {0.0, 0.6}) task.observations.push_back(noisy_recording(truth, preset, 7));
  use_bench(task, specimen(), fast());
  const Residuals residuals(task, 0);
  FitOptions o;
  o.starts = 1;
  o.iterations = 6;
  const Fit f = fit(residuals, o);
  const Uncertainty u = uncertainty(residuals, f);
  EXPECT_FALSE(u.deficient());
  for (std::size_t k = 0; k < truth.size(); ++k) {
    // One recording is no statistics (coverage_test.cpp has those), and a unit that quantises makes the sum of squares rough.
    EXPECT_NEAR(f.values[k], truth[k], 4 * u.standard_error[k]) << task.parameters[k].name;
  }
  EXPECT_LT(u.standard_error[0], 0.02);
  EXPECT_LT(u.standard_error[1], 0.001);
}

TEST(BenchModel, RefusesASweepWithoutAWholeCycleAndAPresetBeyondTheUnit) {
  Task task;
  task.parameters = parse_parameters(kKeys, test::shipped().load(kType));
  task.observations = {{"x", 0.0, test::closed_form(test::kTruth, 0), 1}};
  SweepOptions o = fast();
  o.cycles = 1.0;
  EXPECT_THROW(use_bench(task, specimen(), o), InputError);
  task.observations[0].preset = 3.0;
  EXPECT_THROW(use_bench(task, specimen(), fast()), InputError);
}

}  // namespace
}  // namespace vsa::identify
