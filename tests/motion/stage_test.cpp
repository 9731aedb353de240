// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A gait on a stage that is no world of ours: what any simulator has to give, and what it gets.
#include "vsa/motion/stage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "motion/gait_file.hpp"
#include "motion/two_actuators.hpp"
#include "vsa/units.hpp"

namespace vsa::motion {
namespace {

TEST(OnAnyStage, EveryActuatorGetsItsWaveOnceAControlPeriod) {
  TwoActuators stage;
  Gait gait(walk());
  stage.play(gait, 0.26);
  EXPECT_EQ(stage.sent, 2 * 26);
  gait.apply(stage);  // at 0.26 s
  gait.apply(stage);
  EXPECT_EQ(stage.sent, 2 * 27) << "once a period";
  EXPECT_NEAR(stage.told[0].equilibrium_rad, 0.1 + 0.5 * std::sin(2 * kPi * 0.26), 1e-12);
  EXPECT_NEAR(stage.told[1].equilibrium_rad, 0.1 - 0.5 * std::sin(2 * kPi * 0.26), 1e-12) << "n = 1, λ = 1: half a wave on";
  EXPECT_EQ(stage.told[1].preset, 0.3);
}

TEST(OnAnyStage, AnActuatorThatItHasNotIsNamedWithThoseThatItHas) {
  GaitParams p = walk();
  p.groups[0].actuators[1] = "tail";
  TwoActuators stage;
  Gait gait(p);
  try {
    gait.bind(stage);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("group.legs.actuators = tail: no such actuator"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("left, right"), std::string::npos);
  }
}

TEST(OnAnyStage, SteeringAsksForTheModelOfTheGroupAndTurnsIt) {
  GaitParams p = walk();
  p.steering = SteeringParams{"legs", 1.0, 0.8, 10.0, 0.03, kPi / 2};
  TwoActuators stage;
  Gait gait(p);
  stage.play(gait, 4);
  EXPECT_EQ(stage.asked, "walker");
  EXPECT_NEAR(gait.state().steering.phase_rad, 0.8, 1e-12) << "it goes along x and should go along y";
}

TEST(OnAnyStage, NothingThatIsNoNumberIsPlayed) {
  GaitParams whole = walk();
  whole.steering = SteeringParams{"legs", 1.0, 0.8, 10.0, 0.03, kPi / 2};
  whole.motion = MotionParams{};
  EXPECT_NO_THROW(Gait{whole});
  for (int n = 0;; ++n) {
    GaitParams p = whole;
    GaitGroup& g = p.groups[0];
    SteeringParams& s = *p.steering;
    double* const numbers[] = {&p.frequency_rad_per_s,
                               &p.ramp_s,
                               &g.amplitude_rad,
                               &g.offset_rad,
                               &g.lambda,
                               &g.delta_rad,
                               &g.preset_rad,
                               &s.gain,
                               &s.limit_rad,
                               &s.slew_rad_per_s,
                               &s.min_travel_m,
                               &*s.target_rad,
                               &p.motion->end_s,
                               &p.motion->loop_from_s.emplace(0)};
    if (n == static_cast<int>(std::size(numbers))) break;
    *numbers[n] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(Gait{p}, InputError) << n;
  }
}

TEST(OnAnyStage, AMotionLeavesWhatHasNoKeyframeYetAlone) {
  TwoActuators stage;
  Gait gait = Gait::load(
      written(replaced(replaced(replaced(replaced(kGoodMotion, "shaft = 0.0", "left = 0.0"), "shaft = 10.0", "left = 10.0"),
                                "shaft = 20.0", "left = 20.0"),
                       "shaft = 90.0", "left = 90.0")));
  stage.told[0] = {0.7, 0.2};
  stage.play(gait, 0.9);
  EXPECT_EQ(stage.sent, 0);
  EXPECT_EQ(stage.told[0].equilibrium_rad, 0.7);
  stage.play(gait, 2.01);
  EXPECT_NEAR(stage.told[0].equilibrium_rad, kPi / 4, 1e-12);
  EXPECT_NEAR(stage.told[0].preset, 20 * kPi / 180, 1e-12);
  EXPECT_EQ(stage.told[1].equilibrium_rad, 0.0);
}

TEST(OnAnyStage, WhatComesBackFromAHandStartsWhereTheStageSaysItStands) {
  TwoActuators stage;
  Gait gait(walk());
  stage.play(gait, 0.5);
  gait.leave("left", {true, true});
  stage.told[0] = {2.0, 0.6};
  stage.play(gait, 1.0);
  EXPECT_EQ(stage.told[0].equilibrium_rad, 2.0) << "the hand's";
  gait.leave("left", {});
  gait.apply(stage);
  EXPECT_NEAR(stage.told[0].equilibrium_rad, 2.0, 1e-12);
  EXPECT_NEAR(stage.told[0].preset, 0.6, 1e-12);
  stage.play(gait, 1.0 + Gait::kGiveBack_s + 0.02);
  EXPECT_NEAR(stage.told[0].preset, 0.3, 1e-12);
}

}  // namespace
}  // namespace vsa::motion
