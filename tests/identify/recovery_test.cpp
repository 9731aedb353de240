// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Known parameters, recordings made with them, and what the identification makes of those.
#include <gtest/gtest.h>

#include "closed_form.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::identify {
namespace {

using test::closed_form;
using test::kFour;
using test::kTruth;
using test::paper_type;
using test::task_of;

const std::vector<double> kPresets{0.0, 0.45, 0.69};

std::vector<experiment::Branches> exact() {
  std::vector<experiment::Branches> out;
  for (double p : kPresets) out.push_back(closed_form(kTruth, p));
  return out;
}

FitOptions quick() {
  FitOptions o;
  o.starts = 2;
  o.tolerance = 1e-9;
  return o;
}

TEST(Recovery, FromExactBranchesIsExact) {
  const Task task = task_of(parse_parameters(kFour, paper_type()), kPresets, exact());
  const Residuals residuals(task, 2);
  const Fit f = fit(residuals, quick());
  for (std::size_t k = 0; k < kTruth.size(); ++k) EXPECT_NEAR(f.values[k], kTruth[k], 1e-4 * std::abs(kTruth[k]) + 1e-7) << k;
  EXPECT_LT(f.rms_rad, 1e-6);
}

TEST(Recovery, FromQuantisedNoisyRecordingsLiesInItsOwnIntervals) {
  int outside = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<experiment::Branches> data;
    for (double p : kPresets)
      data.push_back(
          experiment::branches(test::quantised_recording(kTruth, p, 0.003, 100 * seed + static_cast<unsigned>(data.size()))));
    Task task = task_of(parse_parameters(kFour, paper_type()), kPresets, data);
    // As on the bench: the model is quantised and averaged as the recording was, without its noise.
    task.model = [](const std::vector<double>& v, std::size_t o) {
      return experiment::branches(test::quantised_recording(v, kPresets[o], 0, 1));
    };
    const Residuals residuals(task, 2);
    const Fit f = fit(residuals, quick());
    const Uncertainty u = uncertainty(residuals, f);
    for (std::size_t k = 0; k < kTruth.size(); ++k) {
      outside += kTruth[k] < u.low[k] || kTruth[k] > u.high[k] ? 1 : 0;
      EXPECT_LT(u.standard_error[k], 0.05 * kTruth[k]) << k;
    }
  }
  EXPECT_LE(outside, 3);  // of 20 at 95 %: more than three happens in 1.6 % of such trials
}

TEST(Recovery, TheSameInputsGiveTheSameBitsOnOneAndTwoThreads) {
  const Task task = task_of(parse_parameters(kFour, paper_type()), kPresets, exact());
  const Residuals one(task, 1), two(task, 2);
  EXPECT_EQ(fit(one, quick()).values, fit(two, quick()).values);
}

TEST(Recovery, ReachesTheBoundWhereTheTruthLiesBeyond) {
  std::vector<Parameter> parameters = parse_parameters(kFour, paper_type());
  parameters[2].max = 0.02;
  const Task task = task_of(parameters, kPresets, exact());
  const Residuals residuals(task, 2);
  const Fit f = fit(residuals, quick());
  EXPECT_TRUE(f.at_bound[2]);
  EXPECT_NEAR(f.values[2], 0.02, 1e-9);
  const Uncertainty u = uncertainty(residuals, f);
  EXPECT_TRUE(std::isnan(u.standard_error[2])) << "a bound isn't an estimate";
  EXPECT_TRUE(std::isfinite(u.standard_error[0]));
}

TEST(Recovery, OtherStartsFindWhatTheFirstMisses) {
  // A double well: from the start at 2.6 a descent ends in the shallow one, near 2.5.
  Task task;
  task.parameters = {{"x", {}, "1", 2.6, 0.0, 10.0}};
  experiment::Branches zero = closed_form(kTruth, 0);
  for (double& v : zero.rising_rad) v = 0;
  for (double& v : zero.falling_rad) v = 0;
  task.observations = {{"well", 0, zero, 1}};
  task.model = [zero](const std::vector<double>& x, std::size_t) {
    experiment::Branches b = zero;
    for (double& v : b.rising_rad) v = (x[0] - 1) * (x[0] - 2.5);
    for (double& v : b.falling_rad) v = 0.2 * (x[0] - 1);
    return b;
  };
  const Residuals residuals(task, 2);
  FitOptions one = quick(), several = quick();
  one.starts = 1;
  several.starts = 4;
  EXPECT_GT(fit(residuals, one).values[0], 2.0);
  EXPECT_NEAR(fit(residuals, several).values[0], 1.0, 1e-3);
}

struct Coverage {
  double ours = 1, white = 1;  ///< smallest share of a parameter's intervals that hold the truth
  double largest = 0;
};

Coverage coverage(double rho, int seeds) {
  std::vector<int> ours(kTruth.size(), 0), white(kTruth.size(), 0);
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed) + 1);
    std::vector<experiment::Branches> data = exact();
    for (experiment::Branches& b : data) {
      test::add_errors(b.rising_rad, 0.003, rho, random);
      test::add_errors(b.falling_rad, 0.003, rho, random);
    }
    std::vector<Parameter> parameters = parse_parameters(kFour, paper_type());
    for (std::size_t k = 0; k < kTruth.size(); ++k) parameters[k].start = kTruth[k];
    const Task task = task_of(parameters, kPresets, data);
    const Residuals residuals(task, 1);
    FitOptions o = quick();
    o.starts = 1;
    const Fit f = fit(residuals, o);
    const Uncertainty u = uncertainty(residuals, f);
    for (std::size_t k = 0; k < kTruth.size(); ++k) {
      ours[k] += kTruth[k] >= u.low[k] && kTruth[k] <= u.high[k] ? 1 : 0;
      white[k] += std::abs(kTruth[k] - f.values[k]) <= 1.96 * u.white_standard_error[k] ? 1 : 0;
    }
  }
  Coverage c;
  for (std::size_t k = 0; k < kTruth.size(); ++k) {
    c.ours = std::min(c.ours, ours[k] / static_cast<double>(seeds));
    c.white = std::min(c.white, white[k] / static_cast<double>(seeds));
    c.largest = std::max(c.largest, ours[k] / static_cast<double>(seeds));
  }
  return c;
}

TEST(Intervals, HoldTheTruthAsOftenAsTheySayWithIndependentErrors) {
  const Coverage c = coverage(0.0, 200);
  EXPECT_GT(c.ours, 0.90);
  EXPECT_LT(c.largest, 0.995);
}

TEST(Intervals, HoldTheTruthAsOftenAsTheySayWithCorrelatedErrorsWhereWhiteOnesDont) {
  const Coverage c = coverage(0.8, 200);
  EXPECT_GT(c.ours, 0.90);
  EXPECT_LT(c.largest, 0.995);
  EXPECT_LT(c.white, 0.75);
}

TEST(Intervals, OfAParameterCountedInItsLogarithmAreFactors) {
  std::mt19937 random(6);
  std::vector<experiment::Branches> data = exact();
  for (experiment::Branches& b : data) test::add_errors(b.rising_rad, 0.05, 0, random);
  const Task task = task_of(parse_parameters(kFour, paper_type()), kPresets, data);
  const Residuals residuals(task, 2);
  const Fit f = fit(residuals, quick());
  const Uncertainty u = uncertainty(residuals, f);
  ASSERT_TRUE(task.parameters[0].logarithmic());
  EXPECT_GT(u.low[0], 0);
  EXPECT_NEAR(u.low[0] * u.high[0], f.values[0] * f.values[0], 1e-9 * f.values[0]);
  EXPECT_GT(u.high[0] - f.values[0], 1.01 * (f.values[0] - u.low[0]));
  EXPECT_NEAR(u.high[2] - f.values[2], f.values[2] - u.low[2], 1e-9) << "the others are symmetric";
}

TEST(Intervals, TellTheErrorsCorrelationAndSize) {
  std::mt19937 random(5);
  std::vector<experiment::Branches> data = exact();
  for (experiment::Branches& b : data) {
    test::add_errors(b.rising_rad, 0.003, 0.7, random);
    test::add_errors(b.falling_rad, 0.003, 0.7, random);
  }
  const Task task = task_of(parse_parameters(kFour, paper_type()), kPresets, data);
  const Residuals residuals(task, 2);
  const Uncertainty u = uncertainty(residuals, fit(residuals, quick()));
  for (std::size_t o = 0; o < kPresets.size(); ++o) {
    EXPECT_NEAR(u.autocorrelation[o], 0.7, 0.2);
    EXPECT_NEAR(u.sd_rad[o], 0.003, 0.0012);
  }
  EXPECT_NEAR(u.effective_samples, 342 * 0.3 / 1.7, 30);
}

/// The probability of |T| ≤ t, integrated with T = √ν tan φ: ∫ cos^(ν−1) φ dφ, by the midpoint rule.
double probability_within(double t, double dof) {
  constexpr int kParts = 20000;
  const auto integral = [&](double to) {
    double out = 0;
    for (int i = 0; i < kParts; ++i) out += std::pow(std::cos(to * (i + 0.5) / kParts), dof - 1) * to / kParts;
    return out;
  };
  return integral(std::atan(t / std::sqrt(dof))) / integral(std::acos(-1.0) / 2);
}

TEST(Intervals, AreTheMiddleNinetyFivePercentOfStudentsDistribution) {
  std::mt19937 random(7);
  std::vector<experiment::Branches> data = exact();
  for (experiment::Branches& b : data) {
    test::add_errors(b.rising_rad, 0.003, 0.9, random);
    test::add_errors(b.falling_rad, 0.003, 0.9, random);
  }
  const Task task = task_of(parse_parameters(kFour, paper_type()), kPresets, data);
  const Residuals residuals(task, 2);
  const Fit fitted = fit(residuals, quick());
  const Uncertainty u = uncertainty(residuals, fitted);
  EXPECT_LT(u.degrees_of_freedom, 40) << "few, so that the normal distribution's would be others";
  for (std::size_t k = 0; k < task.parameters.size(); ++k) {
    const bool logarithmic = task.parameters[k].logarithmic();
    const double value = fitted.values[k];
    const double t =
        logarithmic ? std::log(u.high[k] / value) / (u.standard_error[k] / value) : (u.high[k] - value) / u.standard_error[k];
    EXPECT_NEAR(probability_within(t, u.degrees_of_freedom), 0.95, 1e-6) << task.parameters[k].name;
  }
}

}  // namespace
}  // namespace vsa::identify
