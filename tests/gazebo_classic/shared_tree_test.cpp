// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An arm and the hand at its end, a plug-in each, are one kinematic tree: left alone it comes to rest as with one plug-in.
#include "chain/shared_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "classic_world.hpp"

namespace vsa::test {
namespace {

LateSpeed left_alone(const std::string& model, const std::vector<std::string>& names, double step_s, const std::string& engine) {
  ClassicWorld w(world_sdf("shared", model, false), engine);
  w.world->Physics()->SetMaxStepSize(step_s);
  std::vector<gazebo::physics::JointPtr> joints;
  for (const std::string& name : names) {
    const auto found = boost::dynamic_pointer_cast<gazebo::physics::Joint>(w.world->BaseByName("m::" + name));
    if (!found) throw std::runtime_error("no joint " + name);
    found->SetPosition(0, kAside_rad);
    joints.push_back(found);
  }
  LateSpeed out(kLateFrom_s);
  double t_s = 0;
  const auto end = gazebo::event::Events::ConnectWorldUpdateEnd([&] {
    t_s += step_s;
    for (const auto& joint : joints) out.add(t_s, joint->Position(0), joint->GetVelocity(0));
  });
  w.run(static_cast<int>(std::lround(kSharedTree_s / step_s)));
  return out;
}

class SharedTree : public testing::TestWithParam<std::string> {};

TEST_P(SharedTree, WithAPlugInAPartRestsAsWithOneForAll) {
  const auto run = [](const std::string& model, const std::vector<std::string>& joints, double step_s) {
    return left_alone(model, joints, step_s, GetParam());
  };
  expect_rest_whatever_drives(run, GetParam() != "dart");  // "Nested models are not currently supported in DART", it says
}

INSTANTIATE_TEST_SUITE_P(Engines, SharedTree, testing::Values("ode", "dart"), [](const auto& c) { return c.param; });

TEST(SharedTreePlugins, OneThatIsTakenAwayLeavesTheOtherHoldingItsJoint) {
  SerialWorld chain;
  chain.robots = {1, 1};
  std::string model = serial_model(chain);
  const auto second = model.rfind("<plugin");
  const std::string of_second = model.substr(second, model.find("</model>") - second);
  model.erase(second, of_second.size());
  ClassicWorld w(world_sdf("leaves", without(model, "<plugin", "</plugin>"), false));
  const auto first = load_robot(w.world, model);
  auto other = load_robot(w.world, without(model, "<plugin", "</plugin>").insert(model.find("<plugin"), of_second));
  ASSERT_NE(first->seat(), nullptr);
  ASSERT_NE(other->seat(), nullptr);
  w.joint("m", "j1")->SetPosition(0, 0.2);
  w.run(200);
  other.reset();
  first->seat()->robot().command(0, 0.5, std::nullopt);
  w.run(2000);
  EXPECT_GT(w.angle("m", "j1"), 0.35) << "it follows its command";
  EXPECT_FALSE(first->seat()->stopped());
}

}  // namespace
}  // namespace vsa::test
