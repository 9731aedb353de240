// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A model that is put elsewhere and turned goes on as it would have, there.
#include <gtest/gtest.h>

#include <cmath>

#include "arm.hpp"

namespace vsa::engine::testing {
namespace {

/// A body of 1 kg on four legs, which push outwards on the floor.
std::string standing() {
  std::string legs, actuators;
  for (int k = 0; k < 4; ++k) {
    const std::string n = std::to_string(k), x = k < 2 ? "0.15" : "-0.15", y = k % 2 == 0 ? "0.1" : "-0.1";
    legs += "<link name='l" + n + "'><pose>" + x + " " + y + " 0 0 0.4 0</pose>" + inertial(0.1, 1e-4, "0 0 -0.05 0 0 0") +
            "<collision name='c'><pose>0 0 -0.1 0 0 0</pose><geometry><sphere><radius>0.02</radius></sphere></geometry></collision>"
            "</link>" +
            hinge("j" + n, "body", "l" + n);
    actuators += actuator("j" + n, "qbmove_maker_pro_6_1", k + 1);
  }
  return world(floor_model() + "<model name='m'><pose>0 0 0.115 0 0 0</pose><link name='body'>" + inertial(1, 0.01) + "</link>" +
               legs + plugin(actuators) + "</model>");
}

TEST(Displaced, AModelGoesOnTheSameWayWhereverItIsPutAndTurned) {
  constexpr double kRounding = 3e-10;  // rad/s; what pushed it in the axes of before makes 1e-8
  for (const double yaw : {0.0, 1.0, 1.5707963267948966}) {
    World here = World::load_string(standing()), there = World::load_string(standing());
    for (World* w : {&here, &there}) {
      for (int k = 0; k < 4; ++k) w->command("j" + std::to_string(k), k % 2 == 0 ? 0.2 : -0.2, 0.1);
      w->run(0.6);
    }
    there.displace_model("m", yaw, {1, 2, 0});
    for (int steps = 0; steps < 20; ++steps) {
      here.step();
      there.step();
      for (int k = 0; k < 4; ++k) {
        const std::string joint = "m::j" + std::to_string(k);
        ASSERT_NEAR(there.joint_speed(joint), here.joint_speed(joint), kRounding) << yaw << ", step " << steps;
      }
    }
    EXPECT_GE(there.contact_count(), 4);
  }
}

}  // namespace
}  // namespace vsa::engine::testing
