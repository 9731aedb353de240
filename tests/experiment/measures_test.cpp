// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The measures on data whose answers are known in closed form.
#include "vsa/experiment/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::experiment {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Branches on the recordings' grid, |τ| ≤ 1.4 N·m.
Branches on_grid(const std::function<double(double)>& rising, const std::function<double(double)>& falling) {
  Branches b;
  for (int i = -28; i <= 28; ++i) {
    const double torque = 0.05 * i;
    b.torque_Nm.push_back(torque);
    b.rising_rad.push_back(rising(torque));
    b.falling_rad.push_back(falling(torque));
  }
  b.sd_rising_rad.assign(b.torque_Nm.size(), 0);
  b.sd_falling_rad = b.sd_rising_rad;
  return b;
}

TEST(Loop, AParallelogramHasItsHeightTimesItsWidth) {
  const Loop l = loop(on_grid([](double t) { return t / 5 - 0.01; }, [](double t) { return t / 5 + 0.02; }));
  EXPECT_NEAR(l.area_Nm_rad, 0.03 * 2.8, 1e-12);
  for (const double width : {l.mean_width_rad, l.mean_abs_width_rad, l.largest_width_rad, l.smallest_width_rad}) {
    EXPECT_NEAR(width, 0.03, 1e-12);
  }
  EXPECT_NEAR(l.peak_rising_rad, 0.29, 1e-12);
  EXPECT_NEAR(l.peak_falling_rad, 0.30, 1e-12);
}

TEST(Loop, ALensHasTheParabolasArea) {
  const auto height = [](double t) { return 0.04 * (1 - t * t / 1.96); };
  const Loop l = loop(on_grid([](double t) { return t; }, [&](double t) { return t + height(t); }));
  EXPECT_NEAR(l.area_Nm_rad, 0.04 * 2.8 * 2 / 3, 0.04 * 2.8 * 1e-3) << "trapezoids on 57 points";
}

TEST(Loop, ALoopRunTheOtherWayRoundIsNegative) {
  const Loop l = loop(on_grid([](double t) { return t + 0.01; }, [](double t) { return t - 0.01; }));
  EXPECT_NEAR(l.area_Nm_rad, -0.02 * 2.8, 1e-12);
  EXPECT_NEAR(l.mean_abs_width_rad, 0.02, 1e-12);
}

TEST(Loop, AWidthThatChangesItsSignCancelsInTheMeanAndNotInItsMagnitude) {
  const Loop l = loop(on_grid([](double t) { return t; }, [](double t) { return t + 0.01 * t; }));
  EXPECT_NEAR(l.area_Nm_rad, 0, 1e-12);
  EXPECT_NEAR(l.mean_width_rad, 0, 1e-12);
  EXPECT_NEAR(l.mean_abs_width_rad, 0.01 * 0.05 * 28 * 29 / 57, 1e-12);
  EXPECT_NEAR(l.largest_width_rad, 0.014, 1e-12);
  EXPECT_NEAR(l.smallest_width_rad, -0.014, 1e-12);
}

TEST(Loop, OnlyWhatBothBranchesHaveCounts) {
  Branches b = on_grid([](double t) { return t; }, [](double t) { return t + 0.02; });
  for (std::size_t i = 0; i < 8; ++i) b.rising_rad[i] = kNaN;
  EXPECT_NEAR(loop(b).area_Nm_rad, 0.02 * (2.8 - 8 * 0.05), 1e-12);
  b.falling_rad.assign(b.falling_rad.size(), kNaN);
  EXPECT_TRUE(std::isnan(loop(b).area_Nm_rad));
  EXPECT_TRUE(std::isnan(loop({}).mean_width_rad));
}

TEST(Loop, OfTwoEachIsOfTheTorquesThatBothHave) {
  const Branches whole = on_grid([](double t) { return t; }, [](double t) { return t + 0.02; });
  Branches part = on_grid([](double t) { return t; }, [](double t) { return t + 0.01; });
  for (std::size_t i = 0; i < 28; ++i) part.falling_rad[i] = kNaN;  // none below 0
  part.rising_rad[56] = kNaN;
  const auto cut = [&part](std::size_t i) {
    for (auto* column : {&part.torque_Nm, &part.rising_rad, &part.falling_rad})
      column->erase(column->begin() + static_cast<std::ptrdiff_t>(i));
  };
  cut(40);  // a row that isn't there
  const auto [of_part, of_whole] = loops(part, whole);
  EXPECT_NEAR(of_part.area_Nm_rad, 0.01 * 1.35, 1e-12);
  EXPECT_NEAR(of_whole.area_Nm_rad, 0.02 * 1.35, 1e-12);
  EXPECT_NEAR(of_whole.mean_width_rad, 0.02, 1e-12);
  EXPECT_NEAR(of_whole.peak_falling_rad, 1.37, 1e-12);
  EXPECT_NEAR(loops(whole, whole)[0].area_Nm_rad, loop(whole).area_Nm_rad, 0.0);
}

TEST(StiffnessCurve, AStraightLineIsMetExactlyAndWithoutError) {
  const auto branch = [](double t) { return 0.1 + 0.2 * t; };
  const auto curve = stiffness_curve(on_grid(branch, branch));
  ASSERT_EQ(curve.size(), 49u) << "the window of 0.4 N·m fits within ±1.2 N·m";
  for (const StiffnessPoint& p : curve) {
    EXPECT_NEAR(p.stiffness_Nm_per_rad, 5, 1e-9);
    EXPECT_NEAR(p.deflection_rad, branch(p.torque_Nm), 1e-12);
    EXPECT_LT(p.standard_error_Nm_per_rad, 1e-9);
  }
}

TEST(StiffnessCurve, ACubicIsMetExactly) {
  // τ = 2δ + 4δ³ turned round by Cardano's formula.
  const auto branch = [](double t) {
    const double half = t / 8, root = std::sqrt(half * half + 1.0 / 216);
    return std::cbrt(half + root) + std::cbrt(half - root);
  };
  for (const StiffnessPoint& p : stiffness_curve(on_grid(branch, branch))) {
    EXPECT_NEAR(p.stiffness_Nm_per_rad, 2 + 12 * p.deflection_rad * p.deflection_rad, 1e-8);
  }
}

TEST(StiffnessCurve, TheQbmovesLawComesBackAtEveryPreset) {
  constexpr double kTorque = 0.022, kRate = 6.85;
  for (const double preset : {0.0, 0.1125, 0.3, 0.4602, 0.6903}) {
    const double scale = 2 * kTorque * std::cosh(kRate * preset);
    const auto branch = [&](double t) { return std::asinh(t / scale) / kRate; };
    for (const StiffnessPoint& p : stiffness_curve(on_grid(branch, branch))) {
      const double exact = kRate * std::hypot(p.torque_Nm, scale);
      EXPECT_NEAR(p.stiffness_Nm_per_rad, exact, (preset < 0.2 ? 0.09 : 0.03) * exact) << preset << " at " << p.torque_Nm;
    }
  }
}

TEST(StiffnessCurve, HysteresisOfEqualWidthDoesNotChangeIt) {
  const auto curve = stiffness_curve(on_grid([](double t) { return t / 4 - 0.02; }, [](double t) { return t / 4 + 0.02; }));
  for (const StiffnessPoint& p : curve) {
    EXPECT_NEAR(p.stiffness_Nm_per_rad, 4, 1e-9);
    EXPECT_NEAR(p.deflection_rad, p.torque_Nm / 4, 1e-12);
  }
}

TEST(StiffnessCurve, TheStandardErrorIsTheScatterOfRepetitions) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.002);
  const auto noisy = [&](double t) { return t / 8 + noise(random); };
  double mean = 0, square = 0, claimed = 0;
  constexpr int kTrials = 2000;
  for (int i = 0; i < kTrials; ++i) {
    const auto curve = stiffness_curve(on_grid(noisy, noisy));
    const StiffnessPoint& p = curve[24];
    mean += p.stiffness_Nm_per_rad / kTrials;
    square += p.stiffness_Nm_per_rad * p.stiffness_Nm_per_rad / kTrials;
    claimed += p.standard_error_Nm_per_rad * p.standard_error_Nm_per_rad / kTrials;
  }
  EXPECT_NEAR(mean, 8, 0.05);
  EXPECT_NEAR(std::sqrt(claimed), std::sqrt(square - mean * mean), 0.1 * std::sqrt(claimed));
}

TEST(StiffnessCurve, AWindowWithAGapIsLeftOut) {
  Branches b = on_grid([](double t) { return t / 4; }, [](double t) { return t / 4; });
  b.falling_rad[28] = kNaN;
  for (const StiffnessPoint& p : stiffness_curve(b)) EXPECT_GT(std::abs(p.torque_Nm), 0.2);
  EXPECT_EQ(stiffness_curve(b).size(), 49u - 9u);
  EXPECT_TRUE(stiffness_curve({}).empty());
}

struct Response {
  std::vector<double> time_s, y;
};

Response sampled(const std::function<double(double)>& y, double duration_s, double dt_s = 1e-3) {
  Response out;
  for (int i = 0; i * dt_s <= duration_s; ++i) {
    out.time_s.push_back(i * dt_s);
    out.y.push_back(y(i * dt_s));
  }
  return out;
}

/// Second-order step response from 0 to 1.
double second_order(double t, double omega, double zeta) {
  const double damped = omega * std::sqrt(1 - zeta * zeta);
  return 1 - std::exp(-zeta * omega * t) * (std::cos(damped * t) + zeta * omega / damped * std::sin(damped * t));
}

/// When a rising function first reaches a level.
double first_time(const std::function<double(double)>& y, double level, double until) {
  double low = 0, high = until;
  for (int i = 0; i < 200; ++i) (y(0.5 * (low + high)) < level ? low : high) = 0.5 * (low + high);
  return high;
}

class SecondOrder : public testing::TestWithParam<double> {};

TEST_P(SecondOrder, EveryMeasureIsTheClosedForm) {
  const double zeta = GetParam(), omega = 25, root = std::sqrt(1 - zeta * zeta), from = 0.2, to = -1.4;
  const double damped = omega * root;
  const auto unit = [&](double t) { return second_order(t, omega, zeta); };
  const Response r = sampled([&](double t) { return from + (to - from) * unit(t); }, 12 / (zeta * omega));
  const StepMeasures m = step_measures(r.time_s, r.y, from, to, 3e-4);
  const double start = first_time(unit, 0.1, kPi / damped), rise = first_time(unit, 0.9, kPi / damped) - start;
  EXPECT_NEAR(m.rise_start_s, start, 1e-4);
  EXPECT_NEAR(m.rise_s, rise, 1e-3 * rise);
  EXPECT_NEAR(m.mean_speed, 0.8 * 1.6 / rise, 2e-3 * m.mean_speed);
  EXPECT_NEAR(m.peak_slope, 1.6 * omega * std::exp(-zeta / root * std::acos(zeta)), 1e-3 * m.peak_slope);
  EXPECT_NEAR(m.overshoot_pct, 100 * std::exp(-kPi * zeta / root), 0.05);
  EXPECT_NEAR(m.ringing_Hz, damped / (2 * kPi), 2e-3 * m.ringing_Hz);
  EXPECT_NEAR(m.damping_ratio, zeta, 0.01 * zeta);
  EXPECT_NEAR(m.final_value, to, 1e-4);
  EXPECT_NEAR(m.steady_error, 0, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Damping, SecondOrder, testing::Values(0.02, 0.1, 0.3, 0.4));

TEST(StepMeasures, AFirstOrderLagRisesInLn9TimeConstantsAndDoesNotRing) {
  constexpr double kLag_s = 0.07;
  const Response r = sampled([](double t) { return 1 - std::exp(-t / kLag_s); }, 2);
  const StepMeasures m = step_measures(r.time_s, r.y, 0, 1);
  EXPECT_NEAR(m.rise_s, kLag_s * std::log(9), 1e-5);
  EXPECT_NEAR(m.peak_slope, 1 / kLag_s, 0.01 / kLag_s);
  EXPECT_LT(m.overshoot_pct, 1e-6);
  EXPECT_TRUE(std::isnan(m.ringing_Hz));
  EXPECT_TRUE(std::isnan(m.damping_ratio));
}

TEST(StepMeasures, ARampIsMeasuredExactlyBetweenCoarseSamples) {
  const auto ramp = [](double t) { return std::min(1.57, 3.75 * std::max(0.0, t - 0.0137)); };
  const Response r = sampled(ramp, 2, 0.02);
  const StepMeasures m = step_measures(r.time_s, r.y, 0, 1.57);
  EXPECT_NEAR(m.rise_s, 0.8 * 1.57 / 3.75, 1e-12);
  EXPECT_NEAR(m.mean_speed, 3.75, 1e-9);
  EXPECT_NEAR(m.peak_slope, 3.75, 1e-9);
  EXPECT_NEAR(m.steady_error, 0, 1e-12);
}

TEST(StepMeasures, AResponseThatStopsShortIsMeasuredAgainstWhatItAttains) {
  const Response r = sampled([](double t) { return 0.66 * std::min(1.0, t / 0.2); }, 2);
  const StepMeasures m = step_measures(r.time_s, r.y, 0, 0.75);
  EXPECT_NEAR(m.final_value, 0.66, 1e-12);
  EXPECT_NEAR(m.steady_error, -0.09, 1e-12);
  EXPECT_NEAR(m.rise_s, 0.16, 1e-9);
}

TEST(StepMeasures, ARestBesideTheMiddleOfTheRingingDoesNotBiasItsDamping) {
  const auto rings = [](double t) { return second_order(t, 30, 0.05); };
  const Response r = sampled([&](double t) { return rings(std::min(t, 0.93)); }, 3);
  const StepMeasures m = step_measures(r.time_s, r.y, 0, 1);
  EXPECT_GT(std::abs(m.steady_error), 0.05) << "stopped on its way";
  EXPECT_NEAR(m.damping_ratio, 0.05, 0.001);
  EXPECT_NEAR(m.ringing_Hz, 30 / (2 * kPi), 0.02);
}

constexpr double kCount_rad = 2 * kPi / 4096;

/// A step of 1.57 rad that rings at `ring_Hz` with `swing_rad` at first, seen through an encoder that flickers by a count.
Response through_encoder(double ring_Hz, double swing_rad, double decay_s) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1, 1);
  Response r = sampled(
      [&](double t) {
        const double past_s = t - 0.4;
        const double rise = 1.57 * std::min(1.0, t / 0.4);
        return past_s < 0 ? rise : rise + swing_rad * std::exp(-past_s / decay_s) * std::sin(2 * kPi * ring_Hz * past_s);
      },
      3);
  for (double& y : r.y) y = kCount_rad * std::round(y / kCount_rad + 0.5 * noise(random));
  return r;
}

TEST(Ringing, OfADampedOscillationIsItsFrequency) {
  const Response r = through_encoder(3, 0.05, 0.5);
  EXPECT_NEAR(step_measures(r.time_s, r.y, 0, 1.57).ringing_Hz, 3, 0.1);
}

TEST(Ringing, IsNoneWhereAnEncoderFlickersByACount) {
  const Response r = through_encoder(3, 0, 1);
  EXPECT_TRUE(std::isnan(step_measures(r.time_s, r.y, 0, 1.57).ringing_Hz));
  EXPECT_GT(step_measures(r.time_s, r.y, 0, 1.57, 0.4 * kCount_rad).ringing_Hz, 20) << "the flicker is there";
}

TEST(Ringing, BelowACountIsNone) {
  const Response r = through_encoder(3, 0.4 * kCount_rad, 5);
  EXPECT_TRUE(std::isnan(step_measures(r.time_s, r.y, 0, 1.57).ringing_Hz));
}

TEST(Ringing, IsThatOfTheDominantSwingAndNotOfARippleOnIt) {
  Response r = sampled(
      [](double t) {
        const double past_s = std::max(0.0, t - 0.4);
        return 1.57 * std::min(1.0, t / 0.4) + 0.2 * std::exp(-past_s) * std::sin(2 * kPi * 3 * past_s) +
               0.005 * std::exp(-past_s) * std::sin(2 * kPi * 46 * past_s);
      },
      3);
  EXPECT_NEAR(step_measures(r.time_s, r.y, 0, 1.57).ringing_Hz, 3, 0.1);
}

TEST(Ringing, OfOneSwingIsNone) {
  const auto swing = [](double t) {
    const double past_s = t - 0.4;
    return 1.57 * std::min(1.0, t / 0.4) + (past_s > 0 && past_s < 0.2 ? 0.1 * std::sin(2 * kPi * 5 * past_s) : 0);
  };
  const Response r = sampled(swing, 3);
  EXPECT_TRUE(std::isnan(step_measures(r.time_s, r.y, 0, 1.57).ringing_Hz)) << "up, down, at rest: its period isn't seen";
}

TEST(Ringing, OfOneOvershootIsNone) {
  const auto once = [](double t) { return t < 0.5 ? 1.7 * std::sin(kPi * t) : 1.57 + 0.13 * std::exp(-(t - 0.5) / 0.1); };
  const Response r = sampled(once, 3);
  const StepMeasures m = step_measures(r.time_s, r.y, 0, 1.57);
  EXPECT_GT(m.overshoot_pct, 8);
  EXPECT_TRUE(std::isnan(m.ringing_Hz)) << "half a swing is no frequency";
}

TEST(StepMeasures, WhatNeverMovesHasNothingToMeasure) {
  const Response r = sampled([](double) { return 0.3; }, 1);
  const StepMeasures m = step_measures(r.time_s, r.y, 0.3, 1.3);
  EXPECT_TRUE(std::isnan(m.rise_s));
  EXPECT_TRUE(std::isnan(m.mean_speed));
  EXPECT_TRUE(std::isnan(m.overshoot_pct));
  EXPECT_TRUE(std::isnan(m.ringing_Hz));
  EXPECT_NEAR(m.steady_error, -1, 1e-12);
}

TEST(StepMeasures, BadSeriesAreRefusedWithAllThatIsWrong) {
  Response r = sampled([](double t) { return t; }, 1);
  EXPECT_THROW(static_cast<void>(step_measures(r.time_s, {1, 2, 3}, 0, 1)), InputError);
  EXPECT_THROW(static_cast<void>(step_measures({0, 1}, {0, 1}, 0, 1)), InputError);
  r.time_s[5] = r.time_s[4];
  r.y[7] = kNaN;
  try {
    static_cast<void>(step_measures(r.time_s, r.y, 0, 1));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
  }
}

}  // namespace
}  // namespace vsa::experiment
