// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The plug-in as gz-sim loads it from a world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gz_messages.hpp"
#include "gz_world.hpp"
#include "support/press.hpp"

namespace vsa::test {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

/// Far more than friction holds, far less than the springs' end.
void expect_hanging(double angle) {
  EXPECT_GT(std::abs(angle), 5 * kDegree);
  EXPECT_LT(std::abs(angle), 60 * kDegree);
}

TEST(GzSim, ALoadHangsFromTheModulesSpringsAndNotFromNothing) {
  SimWorld w(sdf_text(world_text(bench("bench", kLevel))));
  const auto q = w.record("bench", 2000);
  ASSERT_EQ(q.size(), 2000u);
  for (const double angle : q) ASSERT_TRUE(std::isfinite(angle));
  expect_hanging(q.back());
  EXPECT_NEAR(q.back(), q[q.size() - 200], 0.01) << "at rest by now";
}

TEST(GzSim, TheSameRunTwiceGivesTheSameBits) {
  const std::string sdf = sdf_text(world_text(bench("bench", kLevel)));
  const auto first = SimWorld(sdf).record("bench", 500);
  const auto second = SimWorld(sdf).record("bench", 500);
  EXPECT_GT(std::abs(first.back()), 0.01);
  EXPECT_EQ(first, second);
}

TEST(GzSim, ALinearActuatorHoldsAPlateOnASlide) {
  SimWorld w(sdf_text(world_text(press_model("prismatic", "linear_sea_example"))));
  w.run(5000);
  EXPECT_NEAR(w.angle("press", "slide"), -kPressSag_m, kPressSlack_m);
  testing::internal::CaptureStderr();
  SimWorld(sdf_text(world_text(press_model("prismatic", "sea_example")))).run(1);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_NE(log.find("is prismatic: sea_example turns its joint"), std::string::npos) << log;
}

TEST(GzSim, TwoModelsOfAWorldDontKnowOfEachOther) {
  SimWorld w(sdf_text(world_text(bench("one", kLevel) + bench("two", kLevelAside))));
  std::vector<double> one, two;
  w.probes[0]->after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager&) {
    one.push_back(w.angle("one"));
    two.push_back(w.angle("two"));
  };
  w.run(1000);
  EXPECT_GT(std::abs(one.back()), 0.01);
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], two[i], 1e-6) << i;
}

TEST(GzSim, TwoWorldsOfAServerDontKnowOfEachOther) {
  // A server steps its worlds in a thread each, and DART initialises ODE in the first step of each without a lock: two at once
  // abort the process (gz-sim's issue 18). One that lives, and has stepped, keeps it initialised.
  SimWorld first(sdf_text(world_text(bench("arm", kLevel), {.name = "first"})));
  first.run(1);
  const auto worlds = world_text(bench("arm", kLevel), {.name = "soft"}) +
                      world_text(replaced(bench("arm", kLevel), "preset_rad=\"0.2\"", "preset_rad=\"0.6\""), {.name = "stiff"});
  SimWorld w(sdf_text(worlds), 2);
  w.run(2000);
  const double soft = std::abs(w.angle("arm", "shaft", 0)), stiff = std::abs(w.angle("arm", "shaft", 1));
  expect_hanging(soft);
  EXPECT_GT(stiff, 0.001);
  EXPECT_LT(stiff, 0.8 * soft);
}

TEST(GzSim, OtherJointsOfTheModelAreLeftAlone) {
  const std::string extra =
      "<link name='pendulum'><pose>0 0 -0.3 0 0 0</pose><inertial><mass>0.1</mass><inertia><ixx>1e-4</ixx><iyy>1e-4</iyy>"
      "<izz>1e-4</izz></inertia></inertial></link><joint name='free' type='revolute'><parent>world</parent><child>pendulum</child>"
      "<axis><xyz>1 0 0</xyz></axis></joint><plugin name=\"vsa::Robot\"";
  SimWorld w(sdf_text(world_text(replaced(bench("bench", kHanging), "<plugin name=\"vsa::Robot\"", extra), {.gravity = false})));
  const sim::Entity joint = *sim::entitiesFromScopedName("bench::free", w.ecm()).begin();
  w.ecm().CreateComponent(joint, components::JointPosition());
  w.run(1);
  w.set_speed("bench", 1.0, "free");
  w.run(1000);
  EXPECT_NEAR(w.angle("bench", "free"), 1.0, 2e-3) << "turns on without torque";
  EXPECT_EQ(w.ecm().Component<components::JointForceCmd>(joint), nullptr);
}

TEST(GzSim, ABadElementIsOneMessageWithAllErrorsAndAModelWithoutTorques) {
  std::string bad = replaced(bench("bad", kLevel), "<joint>shaft</joint>", "<joint>shift</joint>");
  bad = replaced(bad, "<state_rate_Hz>100<", "<state_rate_Hz>often<");
  testing::internal::CaptureStderr();
  SimWorld w(sdf_text(world_text(bad + bench("good", kLevelAside))));
  w.run(1000);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(count(log, "stays without torques"), 1u) << log;
  EXPECT_NE(log.find("often"), std::string::npos) << log;
  const auto shaft = *sim::entitiesFromScopedName("bad::shaft", w.ecm()).begin();
  EXPECT_EQ(w.ecm().Component<components::JointForceCmd>(shaft), nullptr);
  expect_hanging(w.angle("good"));
}

TEST(GzSim, AnUnknownJointIsAnsweredWithTheJointsThereAre) {
  testing::internal::CaptureStderr();
  SimWorld w(sdf_text(world_text(replaced(bench("bad", kLevel), "<joint>shaft</joint>", "<joint>shift</joint>"))));
  w.run(1);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_NE(log.find("did you mean shaft?"), std::string::npos) << log;
}

TEST(GzSim, AWorldWithoutPhysicsIsToldOnce) {
  testing::internal::CaptureStderr();
  SimWorld w(sdf_text(world_text(bench("bench", kLevel), {.systems = {"UserCommands"}})));
  w.run(100);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(count(log, "bench: no physics moves it"), 1u) << log;
}

TEST(GzSim, AWorldWithPhysicsIsNotToldThatThereIsNone) {
  testing::internal::CaptureStderr();
  SimWorld w(sdf_text(world_text(bench("bench", kLevel))));
  w.run(100);
  EXPECT_EQ(count(testing::internal::GetCapturedStderr(), "no physics"), 0u);
}

TEST(GzSim, APauseAndSingleStepsLeaveTheMotionAsItIs) {
  const std::string sdf = sdf_text(world_text(bench("bench", kLevel)));
  const auto through = SimWorld(sdf).record("bench", 60);
  SimWorld w(sdf);
  std::vector<double> stepped;
  for (int i = 0; i < 60; ++i) {
    w.run(1);
    stepped.push_back(w.angle("bench"));
    w.idle();
    EXPECT_EQ(w.angle("bench"), stepped.back()) << "nothing moves in a pause";
  }
  EXPECT_GT(std::abs(through.back()), 0.001);
  EXPECT_EQ(stepped, through);
}

TEST(GzSim, ARemovedModelTakesItsRobotWithItAndTheOthersGoOn) {
  SimWorld w(sdf_text(world_text(bench("stays", kLevel) + bench("goes", kLevelAside))));
  w.run(100);
  w.ecm().RequestRemoveEntity(*sim::entitiesFromScopedName("goes", w.ecm()).begin(), true);
  w.run(1500);
  EXPECT_TRUE(std::isnan(w.angle("goes")));
  expect_hanging(w.angle("stays"));
}

/// Two driven links, and beside them a model nested in theirs, the first of whose joints the same plug-in drives.
std::string arm_and_another() {
  const auto link = [](const std::string& name, const std::string& z) {
    return "<link name='" + name + "'><pose>0 0 " + z + " 0 0 0</pose><inertial><pose>0 0 -0.05 0 0 0</pose><mass>0.05</mass>" +
           "<inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></inertial></link>";
  };
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "<joint name='" + name + "' type='revolute'><parent>" + parent + "</parent><child>" + child +
           "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  };
  std::string s = "<model name='m'>" + link("l0", "0") + joint("j0", "world", "l0") + link("l1", "-0.1") + joint("j1", "l0", "l1") +
                  "<model name='goes'><pose>1 0 0 0 0 0</pose>" + link("l2", "0") + link("l3", "-0.1") +
                  joint("j2", "world", "l2") + joint("j3", "l2", "l3") +
                  "</model><plugin name='vsa::Robot' filename='libvsa-robot.so'><bus name='b'/>";
  for (const char* driven : {"j0", "j1", "goes::j2"})
    s += std::string("<actuator><joint>") + driven + "</joint><type>qbmove_maker_pro_6_1</type><bus>b</bus></actuator>";
  return s + "</plugin></model>";
}

TEST(GzSim, ADrivenJointThatGoesWithANestedModelLeavesTheOthersMoving) {
  SimWorld whole(sdf_text(world_text(arm_and_another()))), w(sdf_text(world_text(arm_and_another())));
  for (SimWorld* each : {&whole, &w}) each->set_angle("m", 0.4, "j0");
  testing::internal::CaptureStderr();
  whole.run(200);
  w.run(100);
  w.ecm().RequestRemoveEntity(*sim::entitiesFromScopedName("m::goes", w.ecm()).begin(), true);
  w.run(100);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(count(log, "the joint of its actuator 'goes::j2' went with its model; the others go on"), 1u) << log;
  EXPECT_EQ(count(log, "\n"), 1u) << log;
  for (const char* joint : {"j0", "j1"}) {
    EXPECT_GT(std::abs(w.angle("m", joint)), 0.002) << joint;
    EXPECT_NEAR(w.angle("m", joint), whole.angle("m", joint), 1e-5) << joint;
  }
}

TEST(GzSim, AStepTooLongForTheUnitsStopsThemWithOneLine) {
  testing::internal::CaptureStderr();
  SimWorld w(sdf_text(world_text(bench("bench", kLevel), {.step_s = 0.02})));
  const auto q = w.record("bench", 50);
  EXPECT_EQ(count(testing::internal::GetCapturedStderr(), "have stopped and give no torque"), 1u);
  EXPECT_GT(std::abs(*std::max_element(q.begin(), q.end(), [](double a, double b) { return std::abs(a) < std::abs(b); })),
            120 * kDegree)
      << "the lever falls and swings";
}

#ifdef VSA_HAS_RESET
TEST(GzSim, AfterAResetTheRunIsThatOfAFreshWorldBitForBit) {
  SimWorld w(sdf_text(world_text(bench("bench", kLevel))));
  const auto first = w.record("bench", 700);
  Node node;
  msgs::WorldControl reset;  // Server::ResetAll came with 8.12, and no Ionic up to 9.5 has it
  reset.mutable_reset()->set_all(true);
  ASSERT_TRUE(ask(node, "/world/test/control", reset));
  w.run(2);  // one step more in which the request is heard, and the reset in place of a step
  const auto second = w.record("bench", 700);
  EXPECT_GT(std::abs(first.back()), 0.01);
  EXPECT_EQ(first, second);
}
#endif

}  // namespace
}  // namespace vsa::test
