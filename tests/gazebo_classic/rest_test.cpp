// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Chains that are left alone come to rest in Gazebo Classic, with either engine; every one with VSA_TEST_LONG.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chain/gazebo_rest.hpp"
#include "classic_world.hpp"

namespace vsa::test {
namespace {

Rest left_alone(const RestCase& c, double seconds, const std::string& engine) {
  RobotWorld w("rest", serial_model(c.chain), engine, "", c.chain.gravity);
  w.world->Physics()->SetMaxStepSize(c.chain.step_s);
  prepare_rest(w.robot(), c);
  std::vector<gazebo::physics::JointPtr> joints;
  for (int i = c.chain.first_driven(); c.chain.drives(i); ++i) joints.push_back(w.joint("m", "j" + std::to_string(i)));
  RestMeter meter(joints.size());
  const int steps = static_cast<int>(std::lround(seconds / c.chain.step_s));
  const int measured = static_cast<int>(std::lround(kMeasured_s / c.chain.step_s));
  int step = 0;
  const auto end = gazebo::event::Events::ConnectWorldUpdateEnd([&] {
    const bool count = ++step > steps - measured;
    for (std::size_t i = 0; i < joints.size(); ++i) sample_rest(meter, w.robot(), i, joints[i]->GetVelocity(0), count);
  });
  w.run(steps);
  EXPECT_EQ(step, steps);
  return rest_of(meter, w.robot());
}

class RestMatrix : public testing::TestWithParam<std::string> {};

TEST_P(RestMatrix, ChainsOfModulesAreQuiet) {
  const auto run = [](const RestCase& c, double seconds) { return left_alone(c, seconds, GetParam()); };
  expect_gazebo_quiet(run, long_run(), "Gazebo Classic, " + GetParam());
}

GazeboRun of_engine(const std::string& engine) {
  return [engine](const RestCase& c, double seconds) { return left_alone(c, seconds, engine); };
}

/// With 1 N·m·s/rad ODE's explicit damper is more than it can take itself on such links.
TEST_P(RestMatrix, ChainsWithDampersAtTheirJointsAreQuiet) {
  const std::vector<double> dampings = GetParam() == "ode" ? std::vector{0.03, 0.1} : std::vector{0.03, 0.1, 1.0};
  expect_gazebo_quiet_with_dampers(of_engine(GetParam()), "Gazebo Classic, " + GetParam(), dampings);
}

TEST_P(RestMatrix, IsQuietBesideSpringsPassiveJointsAndHeavyLoads) {
  const bool dart = GetParam() == "dart";
  expect_gazebo_quiet_beside(of_engine(GetParam()), "Gazebo Classic, " + GetParam(), dart, !dart);
}

TEST(RestMatrixOfOde, IsQuietBesideImplicitSpringsPassiveJointsAndHeavyLoads) {
  expect_gazebo_quiet_beside(of_engine("ode"), "Gazebo Classic, ode, implicit", true, true);
}

TEST(RestMatrixOfOde, ChainsWithImplicitDampersAreQuiet) {
  expect_gazebo_quiet_with_dampers(of_engine("ode"), "Gazebo Classic, ode, implicit", {0.03, 0.1, 1.0}, true);
}

double speed_after_a_step(const SerialWorld& chain, const std::string& engine) {
  ClassicWorld w(world_sdf("damper", without(serial_model(chain), "<plugin", "</plugin>"), false), engine);
  w.joint("m", "j1")->SetVelocity(0, 1);
  w.run(1);
  return w.joint("m", "j1")->GetVelocity(0);
}

TEST_P(RestMatrix, ADamperIsImplicitWhereBSaysSo) {
  const auto run = [](const SerialWorld& chain) { return speed_after_a_step(chain, GetParam()); };
  expect_left_by_damper(run, GetParam() == "dart");
  SerialWorld asked;
  asked.implicit_damper = true;
  expect_left_by_damper(run, true, asked);
}

INSTANTIATE_TEST_SUITE_P(Engines, RestMatrix, testing::Values("ode", "dart"), [](const auto& c) { return c.param; });

}  // namespace
}  // namespace vsa::test
