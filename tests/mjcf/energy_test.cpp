// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The energy of what only MJCF has: springs of balls, of free bodies and of tendons, and flags that switch forces off.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "vsa/engine/world.hpp"

namespace vsa::engine {
namespace {

/// A body whose centre is off its joint, in gravity.
World body(const std::string& joint, const std::string& flags = "", const std::string& more = "") {
  return World::load_string(
      "<mujoco model='m'><option timestep='0.0002'><flag " + flags + "/></option><worldbody><body name='a'><joint name='j' " +
      joint + "/><inertial pos='0.3 0.05 0' mass='0.5' diaginertia='0.002 0.003 0.004'/></body></worldbody>" + more + "</mujoco>");
}

struct Seen {
  double least = 1e300, most = -1e300, springs = 0, kinetic = 0;  ///< of the sum; of the largest there were
};

Seen seen_in(World& w, int steps) {
  Seen out;
  for (int k = 0; k < steps; ++k) {
    w.step();
    const scene::Energy e = w.energy();
    out.least = std::min(out.least, e.kinetic + e.gravitational + e.springs);
    out.most = std::max(out.most, e.kinetic + e.gravitational + e.springs);
    out.springs = std::max(out.springs, e.springs);
    out.kinetic = std::max(out.kinetic, e.kinetic);
  }
  return out;
}

TEST(MjcfEnergy, SpringsOfBallsAndFreeBodiesKeepIt) {
  for (const char* joint : {"type='ball' stiffness='2'", "type='free' stiffness='20'", "type='hinge' axis='0 1 0' stiffness='2'"}) {
    World w = body(joint);
    const Seen s = seen_in(w, 5000);
    EXPECT_GT(s.springs, 0.5) << joint << ": it is stretched";
    EXPECT_LT(s.most - s.least, 2e-3 * s.springs) << joint;
  }
}

TEST(MjcfEnergy, ATendonsSpringIsPartOfIt) {
  World w = body("type='slide' axis='0 0 1'", "gravity='disable'",
                 "<tendon><fixed name='t' stiffness='50'><joint joint='j' coef='2'/></fixed></tendon>");
  w.set_joint("m::j", 0.1, 0);
  EXPECT_NEAR(w.energy().springs, 50 * 0.2 * 0.2 / 2, 1e-12);
  const Seen s = seen_in(w, 3000);
  EXPECT_LT(s.most - s.least, 1e-3 * s.springs);
}

TEST(MjcfEnergy, CountsNothingThatAFlagSwitchesOff) {
  World floats = body("type='slide' axis='0 0 1'", "gravity='disable'");
  floats.set_joint("m::j", 0, 1);
  const Seen s = seen_in(floats, 1000);
  EXPECT_EQ(floats.energy().gravitational, 0);
  EXPECT_NEAR(s.kinetic, 0.25, 1e-12);
  EXPECT_LT(s.most - s.least, 1e-12);
  World slack = body("type='hinge' axis='0 1 0' stiffness='5'", "passive='disable'",
                     "<tendon><fixed name='t' stiffness='50'><joint joint='j' coef='2'/></fixed></tendon>");
  slack.set_joint("m::j", 0.4, 0);
  EXPECT_EQ(slack.energy().springs, 0);
  const Seen swung = seen_in(slack, 1000);
  EXPECT_GT(swung.kinetic, 0.1);
  EXPECT_LT(swung.most - swung.least, 1e-3);
}

}  // namespace
}  // namespace vsa::engine
