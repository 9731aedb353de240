// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Kinematic loops of an MJCF as its author wrote it, by <connect>.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "vsa/engine/world.hpp"

namespace vsa::engine {
namespace {

/// A parallelogram whose crank o has an actuator, and beside it a joint k, also with one, which `more` may hold.
World parallelogram(const std::string& size, const std::string& more = {}) {
  const std::string inertia = "<inertial pos='0 0 0.05' mass='0.2' diaginertia='1e-3 1e-3 1e-4'/>",
                    actuator = "&lt;actuator&gt;&lt;joint&gt;",
                    type =
                        "&lt;/joint&gt;&lt;type&gt;qbmove_maker_pro_6_1&lt;/type&gt;"
                        "&lt;/actuator&gt;";
  return World::load_string(
      "<mujoco model='m'>" + size +
      "<option timestep='0.001' gravity='0 0 0'/><worldbody><body name='crank'><joint name='o' axis='0 1 0'/>" + inertia +
      "<body name='coupler' pos='0 0 0.1'><joint name='a' axis='0 1 0'/>" + inertia +
      "</body></body><body name='rocker' pos='0.3 0 0'><joint name='p' axis='0 1 0'/>" + inertia +
      "</body><body name='lone' pos='0 1 0'><joint name='k' axis='0 1 0'/>" + inertia +
      "</body></worldbody><equality><connect body1='coupler' body2='rocker' anchor='0.3 0 0'/>" + more +
      "</equality><custom><text name='vsa::Robot' data=\"&lt;plugin name='vsa::Robot'&gt;" + actuator + "o" + type + actuator +
      "k" + type + "&lt;/plugin&gt;\"/></custom></mujoco>");
}

TEST(MjcfLoops, GoAlongWithAJointThatIsPut) {
  for (const char* size : {"", "<size njmax='1' nconmax='1'/>"}) {
    World w = parallelogram(size);
    w.place("o", 0.7, 0.3);
    EXPECT_NEAR(w.joint_angle("m::p"), 0.7, 1e-7) << size;
    EXPECT_NEAR(w.joint_angle("m::a"), -0.7, 1e-7) << size;
    double fastest = 0;
    for (int n = 0; n < 50; ++n) w.step(), fastest = std::max(fastest, w.energy().kinetic);
    EXPECT_LT(fastest, 1e-6) << size;
  }
}

TEST(MjcfLoops, ALockElsewhereHoldsNothingUp) {
  World w = parallelogram("", "<joint joint1='k'/>");
  EXPECT_NO_THROW(w.place("k", 0.5, 0.3)) << "the constraint pulls it back";
  EXPECT_EQ(w.joint_angle("m::k"), 0.5);
  EXPECT_NO_THROW(w.place("o", 0.5, 0.3));
  World held = parallelogram("", "<joint joint1='p'/>");
  EXPECT_THROW(held.place("o", 0.5, 0.3), InputError) << "a lock in the loop does";
}

}  // namespace
}  // namespace vsa::engine
