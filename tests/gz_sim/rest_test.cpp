// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Chains that are left alone come to rest in gz-sim; every one with VSA_TEST_LONG.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "chain/gazebo_rest.hpp"
#include "gz_world.hpp"

namespace vsa::test {
namespace {

Rest left_alone(const RestCase& c, double seconds) {
  std::string model = serial_model(c.chain);
  OwnRobot own(model, "m");
  own.first = [&](host::Robot& robot) { prepare_rest(robot, c); };
  SimWorld w(sdf_text(world_text(model, {.step_s = c.chain.step_s, .gravity = c.chain.gravity})));
  w.probes[0]->before = [&](const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) { own.before_step(info, ecm); };
  std::vector<sim::Entity> joints;
  for (int i = c.chain.first_driven(); c.chain.drives(i); ++i) {
    const auto found = sim::entitiesFromScopedName("m::j" + std::to_string(i), w.ecm());
    if (found.empty()) throw std::runtime_error("no joint j" + std::to_string(i));
    joints.push_back(*found.begin());
  }
  RestMeter meter(joints.size());
  const int steps = static_cast<int>(std::lround(seconds / c.chain.step_s));
  const int measured = static_cast<int>(std::lround(kMeasured_s / c.chain.step_s));
  int step = 0;
  w.probes[0]->after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager& ecm) {
    const bool count = ++step > steps - measured;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto* speed = ecm.Component<components::JointVelocity>(joints[i]);
      const bool told = speed != nullptr && !speed->Data().empty();
      ASSERT_TRUE(told || !count) << "no physics moves it";
      sample_rest(meter, own.robot(), i, told ? speed->Data().front() : 0, count);
    }
  };
  w.run(steps);
  EXPECT_EQ(step, steps);
  return rest_of(meter, own.robot());
}

TEST(GzSimRestMatrix, ChainsOfModulesAreQuiet) {
  expect_gazebo_quiet(left_alone, std::getenv("VSA_TEST_LONG") != nullptr, "gz-sim");
}

TEST(GzSimRestMatrix, ChainsWithDampersAtTheirJointsAreQuiet) {
  expect_gazebo_quiet_with_dampers(left_alone, "gz-sim", {0.03, 0.1, 1.0});
}

TEST(GzSimRestMatrix, IsQuietBesideSpringsPassiveJointsAndHeavyLoads) { expect_gazebo_quiet_beside(left_alone, "gz-sim", true); }

TEST(GzSimRestMatrix, ADamperIsImplicitAsBSays) {
  const auto speed_after_a_step = [](const SerialWorld& chain) {
    SimWorld w(sdf_text(world_text(without_plugin(serial_model(chain)), {.step_s = chain.step_s, .gravity = false})));
    w.run(1);
    w.set_speed("m", 1, "j1");
    // Its component is filled only where somebody asks for it.
    w.ecm().CreateComponent(*sim::entitiesFromScopedName("m::j1", w.ecm()).begin(), components::JointVelocity());
    w.run(1);
    return w.speed("m", "j1");
  };
  expect_left_by_damper(speed_after_a_step, true);
}

}  // namespace
}  // namespace vsa::test
