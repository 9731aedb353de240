// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robots with units that have a servo: no line, commands at the next tick, beside others that have one.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "host/free_flanges.hpp"
#include "support/servos.hpp"
#include "vsa/errors.hpp"

namespace {

using vsa::host::Robot;
using vsa::host::RobotConfig;
using vsa::test::antagonist;
using vsa::test::chain;
using vsa::test::motor_voltages;
using vsa::test::position_servo;
using vsa::test::series;
using vsa::test::torque_servo;
using Bench = vsa::test::Flanges;

/// qbmoves with the ids 1 and 3, a position servo 2, a torque servo 4, all on one bus.
RobotConfig mixed() {
  RobotConfig config = chain(4);
  config.actuators[1].unit = series(position_servo(), 50, 0.2);
  config.actuators[3].unit = series(torque_servo(), 50, 0.2);
  for (const std::size_t i : {1U, 3U}) config.actuators[i].initial_preset = 0;
  return config;
}

/// Commands now and then.
void play(Bench& bench, int from, int steps) {
  for (int n = from; n < from + steps; ++n) {
    if (n % 30 == 0) {
      for (std::size_t i = 0; i < bench.robot.size(); ++i)
        EXPECT_TRUE(bench.robot.command(i, 0.4 * std::sin(0.01 * n + static_cast<double>(i)), std::nullopt));
    }
    bench.step();
  }
}

std::string refusal(const RobotConfig& config) {
  try {
    const Robot robot(config);
    return "";
  } catch (const vsa::InputError& error) {
    return error.what();
  }
}

TEST(ServoInARobot, HasItsCommandAtTheNextTickWhateverTheBaudRate) {
  RobotConfig config = mixed();
  config.buses[0].baud_Hz = 9600;
  Bench bench(config);
  bench.run(10);
  ASSERT_TRUE(bench.robot.command(1, 0.5, std::nullopt));
  bench.step();
  EXPECT_GT(bench.robot.read(1).motor_speed_rad_per_s[0], 0.1);
  EXPECT_EQ(bench.robot.received_inputs(1)[0].value, static_cast<std::int16_t>(0.5 / (2 * vsa::kPi) * 32768));
}

TEST(ServoInARobot, TakesNoTimeOfTheUnitsOnItsBus) {
  // The qbmoves of the mixed robot go bit for bit as two of them alone do.
  Bench bench(mixed());
  RobotConfig alone = chain(3);
  alone.actuators.erase(alone.actuators.begin() + 1);
  Bench two(alone);
  for (int n = 0; n < 600; ++n) {
    if (n % 50 == 0) {
      for (const auto& [i, k] : {std::pair<std::size_t, std::size_t>{0, 0}, {2, 1}}) {
        EXPECT_TRUE(bench.robot.command(i, 0.001 * n, 0.3));
        EXPECT_TRUE(two.robot.command(k, 0.001 * n, 0.3));
      }
    }
    bench.step();
    two.step();
    ASSERT_EQ(bench.in[0].angle_rad, two.in[0].angle_rad) << n;
    ASSERT_EQ(bench.in[2].angle_rad, two.in[1].angle_rad) << n;
  }
  EXPECT_GT(std::abs(bench.in[0].angle_rad), 0.1);
}

TEST(ServoInARobot, ReachesWhatItIsTold) {
  Bench bench(mixed());
  bench.run(10);
  for (std::size_t i = 0; i < 4; ++i) ASSERT_TRUE(bench.robot.command(i, 0.5, std::nullopt));
  for (int n = 0; n < 4000; ++n) {
    for (auto& joint : bench.in) joint.speed_rad_per_s *= 0.99;
    bench.step();
  }
  EXPECT_NEAR(bench.in[1].angle_rad, 0.5, 0.005);
  EXPECT_NEAR(bench.in[3].angle_rad, 0.5, 0.005);
  EXPECT_NEAR(vsa::radians({bench.robot.read(1).measured[0].value * 2}), 0.5, 0.002) << "its own encoders";
}

TEST(ServoInARobot, GoesOnFromSnapshotsNumbersAndClonesWithTheSameBits) {
  for (const std::int64_t step_ns : {1'000'000, 1'700'000}) {
    Bench bench(mixed(), step_ns);
    play(bench, 0, 200);
    const auto snapshot = bench.robot.snapshot();
    std::vector<double> numbers(bench.robot.state_size());
    bench.robot.save(numbers);
    const auto joints = bench.in;
    const auto t_ns = bench.t_ns;
    play(bench, 200, 200);
    const std::uint64_t end = bench.robot.state_hash();
    const auto again = [&] {
      bench.in = joints;
      bench.t_ns = t_ns;
      play(bench, 200, 200);
      EXPECT_EQ(bench.robot.state_hash(), end) << step_ns;
    };
    bench.robot.restore(*snapshot);
    again();
    bench.robot.restore(numbers);
    again();
    bench.robot.restore(*snapshot);
    Robot clone = bench.robot.clone();
    bench.robot = std::move(clone);
    again();
    bench.robot.reset();
    bench.in.assign(4, vsa::host::JointIn{0, 0, 1e3});
    bench.t_ns = 0;
    Bench fresh(mixed(), step_ns);
    play(bench, 0, 100);
    play(fresh, 0, 100);
    EXPECT_EQ(bench.robot.state_hash(), fresh.robot.state_hash());
  }
}

TEST(ServoInARobot, CantStandOnABusWithASerialPort) {
  RobotConfig config = mixed();
  config.buses[0].serial_port = "arm";
  const std::string text = refusal(config);
  EXPECT_NE(text.find("a2 = position_servo: has no line: its bus spine can't have a serial port"), std::string::npos) << text;
  EXPECT_NE(text.find("a4 = torque_servo"), std::string::npos) << text;
  config.buses.push_back({"own", 2e6, std::nullopt});
  config.actuators[1].bus = config.actuators[3].bus = 1;
  EXPECT_EQ(refusal(config), "");
}

TEST(ServoInARobot, RefusesFaultsOfALineThatItHasnt) {
  Robot robot(mixed());
  vsa::device::Faults faults;
  faults.lost_byte = 0.5;
  EXPECT_NO_THROW(robot.set_faults(0, faults));
  EXPECT_THROW(robot.set_faults(1, faults), vsa::InputError);
  faults.lost_byte = 0;
  faults.powered = false;
  EXPECT_NO_THROW(robot.set_faults(1, faults));
}

TEST(ServoInARobot, TakesVoltagesAndTorquesPastTheLawAndNoOtherDoes) {
  RobotConfig config = mixed();
  config.actuators[2].unit = antagonist(motor_voltages());
  Bench bench(config);
  bench.run(5);
  bench.robot.command_direct(2, {3.0, -2.0});
  bench.robot.command_direct(3, {1.0, 0.0});
  bench.step();
  EXPECT_GT(bench.robot.read(2).motor_speed_rad_per_s[0], 0.0);
  EXPECT_LT(bench.robot.read(2).motor_speed_rad_per_s[1], 0.0);
  EXPECT_GT(bench.robot.read(3).motor_speed_rad_per_s[0], 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(bench.robot.command_direct(2, {nan, 0.0}), vsa::InputError);
  EXPECT_THROW(bench.robot.command_direct(0, {1.0, 0.0}), vsa::InputError);
  EXPECT_THROW(bench.robot.command_direct(1, {1.0, 0.0}), vsa::InputError);
  EXPECT_THROW(bench.robot.command_direct(9, {1.0, 0.0}), vsa::InputError);
  EXPECT_FALSE(bench.robot.command(1, nan, std::nullopt));
}

TEST(ServoInARobot, MotorVoltagesTellOnceThatTheyTakeNoEquilibrium) {
  RobotConfig config = chain(1);
  config.actuators[0].unit = antagonist(motor_voltages());
  Bench bench(config);
  for (int n = 0; n < 3; ++n) {
    ASSERT_TRUE(bench.robot.command(0, 0.5, 0.2));
    bench.step();
  }
  const auto notices = bench.robot.take_notices();
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_NE(notices[0].text.find("its controller is motor_voltages"), std::string::npos);
  EXPECT_EQ(bench.robot.read(0).equilibrium_command_rad, 0.0);
}

TEST(ServoInARobot, GetsOtherParametersButNoOtherController) {
  Bench bench(mixed());
  play(bench, 0, 100);
  vsa::device::UnitConfig other = series(position_servo(), 80, 0.2);
  EXPECT_NO_THROW(bench.robot.set_parameters(1, other));
  play(bench, 100, 100);
  other.servo.reset();
  try {
    bench.robot.set_parameters(1, other);
    ADD_FAILURE() << "another controller";
  } catch (const vsa::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("control.kind = qbmove"), std::string::npos) << error.what();
  }
}

TEST(ServoInARobot, IsPlacedWithoutAKick) {
  Bench bench(mixed());
  play(bench, 0, 100);
  for (const std::size_t i : {1U, 3U}) {
    bench.robot.place(i, {1.2, 0.0, 0.0, 1.2}, 1e-3);
    bench.in[i].angle_rad = 1.2;
    bench.in[i].speed_rad_per_s = 0;
    bench.in[i].placed = true;
  }
  bench.step();
  for (auto& joint : bench.in) joint.placed = false;
  bench.run(200);
  EXPECT_NEAR(bench.in[1].angle_rad, 1.2, 0.002);
  EXPECT_NEAR(bench.in[3].angle_rad, 1.2, 0.002);
}

}  // namespace
