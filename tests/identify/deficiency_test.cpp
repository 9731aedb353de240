// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the data can't tell is said.
#include <gtest/gtest.h>

#include <algorithm>

#include "closed_form.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::identify {
namespace {

using test::closed_form;
using test::kTruth;
using test::paper_type;
using test::task_of;

const std::vector<double> kPresets{0.0, 0.45, 0.69};

/// Noise that any fit leaves, so that an interval has a width.
std::vector<experiment::Branches> noisy(const std::vector<double>& presets, double sd = 0.001) {
  std::mt19937 random(11);
  std::vector<experiment::Branches> out;
  for (double p : presets) {
    out.push_back(closed_form(kTruth, p));
    test::add_errors(out.back().rising_rad, sd, 0, random);
    test::add_errors(out.back().falling_rad, sd, 0, random);
  }
  return out;
}

/// k1 and k2 apart, where only their sum acts; the rest known.
Task untied() {
  Task task = task_of(parse_parameters("elastic.k1_Nm,elastic.k2_Nm,shaft.friction_Nm", paper_type()), kPresets, noisy(kPresets));
  task.model = [](const std::vector<double>& v, std::size_t o) {
    return closed_form({0.5 * (v[0] + v[1]), kTruth[1], v[2], kTruth[3]}, kPresets[o]);
  };
  return task;
}

TEST(Deficiency, TwoParametersOfWhichOnlyTheSumActsAreNamed) {
  const Task task = untied();
  const Residuals residuals(task, 2);
  const Fit f = fit(residuals, {});
  EXPECT_NEAR(0.5 * (f.values[0] + f.values[1]), kTruth[0], 1e-3) << "their sum is found all the same";
  const Uncertainty u = uncertainty(residuals, f);
  ASSERT_TRUE(u.deficient());
  ASSERT_EQ(u.unseparated.size(), 1u);
  EXPECT_EQ(u.unseparated[0], (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(std::isinf(u.standard_error[0]) && std::isinf(u.standard_error[1]));
  EXPECT_TRUE(std::isfinite(u.standard_error[2])) << "the third is determined";
  EXPECT_GT(u.condition, 500);
}

/// As many numbers as points meet them all; how well they are known nothing says.
TEST(Deficiency, AsManyParametersAsPointsAreAllUndetermined) {
  for (std::size_t points : {std::size_t{2}, std::size_t{3}}) {
    Task task = untied();
    task.observations.resize(1);
    experiment::Branches& data = task.observations[0].data;
    std::size_t left = points;
    for (double& v : data.rising_rad) v = left > 0 && std::isfinite(v) ? (--left, v) : std::nan("");
    for (double& v : data.falling_rad) v = std::nan("");
    const Residuals residuals(task, 1);
    ASSERT_EQ(residuals.points().size(), points);
    const Fit f = fit(residuals, {});
    const Uncertainty u = uncertainty(residuals, f);
    ASSERT_TRUE(u.deficient());
    for (double e : u.standard_error) EXPECT_TRUE(std::isinf(e));
  }
}

TEST(Deficiency, AtOnePresetTheShortfallAndTheSpringAreOne) {
  const std::vector<double> one{0.69};
  const Task task = task_of(parse_parameters(test::kFour, paper_type()), one, noisy(one));
  const Residuals residuals(task, 2);
  const Uncertainty u = uncertainty(residuals, fit(residuals, {}));
  ASSERT_EQ(u.unseparated.size(), 1u);
  EXPECT_EQ(u.unseparated[0], (std::vector<std::size_t>{0, 1}));
}

TEST(Deficiency, AParameterWithoutEffectIsNamed) {
  Task task = task_of(parse_parameters("elastic.k1_Nm=elastic.k2_Nm,drive.supply_V", paper_type()), kPresets, noisy(kPresets));
  task.model = [](const std::vector<double>& v, std::size_t o) {
    return closed_form({v[0], kTruth[1], kTruth[2], kTruth[3]}, kPresets[o]);
  };
  const Residuals residuals(task, 2);
  const Uncertainty u = uncertainty(residuals, fit(residuals, {}));
  EXPECT_EQ(u.without_effect, std::vector<std::size_t>{1});
  EXPECT_TRUE(std::isinf(u.standard_error[1]));
  EXPECT_TRUE(std::isfinite(u.standard_error[0]));
}

TEST(Deficiency, AWellPosedTaskHasNone) {
  const Task task = task_of(parse_parameters(test::kFour, paper_type()), kPresets, noisy(kPresets));
  const Residuals residuals(task, 2);
  const Uncertainty u = uncertainty(residuals, fit(residuals, {}));
  EXPECT_FALSE(u.deficient());
  EXPECT_LT(u.condition, 50);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(u.correlation[i][i], 1.0, 1e-9);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(u.correlation[i][k], u.correlation[k][i], 1e-9);
  }
}

TEST(Failures, OfTheModelAtTheStartAreToldAndElsewhereSteppedAround) {
  Task task = task_of(parse_parameters(test::kFour, paper_type()), kPresets, noisy(kPresets));
  const Model fine = task.model;
  task.model = [fine](const std::vector<double>& v, std::size_t o) {
    if (v[2] > 0.035) throw InputError({"", "shaft.friction_Nm", "", "too much", "less"});
    return fine(v, o);
  };
  const Residuals residuals(task, 2);
  EXPECT_NEAR(fit(residuals, {}).values[2], kTruth[2], 2e-3);
  task.parameters[2].start = 0.04;
  EXPECT_THROW((void)fit(residuals, {}), InputError);
}

TEST(Failures, ARecordingWithoutBranchesAndNoneAtAllAreTold) {
  Task task = task_of(parse_parameters(test::kFour, paper_type()), {0.0}, noisy({0.0}));
  for (double& v : task.observations[0].data.rising_rad) v = std::nan("");
  for (double& v : task.observations[0].data.falling_rad) v = std::nan("");
  EXPECT_THROW(Residuals(task, 1), InputError);
  task.observations.clear();
  EXPECT_THROW(Residuals(task, 1), InputError);
}

}  // namespace
}  // namespace vsa::identify
