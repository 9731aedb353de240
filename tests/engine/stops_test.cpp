// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How far a joint rests beyond its stop.
#include "worlds.hpp"

namespace vsa::engine::testing {
namespace {

/// A link of `moment` about its hinge, pushed against its stop at 0.2 rad by a spring that is far from its rest.
double beyond_stop(double moment, double torque) {
  constexpr double kStiffness = 1.0;
  World w = World::load_string(
      world("<model name='m'><link name='base'>" + inertial(1, 0.1) + "</link><link name='arm'>" + inertial(0.1, moment) +
                "</link><joint name='fix' type='fixed'><parent>world</parent><child>base</child></joint><joint name='hinge' "
                "type='revolute'>"
                "<parent>base</parent><child>arm</child><axis><xyz>0 1 "
                "0</xyz><limit><lower>-1</lower><upper>0.2</upper></limit><dynamics>"
                "<spring_stiffness>" +
                std::to_string(kStiffness) + "</spring_stiffness><spring_reference>" + std::to_string(0.2 + torque / kStiffness) +
                "</spring_reference></dynamics></axis></joint></model>",
            "0 0 0"));
  w.run(1.0);
  EXPECT_LT(std::abs(w.joint_speed("m::hinge")), 1e-6);
  return w.joint_angle("m::hinge") - 0.2;
}

TEST(Stops, ALoadedStopGivesByWhatItsTimeConstantSays) {
  // MuJoCo's soft constraint at rest: (1 − d) d T² τ/I with d = 0.95, T = 4 ms, beyond 1 mrad; the stop holds an acceleration.
  for (const double torque : {4.0, 8.0}) {
    const double expected = 0.05 * 0.95 * 0.004 * 0.004 * torque / 2e-3;
    EXPECT_NEAR(beyond_stop(2e-3, torque), expected, 0.2 * expected) << torque;
  }
}

TEST(Stops, AnArmsStopGivesByLessThanATenthOfADegree) { EXPECT_LT(beyond_stop(0.02, 10.0), 1e-3); }

}  // namespace
}  // namespace vsa::engine::testing
