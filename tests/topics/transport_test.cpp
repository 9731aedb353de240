// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "transport_test.hpp"

#include <gtest/gtest.h>
#include <ignition/msgs/actuators.pb.h>
#include <ignition/msgs/double.pb.h>
#include <ignition/msgs/joint_trajectory.pb.h>
#include <ignition/msgs/model.pb.h>

#include <cstdlib>
#include <ignition/transport/Node.hh>
#include <map>

#include "support/one_joint.hpp"
#include "vsa/topics/command_client.hpp"
#include "vsa/topics/ignition_transport.hpp"

namespace {

using namespace std::chrono_literals;
namespace msgs = ignition::msgs;
using vsa::test::Mailbox;
using vsa::test::until;

vsa::host::RobotConfig one_actuator() {
  vsa::host::RobotConfig config;
  config.buses.push_back({"arm", 2'000'000, std::nullopt});
  config.actuators.push_back({"m::shoulder", "m::shaft", "maker_pro", vsa::test::maker_pro(), 0, 1, 0.0, 0.2});
  return config;
}

class IgnitionTransport : public testing::Test {
 protected:
  void SetUp() override {
    topics.emplace(robot, "arm", transport.emplace(), [this](const std::string& line) { lines.put(line); });
  }
  void TearDown() override { transport.reset(); }

  void step() {
    const std::vector<vsa::host::JointIn> still(1);
    std::vector<double> torque(1);
    robot.advance(time_ns, 1'000'000, still, torque);
    time_ns += 1'000'000;
    topics->update(time_ns);
  }

  vsa::host::Robot robot{one_actuator()};
  Mailbox<std::string> lines;
  std::optional<vsa::host::RobotTopics> topics;
  std::optional<vsa::topics::IgnitionTransport> transport;
  std::int64_t time_ns = 0;
  ignition::transport::Node other;
};

TEST_F(IgnitionTransport, KeepsToLoopbackWhereNothingElseIsSaid) { EXPECT_STREQ(getenv("IGN_IP"), "127.0.0.1"); }

TEST_F(IgnitionTransport, ADoubleOfAnotherNodeCommandsTheRobot) {
  auto equilibrium = other.Advertise<msgs::Double>("/model/arm/joint/m/shoulder/cmd_equilibrium");
  auto preset = other.Advertise<msgs::Double>("/model/arm/joint/m/shoulder/cmd_preset");
  msgs::Double half, stiff;
  half.set_data(0.5);
  stiff.set_data(0.6);
  EXPECT_TRUE(until([&] {
    equilibrium.Publish(half);
    preset.Publish(stiff);
    step();
    return robot.read(0).equilibrium_command_rad == 0.5 && robot.read(0).preset_command == 0.6;
  }));
}

TEST_F(IgnitionTransport, AJointTrajectoryPlaysInSimulatedTime) {
  auto publisher = other.Advertise<msgs::JointTrajectory>("/model/arm/vsa/cmd");
  msgs::JointTrajectory message;
  message.add_joint_names("m::shoulder_preset");
  for (const double at_s : {0.0, 0.5}) {
    auto& point = *message.add_points();
    point.add_positions(0.2 + 0.4 * at_s);
    point.mutable_time_from_start()->set_nsec(static_cast<int>(at_s * 1e9));
  }
  publisher.Publish(message);
  ASSERT_TRUE(until([&] { return step(), robot.read(0).preset_command > 0.2; }));
  const double before = robot.read(0).preset_command;
  for (int k = 0; k < 100; ++k) step();
  EXPECT_NEAR(robot.read(0).preset_command - before, 0.04, 1e-9);
}

TEST_F(IgnitionTransport, AnActuatorsMessageIsTheArray) {
  auto publisher = other.Advertise<msgs::Actuators>("/model/arm/vsa/cmd_array");
  msgs::Actuators message;
  message.add_position(-0.3);
  message.add_position(0.4);
  EXPECT_TRUE(until([&] {
    publisher.Publish(message);
    step();
    return robot.read(0).equilibrium_command_rad == -0.3 && robot.read(0).preset_command == 0.4;
  }));
}

TEST_F(IgnitionTransport, NotANumberIsRefusedWithOneLine) {
  auto publisher = other.Advertise<msgs::Double>("/model/arm/joint/m/shoulder/cmd_equilibrium");
  msgs::Double message;
  message.set_data(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(until([&] { return publisher.Publish(message), topics->refused() >= 3; }));
  step();
  EXPECT_EQ(robot.read(0).equilibrium_command_rad, 0.0);
  EXPECT_EQ(lines.all().size(), 1U);
}

TEST_F(IgnitionTransport, JointStatesArriveWithSimulatedStampsAndTheCommands) {
  vsa::topics::CommandClient client;
  client.watch("arm");
  std::optional<vsa::host::JointStates> state;
  std::map<std::int64_t, double> apart_rad;  // by time: what arrives is as old as the transport is slow
  const auto heard_after_a_step = [&] {
    step();
    apart_rad[time_ns] = robot.read(0).motor_rad[0] - robot.read(0).motor_rad[1];
    return (state = client.wait_for_state(0ms)).has_value();
  };
  ASSERT_TRUE(until(heard_after_a_step));
  ASSERT_TRUE(until(heard_after_a_step));
  EXPECT_EQ(state->time_ns % 10'000'000, 0) << "100 Hz of simulated time";
  EXPECT_LE(state->time_ns, time_ns);
  EXPECT_EQ(state->model, "arm");
  ASSERT_EQ(state->joints.size(), 3U);
  EXPECT_EQ(state->joints[0].name, "m::shaft");
  EXPECT_EQ(state->joints[2].name, "m::shoulder_motor_2");
  EXPECT_EQ(state->joints[1].position_rad - state->joints[2].position_rad, apart_rad.at(state->time_ns));
  EXPECT_EQ(state->names, std::vector<std::string>{"m::shoulder"});
  ASSERT_EQ(state->commands.size(), 1U);
  EXPECT_EQ(state->commands[0].preset, 0.2);
  ASSERT_EQ(state->units.size(), 1U);
  EXPECT_EQ(state->units[0].equilibrium, "rad");
  EXPECT_EQ(state->units[0].preset, "rad");
}

TEST_F(IgnitionTransport, AClientFindsTheRobotAndItsCommandShowsInTheState) {
  vsa::topics::CommandClient client;
  ASSERT_TRUE(until([&] { return client.models() == std::vector<std::string>{"arm"}; }));
  client.watch("arm");
  EXPECT_TRUE(until([&] {
    client.send({{"m::shoulder", "m::shoulder_preset"}, {{{0.1, 0.3}, 0.0}}});
    step();
    const auto state = client.wait_for_state(0ms);
    return state && state->commands[0].equilibrium_rad == 0.1 && state->commands[0].preset == 0.3;
  }));
}

TEST_F(IgnitionTransport, NobodyIsPublishedToUntilSomebodyListens) {
  auto publisher = transport->advertise_double("/lonely");
  ASSERT_NE(publisher, nullptr);
  EXPECT_FALSE(publisher->wanted());
  Mailbox<double> heard;
  auto listen = heard.handler<msgs::Double>([](const msgs::Double& message) { return message.data(); });
  ASSERT_TRUE(other.Subscribe("/lonely", listen));
  ASSERT_TRUE(until([&] { return publisher->wanted(); }));
  publisher->publish(0, 7.0);
  EXPECT_TRUE(heard.wait([](double value) { return value == 7.0; }, vsa::test::kPatience));
}

TEST_F(IgnitionTransport, NoHandlerRunsOnceItIsGone) {
  auto publisher = other.Advertise<msgs::Double>("/model/arm/joint/m/shoulder/cmd_equilibrium");
  msgs::Double message;
  message.set_data(0.5);
  ASSERT_TRUE(until([&] { return publisher.Publish(message), step(), robot.read(0).equilibrium_command_rad == 0.5; }));
  transport.reset();
  step();
  message.set_data(0.9);
  for (int k = 0; k < 100; ++k) publisher.Publish(message), step();
  EXPECT_EQ(robot.read(0).equilibrium_command_rad, 0.5);
}

TEST_F(IgnitionTransport, ATopicNameThatTheTransportRefusesIsRefused) {
  EXPECT_EQ(transport->on_double("/with space", [](double) {}), vsa::host::Outcome::refused);
  EXPECT_EQ(transport->advertise_double("/with space"), nullptr);
}

}  // namespace
