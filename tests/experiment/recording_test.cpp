// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/recording.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "recording_support.hpp"

namespace vsa::experiment {
namespace {

using test::Files;
using test::has;
using test::problems;

constexpr double kPi = std::numbers::pi;

/// δ(τ) = τ ∓ width/2 on the rising and falling branch, torque a sine.
LoadRecording sine(double cycles, double width, double noise = 0, std::size_t samples_a_cycle = 4000) {
  LoadRecording r;
  const auto n = static_cast<std::size_t>(cycles * static_cast<double>(samples_a_cycle));
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2 * kPi * static_cast<double>(i) / static_cast<double>(samples_a_cycle);
    const double torque = 1.5 * std::sin(phase);
    r.torque_Nm.push_back(torque + (i % 2 == 0 ? noise : -noise));
    r.deflection_rad.push_back(torque + (std::cos(phase) > 0 ? -width / 2 : width / 2));
  }
  return r;
}

struct Closeness {
  double rms = 0, largest = 0, largest_sd = 0;
};

Closeness compare(const Branches& ours, const Branches& shipped) {
  Closeness c;
  double sum = 0;
  const auto one = [&](double a, double b) {
    sum += (a - b) * (a - b);
    c.largest = std::max(c.largest, std::abs(a - b));
  };
  for (std::size_t i = 0; i < shipped.torque_Nm.size(); ++i) {
    one(ours.rising_rad[i], shipped.rising_rad[i]);
    one(ours.falling_rad[i], shipped.falling_rad[i]);
    c.largest_sd = std::max({c.largest_sd, std::abs(ours.sd_rising_rad[i] - shipped.sd_rising_rad[i]),
                             std::abs(ours.sd_falling_rad[i] - shipped.sd_falling_rad[i])});
  }
  c.rms = std::sqrt(sum / (2.0 * static_cast<double>(shipped.torque_Nm.size())));
  return c;
}

class ShippedRecording : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] std::string stem() const { return std::string("stiffness_preset_") + GetParam() + "rad"; }
  [[nodiscard]] LoadRecording samples() const { return read_load_recording(test::recordings() / (stem() + "_samples.csv")); }
  [[nodiscard]] Branches shipped() const { return read_branches(test::recordings() / (stem() + "_branches.csv")); }
};

// The files have 1e-5 rad resolution; the few points beyond it lie where the first half cycle was cut, at another sample than ours.
TEST_P(ShippedRecording, ItsBranchFileFollowsFromItsSamples) {
  const Branches ours = branches(samples());
  ASSERT_EQ(ours.torque_Nm.size(), shipped().torque_Nm.size());
  const Closeness c = compare(ours, shipped());
  EXPECT_LT(c.rms, 2e-5);
  EXPECT_LT(c.largest, 1.5e-4);
  EXPECT_LT(c.largest_sd, 3e-4);
}

TEST_P(ShippedRecording, TheTurningPointsDontDependOnTheThreshold) {
  for (double fraction : {0.02, 0.05, 0.2, 0.3}) {
    BranchOptions o;
    o.turn_fraction = fraction;
    EXPECT_LT(compare(branches(samples(), o), shipped()).rms, 2e-5) << fraction;
  }
}

TEST_P(ShippedRecording, LeavingNothingOutOrAWholeCycleFitsItsBranchFileWorse) {
  for (double skip : {0.0, 1.0}) {
    BranchOptions o;
    o.skip_cycles = skip;
    EXPECT_FALSE(compare(branches(samples(), o), shipped()).rms < 2e-4) << skip;  // a whole cycle: gaps at 0.6903 rad
  }
}

TEST_P(ShippedRecording, TellsItsPresetAndKeepsItsOrder) {
  const LoadRecording r = samples();
  EXPECT_DOUBLE_EQ(r.preset, std::stod(GetParam()));
  EXPECT_EQ(r.preset_unit, "rad");
  EXPECT_TRUE(r.time_s.empty());
  EXPECT_EQ(r.torque_Nm.size(), r.deflection_rad.size());
  EXPECT_GT(r.torque_Nm.size(), 6000u);
}

TEST_P(ShippedRecording, ReadsBackAsItWasWritten) {
  Files files("round_trip");
  const LoadRecording r = samples();
  write_load_recording(r, files.path() / (stem() + ".csv"));
  const LoadRecording back = read_load_recording(files.path() / (stem() + ".csv"));
  EXPECT_EQ(back.torque_Nm, r.torque_Nm);
  EXPECT_EQ(back.deflection_rad, r.deflection_rad);
  EXPECT_EQ(back.preset, r.preset);
}

INSTANTIATE_TEST_SUITE_P(Hardware, ShippedRecording, ::testing::Values("0.0000", "0.6903"));

TEST(Branches, OfAStraightLoopAreItsTwoLines) {
  const Branches b = branches(sine(3.5, 0.04));
  ASSERT_EQ(b.torque_Nm.size(), 57u);
  EXPECT_NEAR(b.torque_Nm.front(), -1.4, 1e-12);
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) {
    EXPECT_NEAR(b.rising_rad[i], b.torque_Nm[i] - 0.02, 1e-9);
    EXPECT_NEAR(b.falling_rad[i], b.torque_Nm[i] + 0.02, 1e-9);
    EXPECT_NEAR(b.sd_rising_rad[i], 0.0, 1e-7);
  }
}

TEST(Branches, DontFlipWithNoiseInTheTorque) {
  const Branches b = branches(sine(3.5, 0.04, 0.003));
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) {
    EXPECT_NEAR(b.rising_rad[i], b.torque_Nm[i] - 0.02, 0.001);
    EXPECT_NEAR(b.falling_rad[i], b.torque_Nm[i] + 0.02, 0.001);
  }
}

TEST(Branches, LeaveTheFirstHalfCycleOut) {
  LoadRecording r = sine(2.5, 0.04);
  for (std::size_t i = 0; i < 2000; ++i) r.deflection_rad[i] += 1.0;
  const Branches b = branches(r);
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) EXPECT_LT(std::abs(b.falling_rad[i] - b.torque_Nm[i]), 0.021);
}

TEST(Branches, AreNotANumberWhereTheSweepDoesntReach) {
  LoadRecording r = sine(2.5, 0.04);
  for (double& t : r.torque_Nm) t *= 0.5;
  const Branches b = branches(r);
  EXPECT_TRUE(std::isnan(b.rising_rad.front()));
  EXPECT_TRUE(std::isnan(b.falling_rad.back()));
  EXPECT_TRUE(std::isfinite(b.rising_rad[28]));
}

TEST(Branches, OfATorqueThatNeverMovesAreEmpty) {
  LoadRecording r;
  r.torque_Nm.assign(100, 0.5);
  r.deflection_rad.assign(100, 0.1);
  for (double v : branches(r).rising_rad) EXPECT_TRUE(std::isnan(v));
}

TEST(Branches, RefuseOptionsThatMakeNoSense) {
  BranchOptions o;
  o.grid_Nm = 0;
  o.skip_cycles = 0.3;
  o.turn_fraction = 1.0;
  EXPECT_EQ(problems([&] { (void)branches(sine(2, 0), o); }).size(), 3u);
}

TEST(Difference, OfShiftedBranchesIsTheShift) {
  const Branches a = branches(sine(3.5, 0.04));
  Branches b = a;
  for (double& v : b.rising_rad) v += 0.003;
  for (double& v : b.falling_rad) v -= 0.004;
  const Difference d = difference(a, b);
  EXPECT_NEAR(d.rising_rad, 0.003, 1e-12);
  EXPECT_NEAR(d.falling_rad, 0.004, 1e-12);
  EXPECT_NEAR(d.both_rad, std::sqrt((0.003 * 0.003 + 0.004 * 0.004) / 2), 1e-12);
  EXPECT_EQ(d.points, 114u);
}

TEST(Difference, LooksOnlyAtPointsThatBothHave) {
  const Branches a = branches(sine(3.5, 0.04));
  BranchOptions o;
  o.max_Nm = 0.5;
  EXPECT_EQ(difference(a, branches(sine(3.5, 0.04), o)).points, 42u);
  Branches half = a;
  for (std::size_t i = 0; i < 10; ++i) half.rising_rad[i] = std::nan("");
  EXPECT_EQ(difference(half, a).points, 104u);
}

TEST(Difference, OfGridsThatShareNothingIsAnError) {
  const Branches a = branches(sine(3.5, 0.04));
  Branches b = a;
  for (double& t : b.torque_Nm) t += 0.01;
  const auto found = problems([&] { (void)difference(a, b); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(has(found[0], "no torque in common"));
}

TEST(PresetOfAName, IsTheNumberAndItsUnit) {
  EXPECT_DOUBLE_EQ(preset_of_name("stiffness_preset_0.6903rad.csv").value, 0.6903);
  EXPECT_DOUBLE_EQ(preset_of_name("x/stiffness_preset_0.0000rad_samples.csv").value, 0.0);
  EXPECT_EQ(preset_of_name("stiffness_preset_0.01m.csv").unit, "m");
}

}  // namespace
}  // namespace vsa::experiment
