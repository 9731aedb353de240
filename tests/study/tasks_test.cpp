// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/tasks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::study {
namespace {

TaskOptions of(std::vector<std::string> types, std::vector<config::Override> overrides = {}) {
  TaskOptions out;
  out.library = config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"});
  out.types = std::move(types);
  out.overrides = std::move(overrides);
  return out;
}

/// A series spring whose motor and shaft rub at nothing.
std::vector<config::Override> without_friction(const std::string& stiffness) {
  return {{"elastic.stiffness_Nm_per_rad", stiffness},
          {"drive.friction_Nm", "0"},
          {"drive.dead_band", "0"},
          {"drive.viscous_Nms_per_rad", "0"},
          {"drive.supply_V", "24"},
          {"firmware.supply_limit", "false"},
          {"shaft.friction_Nm", "0"}};
}

TaskResults done(const TaskOptions& options) { return run(plan_tasks(options)).value().each.at(0); }

TEST(Tasks, ALinkOnASpringWithoutLossesIsThrownAtThreeTimesItsSwingAfterHalfAPeriod) {
  // A quick motor jumps: q = −1 + cos ωt, then about +1 with the amplitude √(5 − 4 cos ωt), which is 3 at ωt = π.
  constexpr double kRate_per_s = 4;
  TaskOptions options = of({"sea_example"}, without_friction("0.1"));
  options.inertia_kgm2 = 0.1 / (kRate_per_s * kRate_per_s);
  const TaskResults r = done(options);
  ASSERT_EQ(r.throws.size(), 1u) << "a type without preset does it once";
  EXPECT_NEAR(r.farthest()->link_rad_per_s, 3 * kRate_per_s, 0.04 * 3 * kRate_per_s);
  EXPECT_NEAR(r.farthest()->swing_back_s, kPi / kRate_per_s, 0.101) << "and its motor needs a while";
  EXPECT_NEAR(r.farthest()->distance_m(), std::pow(0.5 * r.farthest()->link_rad_per_s, 2) / 9.81, 1e-12);
}

TEST(Tasks, ABlowDiesAwayByTheShaftsFrictionTwiceItsTorqueOverTheStiffnessEachHalfSwing) {
  constexpr double kStiffness = 10, kFriction = 0.02, kInertia = 0.01;
  TaskOptions options =
      of({"sea_example"}, {{"drive.presliding_rad", "0"}, {"shaft.presliding_rad", "0"}, {"shaft.friction_Nm", "0.02"}});
  options.inertia_kgm2 = kInertia;
  const TaskResults r = done(options);
  const double rate = std::sqrt(kStiffness / kInertia);
  const double first = 2 / rate - kFriction / kStiffness;
  const double half_swings = 0.95 * first / (2 * kFriction / kStiffness);
  ASSERT_TRUE(r.soonest());
  EXPECT_NEAR(r.soonest()->settled_s, (0.5 + half_swings) * kPi / rate, 1.2 * kPi / rate)
      << "it may stop half a band from the middle";
  EXPECT_NEAR(r.soonest()->way_rad, first, 0.05 * first);
}

TEST(Tasks, HoldingCostsTheHeatOfTheWindings) {
  std::vector<config::Override> gentle = without_friction("10");  // a loop that doesn't chatter, which heats too
  gentle.push_back({"firmware.kp_pct_per_tick", "0.02"});
  gentle.push_back({"firmware.kd_pct_per_tick", "0.02"});
  TaskOptions options = of({"sea_example"}, gentle);
  options.load_Nm = 1.0;
  const TaskResults r = done(options);
  ASSERT_TRUE(r.cheapest());
  EXPECT_NEAR(r.cheapest()->energy_J, 10 * 2.3 * std::pow(1.0 / 1.02, 2), 0.7) << "R (τ/K_τ)² for 10 s";
  EXPECT_GE(r.cheapest()->sag_rad, 1.0 / 10) << "the spring's part of it";
}

TEST(Tasks, WhatFrictionHoldsCostsNothingAndWhatIsTooMuchIsNotHeld) {
  TaskOptions options = of({"sea_example"});
  options.load_Nm = 0.5;  // of 0.8 N·m in the gears
  ASSERT_TRUE(done(options).cheapest());
  EXPECT_NEAR(done(options).cheapest()->energy_J, 0, 0.05);
  options.load_Nm = 20;
  EXPECT_FALSE(done(options).cheapest());
}

TEST(Tasks, LinkAndLoadGrowWithTheTorqueAndPresetsEndBelowTheLargest) {
  const Tasks plan = plan_tasks(of({"qbmove_maker_pro_6_1", "sea_example", "maccepa_example"}));
  ASSERT_EQ(plan.each.size(), 3u);
  for (const TaskResults& r : plan.each) {
    EXPECT_GT(r.torque_Nm, 0) << r.actuator.name;
    EXPECT_NEAR(r.inertia_kgm2, r.torque_Nm / 200, 1e-15);
    EXPECT_NEAR(r.load_Nm, r.torque_Nm / 2, 1e-15);
    EXPECT_LE(r.presets.back(), 0.9 * r.actuator.unit.preset_max + 1e-12);
  }
  EXPECT_EQ(plan.each[0].presets.size(), 5u);
  EXPECT_EQ(plan.each[1].presets, std::vector<double>{0});
}

TEST(Tasks, SoftThrowsFartherThanStiffAndTheThreadsChangeNothing) {
  TaskOptions options = of({"qbmove_maker_pro_paper"});
  options.step_s = 1e-3;
  const Tasks one = run(plan_tasks(options), {}, 1).value(), two = run(plan_tasks(options), {}, 2).value();
  EXPECT_EQ(to_json(one, "x"), to_json(two, "x"));
  const TaskResults& r = one.each[0];
  EXPECT_GT(r.throws.front().link_rad_per_s, 1.1 * r.throws.back().link_rad_per_s);
  EXPECT_GT(r.farthest()->link_rad_per_s, r.no_load_speed_rad_per_s) << "faster than its motors";
  EXPECT_LT(r.settles.back().way_rad, r.settles.front().way_rad) << "a stiff joint gives way less";
}

TEST(Tasks, AMotorWithoutVoltageDoesNothing) {
  const TaskResults r = done(of({"sea_example"}, {{"drive.supply_V", "0"}}));
  EXPECT_FALSE(r.farthest() || r.soonest() || r.cheapest());
  EXPECT_TRUE(std::isnan(r.inertia_kgm2));
}

TEST(Tasks, EndWithoutResultsWhereTheirWatcherStopsThem) {
  EXPECT_FALSE(run(plan_tasks(of({"sea_example"})), [](const Progress&) { return false; }));
}

TEST(Tasks, RefuseEverythingWrongAtOnce) {
  TaskOptions options = of({"sea_example", "qbmove_9000"}, {{"elastic.nothing", "1"}});
  options.inertia_kgm2 = 0;
  options.load_Nm = -1;
  options.step_s = 0.1;
  try {
    (void)plan_tasks(options);
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"--inertia-kgm2", "--load-Nm", "--step-s", "elastic.nothing", "qbmove_9000"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
}

TEST(SettlingTime, OfADyingSwingIsWhereItsEnvelopeEntersTheBand) {
  constexpr double kRate = 20, kDamping = 0.1, kSample_s = 1e-3;
  std::vector<double> angle;
  for (int i = 0; i < 20000; ++i) {
    const double t = i * kSample_s;
    angle.push_back(0.3 + std::exp(-kDamping * kRate * t) * std::cos(kRate * t));
  }
  const double enters = std::log(20) / (kDamping * kRate);
  EXPECT_LE(settling_time_s(angle, kSample_s), enters + kSample_s);
  EXPECT_GE(settling_time_s(angle, kSample_s), enters - kPi / kRate);
}

TEST(SettlingTime, IsNoneWhereNothingMovesOrNothingRests) {
  std::vector<double> swing;
  for (int i = 0; i < 1000; ++i) swing.push_back(std::sin(0.1 * i));
  EXPECT_TRUE(std::isnan(settling_time_s(swing, 1e-3)));
  EXPECT_TRUE(std::isnan(settling_time_s(std::vector<double>(1000, 0.2), 1e-3)));
  EXPECT_TRUE(std::isnan(settling_time_s({}, 1e-3)));
}

}  // namespace
}  // namespace vsa::study
