// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A gait that is held, in the middle of whatever it does, and goes on: no command jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "motion/two_actuators.hpp"

namespace vsa::motion {
namespace {

constexpr double kPeriod_s = 0.01;

GaitParams slow_to_start() {
  GaitParams p = walk();
  p.ramp_s = 2;
  return p;
}

GaitParams keyframes() {
  GaitParams p;
  p.motion = MotionParams{true, 3, 1.0, {{"left", {{0, 0}, {1, 0.8}, {2, -0.8}, {3, 0.8}}, {{0, 0.1}, {3, 0.5}}}}};
  return p;
}

/// What is done while the gait plays; each at its time.
struct Deed {
  double at_s;
  std::function<void(Gait&, double t_s)> what;
};

/// The largest step between two commands of an actuator, from 0 to 8 s.
double largest_step(const GaitParams& params, const std::vector<Deed>& deeds) {
  TwoActuators stage;
  Gait gait(params);
  double largest = 0;
  std::array<Commanded, 2> before{};
  for (double t_s = 0; t_s < 8; t_s += kPeriod_s) {
    for (const Deed& deed : deeds)
      if (std::abs(deed.at_s - t_s) < 1e-6) deed.what(gait, t_s);
    stage.play(gait, t_s + kPeriod_s);
    for (std::size_t i = 0; i < 2 && t_s > 0; ++i) {
      largest = std::max(largest, std::abs(stage.told[i].equilibrium_rad - before[i].equilibrium_rad));
      largest = std::max(largest, std::abs(stage.told[i].preset - before[i].preset));
    }
    before = stage.told;
  }
  return largest;
}

const auto hold = [](Gait& gait, double t_s) { gait.hold(t_s); };
const auto resume = [](Gait& gait, double t_s) { gait.resume(t_s); };
const auto other_values = [](Gait& gait, double t_s) {
  GaitChange to = gait.values();
  to.groups[0].offset_rad += 0.5;
  to.groups[0].amplitude_rad *= 1.5;
  to.frequency_rad_per_s *= 1.2;
  gait.change(to, t_s);
};

TEST(HeldGait, GoesOnWithoutAJumpWhereverItWasHeld) {
  const double ramping = largest_step(slow_to_start(), {}), walking = largest_step(walk(), {{2, other_values}});
  ASSERT_GT(ramping, 0.01);
  EXPECT_LT(largest_step(slow_to_start(), {{0.4, hold}, {2.7, resume}}), 1.01 * ramping) << "in its ramp";
  EXPECT_LT(largest_step(walk(), {{2, hold}, {3, other_values}, {5.2, resume}}), 1.01 * walking) << "changed while it stood";
  EXPECT_LT(largest_step(walk(), {{2, other_values}, {2.1, hold}, {5.2, resume}}), 1.01 * walking) << "in a change";
  EXPECT_LT(largest_step(walk(), {{1, hold}, {1.7, resume}, {2, other_values}, {2.5, hold}, {6, resume}}), 1.01 * walking)
      << "twice";
}

TEST(HeldGait, KeyframesGoOnWithoutAJumpToo) {
  const double playing = largest_step(keyframes(), {});
  ASSERT_GT(playing, 0.01);
  EXPECT_LT(largest_step(keyframes(), {{0.4, hold}, {2.1, resume}}), 1.01 * playing);
  EXPECT_LT(largest_step(keyframes(), {{5, hold}, {6.3, resume}}), 1.01 * playing) << "in its loop";
}

TEST(HeldGait, StandsAndThenDoesWhatItWouldHaveDone) {
  TwoActuators once, held;
  Gait a(slow_to_start()), b(slow_to_start());
  once.play(a, 0.5);
  held.play(b, 0.5);
  b.hold(0.5);
  const auto before = held.told;
  held.play(b, 1.5);
  EXPECT_EQ(held.told[0].equilibrium_rad, before[0].equilibrium_rad);
  b.resume(1.5);
  once.play(a, 3);
  held.play(b, 4);
  EXPECT_NEAR(held.told[0].equilibrium_rad, once.told[0].equilibrium_rad, 1e-9);
}

TEST(HeldGait, OfAKeyframeAHandTakesAndGivesBackAnActuator) {
  TwoActuators stage;
  Gait gait(keyframes());
  stage.play(gait, 0.5);
  EXPECT_FALSE(gait.leave("right", {true, true})) << "has no keyframe";
  ASSERT_TRUE(gait.leave("left", {true, false}));
  stage.told[0].equilibrium_rad = 0.3;
  stage.play(gait, 1.5);
  EXPECT_EQ(stage.told[0].equilibrium_rad, 0.3) << "the hand's";
  EXPECT_GT(stage.told[0].preset, 0.2) << "not the hand's";
  ASSERT_TRUE(gait.leave("left", {}));
  gait.apply(stage);
  EXPECT_NEAR(stage.told[0].equilibrium_rad, 0.3, 1e-9) << "begins where the hand left it";
  TwoActuators alone;
  Gait undisturbed(keyframes());
  stage.play(gait, 2.6);
  alone.play(undisturbed, 2.6);
  EXPECT_NEAR(stage.told[0].equilibrium_rad, alone.told[0].equilibrium_rad, 1e-9);
}

TEST(Gait, BeginsAnewWhenTimeGoesBackWithinOneControlPeriod) {
  GaitParams p = walk();
  p.period_ns = 1'000'000'000;
  TwoActuators stage;
  Gait gait(p);
  stage.now_ns = 300'000'000;
  gait.apply(stage);
  EXPECT_EQ(stage.sent, 2);
  stage.now_ns = 0;
  gait.apply(stage);
  EXPECT_EQ(stage.sent, 4);
  EXPECT_NEAR(stage.told[0].equilibrium_rad, 0.1, 1e-12) << "at 0 s";
}

TEST(Gait, RefusesOneActuatorUnderTwoNames) {
  struct Renamed : TwoActuators {
    std::size_t find_actuator(std::string_view name) const override {
      return TwoActuators::find_actuator(name == "walker/left" ? "left" : name);
    }
  } stage;
  GaitParams p = walk();
  p.groups.push_back({"again", {"walker/left"}, {0}, 0.5, 0.1, 1.0, 0.0, 0.3});
  Gait gait(p);
  try {
    gait.bind(stage);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("group.again.actuators = walker/left: is listed twice, here and as left"),
              std::string::npos)
        << error.what();
  }
}

TEST(Gait, RefusesWhatNoFileMaySay) {
  const auto refused = [](auto&& spoil) {
    GaitParams p = keyframes();
    spoil(p);
    EXPECT_THROW(Gait{p}, InputError);
  };
  refused([](GaitParams& p) { p.motion->tracks[0].equilibrium[1].value_rad = NAN; });
  refused([](GaitParams& p) { p.motion->tracks[0].preset[1].time_s = NAN; });
  refused([](GaitParams& p) { p.motion->tracks[0].equilibrium[2].time_s = 1; });
  refused([](GaitParams& p) { p.motion->loop_from_s = 3; });
  refused([](GaitParams& p) { p.motion->tracks.push_back({"right", {}, {}}); });
  GaitParams p = walk();
  p.steering = SteeringParams{"arms", 1.0, 0.8, 10.0, 0.03, 0.0};
  EXPECT_THROW(Gait{p}, InputError) << "no such group";
}

}  // namespace
}  // namespace vsa::motion
