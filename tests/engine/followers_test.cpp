// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What hangs on a driven joint by <mimic> is foreseen with it (docs/explanation/7-host.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "arm.hpp"

namespace vsa::engine::testing {
namespace {

/// Hinges about y beside each other, of these moments: the first is driven, the others follow it, `multiplier` times as far.
std::string row(const std::string& name, const std::vector<double>& moments, double multiplier) {
  std::string out = "<model name='" + name + "'>";
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const std::string n = std::to_string(i);
    out += "<link name='l" + n + "'><pose>0 " + n + " 0 0 0 0</pose>" + inertial(0.2, moments[i]) + "</link>" +
           hinge("j" + n, "world", "l" + n,
                 i == 0 ? ""
                        : "<mimic joint='j0'><multiplier>" + std::to_string(multiplier) +
                              "</multiplier><offset>0</offset><reference>0</reference></mimic>");
  }
  return out + plugin(actuator("j0")) + "</model>";
}

World load(const std::string& models, double step_s) {
  WorldOptions options;
  options.step_s = step_s;
  std::string sdf = world(models, "0 0 0");
  sdf.replace(sdf.find("1.9"), 3, "1.11");
  return World::load_string(sdf, options);
}

/// What the coupling lost at most in half a second after a kick, over the energy of the kick: below 0 it came out of nothing.
double lost(const std::vector<double>& moments, double multiplier, double step_s) {
  World w = load(row("m", moments, multiplier), step_s);
  w.place("j0", 0.0, 0.75);
  w.robot(0).set_supply(false);
  for (std::size_t i = 0; i < moments.size(); ++i) w.set_joint("m::j" + std::to_string(i), i == 0 ? 0.2 : 0.2 * multiplier, 0);
  double least = 0;
  while (w.time_s() < 0.5) {
    w.step();
    least = std::min(least, w.ledger().coupling);
  }
  return least / w.ledger().stored_at_start;
}

TEST(Followers, OfALightLeaderGiveItHardlyAnyEnergyOutOfNothing) {
  // Without the followers in B it would be 0.7, 2.4, 11 and 47 % at least; with their constraint's pull of the last step instead of
  // this one's 0.1, 0.4, 1.4 and 11 %.
  for (const double step_s : {0.5e-3, 1e-3, 2e-3, 4e-3}) {
    EXPECT_GE(lost({1e-4, 0.1}, 1, step_s), -1e-3) << step_s;
    EXPECT_GE(lost({1e-4, 0.01}, -2, step_s), -1e-3) << step_s;
    EXPECT_GE(lost({1e-4, 0.01, 0.1}, 0.5, step_s), -1e-3) << step_s;
  }
}

TEST(Followers, GoWhereTheirLeaderIsSetAndNowhereElse) {
  World w = load(row("m", {1e-3, 1e-3}, -2), 1e-3);
  w.set_joint("m::j0", 0.2, 0.5);
  EXPECT_EQ(w.joint_angle("m::j1"), -0.4);
  EXPECT_EQ(w.joint_speed("m::j1"), -1.0);
  w.run(0.05);
  EXPECT_NEAR(w.joint_angle("m::j1"), -2 * w.joint_angle("m::j0"), 0.01) << "no kick";
  for (const auto& [angle, speed] : {std::pair{0.3, 0.0}, std::pair{w.joint_angle("m::j1"), 7.0}}) {
    try {
      w.set_joint("m::j1", angle, speed);
      ADD_FAILURE() << angle << ", " << speed;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("follows m::j0"), std::string::npos) << e.what();
    }
  }
  for (const char* joint : {"m::j1", "m::j0", "m::j1"}) EXPECT_NO_THROW(w.set_joint(joint, w.joint_angle(joint), 0)) << joint;
  EXPECT_EQ(w.joint_angle("m::j1"), -2 * w.joint_angle("m::j0"));
}

TEST(Joints, AreNotSetBeyondTheirLimits) {
  World w = World::load_string(passive_arm());  // -3 … 2.5
  for (const double bad : {2.56, -3.06, 100.0}) {
    try {
      w.set_joint("arm::shoulder", bad, 0);
      ADD_FAILURE() << bad;
    } catch (const InputError& e) {
      const std::string text = e.what();
      for (const char* part : {"arm::shoulder", "beyond the joint's limits", "-3 … 2.5"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
  EXPECT_EQ(w.joint_angle("arm::shoulder"), 0);
  EXPECT_NO_THROW(w.set_joint("arm::shoulder", 2.545, 20)) << "as soft as limits are";
  w.step();
  EXPECT_GT(w.joint_angle("arm::shoulder"), 2.55);
  EXPECT_NO_THROW(w.set_joint("arm::shoulder", w.joint_angle("arm::shoulder"), 0)) << "where it is";
}

TEST(Followers, SwingTheirLeaderAsTheirInertiaWouldByItself) {
  // m: 1e-4 and a follower of 2e-3 that goes three times as far. one: 1e-4 + 9·2e-3 at the joint.
  World tied = load(row("m", {1e-4, 2e-3}, 3), 1e-3), one = load(row("m", {1e-4 + 9 * 2e-3}, 1), 1e-3);
  double turned = 0;
  for (World* w : {&tied, &one}) {
    w->place("j0", 0.0, 0.4);
    w->robot(0).set_supply(false);
  }
  tied.set_joint("m::j0", 0.1, 0);
  tied.set_joint("m::j1", 0.3, 0);
  one.set_joint("m::j0", 0.1, 0);
  const auto shaft = [](const World& w) { return w.read(w.actuators().front()).shaft_rad; };
  double apart = 0;
  while (one.time_s() < 0.4) {
    tied.step();
    one.step();
    apart = std::max(apart, std::abs(shaft(tied) - shaft(one)));
    turned = std::max(turned, 0.1 - shaft(one));
  }
  EXPECT_GT(turned, 0.09) << "it has swung as far as its frictions let it";
  EXPECT_LT(apart, 0.004) << "an equality of 4 ms gives way a little";
}

/// A leader that is put elsewhere takes its followers along, or their equality pulls it back.
TEST(Followers, GoAlongWhereTheirLeaderIsPlaced) {
  World w = load(row("m", {1e-3, 1e-3, 1e-4}, -2.0), 0.001);
  w.place("j0", 0.4, 0.3, 0.1);
  EXPECT_NEAR(w.joint_angle("m::j1"), -0.8, 1e-12);
  EXPECT_NEAR(w.joint_angle("m::j2"), -0.8, 1e-12);
  EXPECT_NEAR(w.joint_speed("m::j1"), -0.2, 1e-12);
  w.place("j0", 0.4, 0.3);
  double fastest = 0;
  for (int n = 0; n < 200; ++n) {
    w.step();
    fastest = std::max(fastest, std::abs(w.read("j0").shaft_speed_rad_per_s));
  }
  EXPECT_LT(fastest, 0.1);
}

}  // namespace
}  // namespace vsa::engine::testing
