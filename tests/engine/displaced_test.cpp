// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A model that is put elsewhere and turned goes on as it would have, there.
#include <gtest/gtest.h>

#include <cmath>

#include "arm.hpp"

namespace vsa::engine::testing {
namespace {

/// A body of 2 kg that stands on three balls on the floor, with a driven arm on it.
std::string standing() {
  std::string feet;
  for (const auto& [x, y] : {std::pair{0.2, 0.0}, {-0.1, 0.15}, {-0.1, -0.15}})
    feet += "<collision name='c" + std::to_string(x + 10 * y) + "'><pose>" + std::to_string(x) + " " + std::to_string(y) +
            " -0.1 0 0 0</pose><geometry><sphere><radius>0.02</radius></sphere></geometry></collision>";
  return world(floor_model() + "<model name='m'><pose>0 0 0.12 0 0 0</pose><link name='body'>" + inertial(2, 0.02) + feet +
               "</link><link name='l'>" + inertial(0.3, 1e-3, "0.1 0 0 0 0 0") + "</link>" + hinge("j", "body", "l") +
               plugin(actuator("j")) + "</model>");
}

TEST(Displaced, AModelThatStandsGoesOnStandingWhateverWayItIsTurned) {
  for (const double yaw : {0.0, 1.0, 1.5707963267948966}) {
    World here = World::load_string(standing()), there = World::load_string(standing());
    for (World* w : {&here, &there}) {
      w->command("j", -0.4, 0.3);
      w->run(1.0);
    }
    there.displace_model("m", yaw, {1, 2, 0});
    for (const int steps : {1, 1, 10, 100}) {
      for (int k = 0; k < steps; ++k) {
        here.step();
        there.step();
      }
      EXPECT_NEAR(there.joint_angle("m::j"), here.joint_angle("m::j"), 1e-9) << yaw;
      EXPECT_NEAR(there.joint_speed("m::j"), here.joint_speed("m::j"), 1e-7) << yaw;
    }
  }
}

}  // namespace
}  // namespace vsa::engine::testing
