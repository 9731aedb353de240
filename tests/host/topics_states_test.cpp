// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "topics_fixture.hpp"

namespace {

using vsa::test::TopicsFixture;

TEST(HostTopicsStates, AreAdvertisedAsTheTableSays) {
  TopicsFixture robot;
  robot.connect();
  for (const char* leaf : {"stiffness", "deflection", "preset", "current_1", "current_2"}) {
    EXPECT_EQ(robot.transport.advertised.count(std::string("/model/lab/arm/joint/arm/elbow/") + leaf), 1U) << leaf;
  }
  EXPECT_EQ(robot.transport.advertised.count("/model/lab/arm/vsa/joint_state"), 1U);
  EXPECT_EQ(robot.transport.advertised.count("/model/lab/arm/joint/wrist/current_2"), 0U) << "it has one motor";
}

TEST(HostTopicsStates, ComeAtTheStateRateOfSimulatedTime) {
  TopicsFixture robot;
  robot.connect();
  robot.step(1000);
  const auto& states = robot.transport.wire->states;
  ASSERT_GE(states.size(), 100U);
  ASSERT_LE(states.size(), 102U) << "1 s at 100 Hz, the first step's and the end's included";
  for (std::size_t k = 2; k < states.size(); ++k) EXPECT_EQ(states[k].time_ns - states[k - 1].time_ns, 10'000'000);
  EXPECT_EQ(robot.transport.wire->numbers.at("/model/lab/arm/joint/shoulder/stiffness").size(), states.size());
}

TEST(HostTopicsStates, ARateAboveTheStepRateGivesEveryStep) {
  auto config = vsa::test::three_actuators();
  config.state_rate_Hz = 1e6;
  TopicsFixture robot(config);
  robot.connect();
  robot.step(50);
  EXPECT_EQ(robot.transport.wire->states.size(), 50U);
}

TEST(HostTopicsStates, GoOnAfterTimeWentBack) {
  TopicsFixture robot;
  robot.connect();
  robot.step(995);
  const auto before = robot.transport.wire->states.size();
  robot.robot.reset();
  robot.time_ns = 0;
  robot.step(1);
  ASSERT_EQ(robot.transport.wire->states.size(), before + 1);
  EXPECT_EQ(robot.transport.wire->states.back().time_ns, 1'000'000);
}

TEST(HostTopicsStates, NameTheShaftByItsJointAndTheMotorsByTheActuator) {
  TopicsFixture robot;
  robot.connect();
  robot.step(10);
  const auto& state = robot.transport.wire->states.back();
  EXPECT_EQ(state.model, "lab::arm");
  std::vector<std::string> names;
  for (const auto& joint : state.joints) names.push_back(joint.name);
  EXPECT_EQ(names, (std::vector<std::string>{"module_1::shaft", "shoulder_motor_1", "shoulder_motor_2", "module_2::shaft",
                                             "arm::elbow_motor_1", "arm::elbow_motor_2", "module_3::shaft", "wrist_motor_1"}));
  EXPECT_EQ(state.first_joint, (std::vector<std::size_t>{0, 3, 6}));
}

TEST(HostTopicsStates, AreTheRobotsOwnReadings) {
  TopicsFixture robot;
  robot.connect();
  robot.transport.doubles.at("/model/lab/arm/joint/arm/elbow/cmd_equilibrium")(0.4);
  robot.step(200);
  const auto now = robot.robot.read(1);
  const auto& state = robot.transport.wire->states.back();
  ASSERT_EQ(state.time_ns, robot.time_ns);
  EXPECT_NE(now.torque_Nm, 0.0) << "the test needs a unit at work";
  EXPECT_EQ(state.joints[3].position_rad, now.shaft_rad);
  EXPECT_EQ(state.joints[3].velocity_rad_per_s, now.shaft_speed_rad_per_s);
  EXPECT_EQ(state.joints[3].force_Nm, now.torque_Nm);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(state.joints[4 + m].position_rad, now.motor_rad[m]);
    EXPECT_EQ(state.joints[4 + m].velocity_rad_per_s, now.motor_speed_rad_per_s[m]);
    EXPECT_EQ(state.joints[4 + m].force_Nm, now.motor_torque_Nm[m]);
  }
  EXPECT_EQ(state.commands[1].equilibrium_rad, 0.4);
  EXPECT_EQ(state.commands[1].preset, 0.3);
  const auto last = [&](const char* leaf) {
    return robot.transport.wire->numbers.at(std::string("/model/lab/arm/joint/arm/elbow/") + leaf).back().second;
  };
  EXPECT_EQ(last("stiffness"), now.stiffness_Nm_per_rad);
  EXPECT_EQ(last("deflection"), now.deflection_rad);
  EXPECT_EQ(last("preset"), now.preset);
  EXPECT_EQ(last("current_1"), now.current_A[0]);
  EXPECT_EQ(last("current_2"), now.current_A[1]);
}

TEST(HostTopicsStates, GoOnlyToThoseWhoListen) {
  TopicsFixture robot;
  robot.connect();
  robot.transport.wire->all_listened = false;
  robot.transport.wire->listened = {"/model/lab/arm/joint/wrist/stiffness"};
  robot.step(100);
  EXPECT_TRUE(robot.transport.wire->states.empty());
  ASSERT_EQ(robot.transport.wire->numbers.size(), 1U);
  EXPECT_FALSE(robot.transport.wire->numbers.at("/model/lab/arm/joint/wrist/stiffness").empty());
}

TEST(HostTopicsStates, CanBePublishedWhileTimeStandsStill) {
  TopicsFixture robot;
  robot.connect();
  robot.topics->publish(0);
  robot.topics->publish(0);
  EXPECT_EQ(robot.transport.wire->states.size(), 2U);
}

}  // namespace
