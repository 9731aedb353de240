// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Joints that an MJCF's <equality><joint> lets follow another: by a polynomial, from where both start.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "vsa/engine/world.hpp"

namespace vsa::engine {
namespace {

/// Two bodies beside each other; k follows j, which an actuator drives, and l follows k.
World row(double leader_start, double follower_start, const std::string& polynomial) {
  const auto body = [](const std::string& name, double x, double start) {
    return "<body name='b" + name + "' pos='" + std::to_string(x) + " 0 0'><joint name='" + name + "' axis='0 1 0' ref='" +
           std::to_string(start) + "'/><inertial pos='0 0 -0.1' mass='0.05' diaginertia='1e-4 1e-4 1e-4'/></body>";
  };
  return World::load_string(
      "<mujoco model='m'><compiler angle='radian'/><option timestep='0.001' gravity='0 0 0'/><worldbody>" +
      body("j", 0, leader_start) + body("k", 1, follower_start) + body("l", 2, 0) +
      "</worldbody><equality><joint joint1='k' joint2='j' polycoef='" + polynomial + "'/><joint joint1='l' joint2='k' polycoef='" +
      std::to_string(-2 * follower_start) +
      " -2 0 0 0'/></equality><custom><text name='vsa::Robot' data=\"&lt;plugin name='vsa::Robot'&gt;&lt;actuator&gt;&lt;joint&gt;j"
      "&lt;/joint&gt;&lt;type&gt;qbmove_maker_pro_6_1&lt;/type&gt;&lt;/actuator&gt;&lt;/plugin&gt;\"/></custom></mujoco>");
}

TEST(MjcfFollowers, StandAndTurnWithALeaderThatIsPlacedWhereMuJoCoHoldsThem) {
  struct Case {
    double leader, follower;
    std::string polynomial;
    double at, slope;  ///< of the leader at 0.8, by hand
  };
  for (const auto& [leader, follower, polynomial, at, slope] :
       {Case{0, 0, "0 2 0 0 0", 1.6, 2}, Case{0.5, 0, "0 2 0 0 0", 0.6, 2}, Case{0.5, -0.25, "0.1 2 0 0 0", 0.45, 2},
        Case{0, 0, "0 0 1 0 0", 0.64, 1.6}, Case{0.3, 0.2, "0.1 0 1 -2 3", 0.1 + 0.25 - 0.25 + 0.1875 + 0.2, 1 - 1.5 + 1.5}}) {
    World w = row(leader, follower, polynomial);
    w.place("j", 0.8, 0.3, 0.5);
    EXPECT_NEAR(w.joint_angle("m::k"), at, 1e-12) << polynomial;
    EXPECT_NEAR(w.joint_speed("m::k"), slope * 0.5, 1e-12) << polynomial;
    EXPECT_NEAR(w.joint_angle("m::l"), -2 * at, 1e-12) << "who follows a follower";
    EXPECT_NEAR(w.joint_speed("m::l"), -slope, 1e-12) << polynomial;
    w.step();
    EXPECT_NEAR(w.joint_speed("m::j"), 0.5, 0.02) << polynomial << ": no constraint pulls it";
    EXPECT_NEAR(w.joint_speed("m::k"), slope * 0.5, 0.05) << polynomial;
  }
}

}  // namespace
}  // namespace vsa::engine
