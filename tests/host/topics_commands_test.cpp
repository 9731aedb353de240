// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <new>

#include "topics_fixture.hpp"
#include "vsa/errors.hpp"

void fail_allocation(long nth);  // allocation_count.cpp

namespace {

using vsa::host::Trajectory;
using vsa::test::TopicsFixture;
using Pair = std::array<double, 2>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

class HostTopics : public testing::Test, public TopicsFixture {
 protected:
  void SetUp() override { connect(); }
  void send(const Trajectory& trajectory) { transport.trajectories.at("/model/lab/arm/vsa/cmd")(trajectory); }
  void send_array(std::vector<double> positions) { transport.actuators.at("/model/lab/arm/vsa/cmd_array")({std::move(positions)}); }
  void expect_untouched() {
    step();
    EXPECT_EQ(commanded(0), (Pair{0.0, 0.2}));
    EXPECT_EQ(commanded(1), (Pair{0.1, 0.3}));
    EXPECT_EQ(commanded(2), (Pair{0.0, 0.0}));
  }
};

TEST_F(HostTopics, AnEquilibriumCommandLeavesThePresetAndTheOtherActuatorsAlone) {
  transport.doubles.at("/model/lab/arm/joint/shoulder/cmd_equilibrium")(0.5);
  step();
  EXPECT_EQ(commanded(0), (Pair{0.5, 0.2}));
  EXPECT_EQ(commanded(1), (Pair{0.1, 0.3}));
}

TEST_F(HostTopics, APresetCommandLeavesTheEquilibriumAlone) {
  transport.doubles.at("/model/lab/arm/joint/arm/elbow/cmd_preset")(0.6);
  step();
  EXPECT_EQ(commanded(1), (Pair{0.1, 0.6}));
}

TEST_F(HostTopics, ACommandReachesTheMotorsAndNotOnlyTheReading) {
  transport.doubles.at("/model/lab/arm/joint/shoulder/cmd_equilibrium")(0.5);
  step(1000);
  const auto moved = robot.read(0).motor_rad;
  EXPECT_GT(0.5 * (moved[0] + moved[1]), 0.2);
}

TEST_F(HostTopics, AnArrayIsAllEquilibriaThenAllPresetsInPluginOrder) {
  send_array({0.11, 0.12, 0.13, 0.21, 0.22, 0.23});
  step();
  EXPECT_EQ(commanded(0), (Pair{0.11, 0.21}));
  EXPECT_EQ(commanded(1), (Pair{0.12, 0.22}));
  EXPECT_EQ(commanded(2), (Pair{0.13, 0.23}));
  EXPECT_TRUE(lines.empty());
}

TEST_F(HostTopics, ATrajectoryOfOnePointIsACommandForNowWhateverItsTime) {
  send({{"arm::elbow_preset", "shoulder"}, {{{0.5, -0.4}, 3.0}}});
  step();
  EXPECT_EQ(commanded(0), (Pair{-0.4, 0.2})) << "a preset that isn't named stays";
  EXPECT_EQ(commanded(1), (Pair{0.1, 0.5})) << "an equilibrium that isn't named stays";
  for (const double time_s : {-2.0, 2e12}) {
    send({{"shoulder"}, {{{-0.1 * time_s / std::abs(time_s)}, time_s}}});
    step();
    EXPECT_NEAR(commanded(0)[0], time_s < 0 ? 0.1 : -0.1, 1e-12) << time_s;
  }
}

TEST_F(HostTopics, ATrajectoryIsLinearInSimulatedTimeAndHoldsItsLastPoint) {
  step(250);  // time counts from the next step, not from the start of the simulation
  send({{"shoulder", "shoulder_preset"}, {{{0.1, 0.4}, 0.1}, {{0.3, 0.2}, 0.2}}});
  step(50);
  EXPECT_NEAR(commanded(0)[0], 0.05, 1e-12) << "half way from the present command to the first point";
  EXPECT_NEAR(commanded(0)[1], 0.3, 1e-12);
  step(100);
  EXPECT_NEAR(commanded(0)[0], 0.2, 1e-12);
  EXPECT_NEAR(commanded(0)[1], 0.3, 1e-12);
  step(500);
  EXPECT_EQ(commanded(0), (Pair{0.3, 0.2}));
}

TEST_F(HostTopics, ATrajectoryOfSeveralPointsIsTakenWholeOrNotAtAllWhereverMemoryRunsOut) {
  const Trajectory message{{"shoulder", "shoulder_preset", "arm::elbow"}, {{{0.1, 0.4, 0.5}, 0.0}, {{0.3, 0.6, 0.7}, 1e-3}}};
  int failures = 0;
  for (bool whole = false; !whole; ++failures) {
    ASSERT_LT(failures, 1000);
    fail_allocation(failures + 1);
    try {
      send(message);
      whole = true;
    } catch (const std::bad_alloc&) {
    }
    fail_allocation(0);
    if (!whole) expect_untouched();
  }
  EXPECT_GT(failures, 5);
  step(2);
  EXPECT_EQ(commanded(0), (Pair{0.3, 0.6}));
  EXPECT_EQ(commanded(1), (Pair{0.7, 0.3}));
}

TEST_F(HostTopics, ACommandReplacesATrajectoryOnItsOwnChannelOnly) {
  send({{"shoulder", "shoulder_preset"}, {{{0.0, 0.2}, 0.0}, {{1.0, 0.6}, 1.0}}});
  step(100);
  transport.doubles.at("/model/lab/arm/joint/shoulder/cmd_equilibrium")(-0.2);
  step(400);
  EXPECT_EQ(commanded(0)[0], -0.2);
  EXPECT_NEAR(commanded(0)[1], 0.4, 1e-12) << "half way at half time";
}

TEST_F(HostTopics, NumbersThatAreNotFiniteAreRefusedOnEveryTopic) {
  for (const double bad : {kNan, kInf, -kInf}) {
    transport.doubles.at("/model/lab/arm/joint/shoulder/cmd_equilibrium")(bad);
    transport.doubles.at("/model/lab/arm/joint/shoulder/cmd_preset")(bad);
    send_array({0.1, 0.1, 0.1, 0.1, 0.1, bad});
    send({{"shoulder", "wrist"}, {{{0.1, bad}, 0.0}}});
    send({{"shoulder", "wrist"}, {{{0.1, 0.1}, 0.0}, {{0.2, 0.2}, bad}}});
  }
  expect_untouched();
  EXPECT_EQ(topics->refused(), 15U);
  EXPECT_EQ(lines.size(), 5U) << "one line a topic and fault, not one a message";
}

TEST_F(HostTopics, LengthsThatDoNotFitAreRefusedWhole) {
  send_array({0.1, 0.2, 0.3});
  send_array({});
  send({{"shoulder", "wrist"}, {{{0.1}, 0.0}}});
  send({{"shoulder"}, {{{0.1}, 0.0}, {{0.1, 0.2}, 1.0}}});
  expect_untouched();
  EXPECT_EQ(topics->refused(), 4U);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[0].find("3 positions where 6 belong"), std::string::npos) << lines[0];
}

TEST_F(HostTopics, UnknownAndRepeatedNamesAreRefusedWhole) {
  send({{"shoulder", "knee"}, {{{0.1, 0.1}, 0.0}}});
  send({{"shoulder", "wrist", "shoulder"}, {{{0.1, 0.1, 0.1}, 0.0}}});
  expect_untouched();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[0].find("no actuator 'knee' (allowed: shoulder, arm::elbow, wrist"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("'shoulder' is named twice"), std::string::npos) << lines[1];
}

TEST_F(HostTopics, TimesThatDoNotIncreaseAreRefusedWhole) {
  send({{"shoulder"}, {{{0.1}, 1.0}, {{0.2}, 1.0}}});
  send({{"shoulder"}, {{{0.1}, 1.0}, {{0.2}, 0.5}}});
  send({{"shoulder"}, {{{0.1}, -1.0}, {{0.2}, 0.5}}});
  send({{"shoulder"}, {{{0.1}, 0.0}, {{0.2}, 2e9}}});
  expect_untouched();
  EXPECT_EQ(topics->refused(), 4U);
  EXPECT_EQ(lines.size(), 1U);
}

TEST_F(HostTopics, AnEmptyTrajectoryIsRefused) {
  send({});
  send({{"shoulder"}, {}});
  expect_untouched();
  EXPECT_EQ(topics->refused(), 2U);
}

TEST_F(HostTopics, AClampedCommandIsReportedOnceWithTheModelsName) {
  for (int k = 0; k < 5; ++k) {
    transport.doubles.at("/model/lab/arm/joint/shoulder/cmd_preset")(1.5);
    step(20);
  }
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].rfind("lab::arm: shoulder", 0), 0U) << lines[0];
  EXPECT_EQ(topics->refused(), 0U);
}

TEST_F(HostTopics, ATransportWithoutTrajectoriesStillHasTheOthers) {
  transport.knows_trajectories = false;
  transport.trajectories.clear();
  EXPECT_NO_THROW(connect());
  send_array({0.11, 0.12, 0.13, 0.21, 0.22, 0.23});
  step();
  EXPECT_EQ(commanded(0), (Pair{0.11, 0.21}));
}

TEST(HostTopicsNames, ActuatorsWhoseNamesCollideWithAPresetAreBadInput) {
  auto config = vsa::test::three_actuators();
  config.actuators[1].name = "shoulder_preset";
  TopicsFixture robot(config);
  EXPECT_THROW(robot.connect(), vsa::InputError);
}

TEST(HostTopicsNames, AllNamesThatCannotBeTopicsAreToldAtOnce) {
  auto config = vsa::test::three_actuators();
  config.actuators[0].name = "bad name";
  config.actuators[2].name = "wrist::";
  TopicsFixture robot(config);
  try {
    robot.connect();
    FAIL() << "the names were taken";
  } catch (const vsa::InputError& error) {
    EXPECT_EQ(error.problems().size(), 2U) << error.what();
  }
}

TEST(HostTopicsNames, ANameThatTheTransportRefusesIsBadInput) {
  TopicsFixture robot;
  robot.transport.outcome = vsa::host::Outcome::refused;
  EXPECT_THROW(robot.connect(), vsa::InputError);
}

TEST(HostTopicsNames, HandlersOfTopicsThatThrewOrAreGoneReachNothing) {
  TopicsFixture robot;
  robot.transport.outcome = vsa::host::Outcome::refused;  // after every handler was handed over
  EXPECT_THROW(robot.connect(), vsa::InputError);
  const auto say_all = [&robot] {
    robot.transport.doubles.at("/model/lab/arm/joint/shoulder/cmd_equilibrium")(0.5);
    robot.transport.trajectories.at("/model/lab/arm/vsa/cmd")({{"shoulder"}, {{{0.5}, 0.0}}});
    robot.transport.actuators.at("/model/lab/arm/vsa/cmd_array")({{0.5, 0.5, 0.5, 0.5, 0.5, 0.5}});
    robot.step();
  };
  say_all();
  EXPECT_EQ(robot.commanded(0), (Pair{0.0, 0.2}));

  robot.transport.outcome = vsa::host::Outcome::ok;
  robot.connect();
  robot.topics.reset();
  say_all();
  EXPECT_EQ(robot.commanded(0), (Pair{0.0, 0.2}));
}

TEST(HostTopicsNames, ScopesAreJoinedBySlashes) {
  EXPECT_EQ(vsa::host::model_topic("a::b", "vsa/cmd"), "/model/a/b/vsa/cmd");
  EXPECT_EQ(vsa::host::joint_topic("a", "m_1::shaft", "preset"), "/model/a/joint/m_1/shaft/preset");
  for (const char* bad : {"", "::a", "a::", "a::::b", "a b", "a@b", "~a", "a:=b", "a\tb"}) {
    EXPECT_THROW((void)vsa::host::topic_scope(bad, "model"), vsa::InputError) << bad;
  }
}

}  // namespace
