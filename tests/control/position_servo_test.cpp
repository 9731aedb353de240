// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The position servo on a motor with its spring. A program without integral, with windup, without its limits or with a speed of the
// wrong sign fails here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/servos.hpp"

namespace {

using vsa::kPi;
using vsa::test::antagonist;
using vsa::test::OneJoint;
using vsa::test::position_servo;
using vsa::test::series;

constexpr double kCount_rad = 2 * kPi / 65536;

void run(OneJoint& joint, double seconds) {
  const auto end = joint.t_ns + static_cast<std::int64_t>(seconds * 1e9);
  while (joint.t_ns < end) joint.step();
}

TEST(PositionServo, StandsOnItsReferenceToACountWhateverTheLoad) {
  for (const double load : {-2.0, 0.0, 1.5}) {
    OneJoint joint(series(position_servo(), 50, 0.4), 0.0, 0.0, 0.02, 1'000'000);
    joint.load = [&](double) { return load - 0.3 * joint.v; };
    joint.unit.command(joint.state, 0.8, 0.0);
    run(joint, 5.0);
    EXPECT_NEAR(joint.state.actuator.motor[0].angle, 0.8, kCount_rad) << load << " N·m";
  }
}

TEST(PositionServo, HoldsBothMotorsOfAnAntagonistAgainstTheirSprings) {
  OneJoint joint(antagonist(position_servo()), 0.0, 0.0, 1e-3, 1'000'000);
  joint.load = [&](double) { return -0.05 * joint.v; };
  joint.unit.command(joint.state, 0.5, 0.4);
  run(joint, 3.0);
  const double count = 2 * kPi / 4096;
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, 0.9, count);
  EXPECT_NEAR(joint.state.actuator.motor[1].angle, 0.1, count);
  EXPECT_NEAR(joint.q, 0.5, 0.01);
}

TEST(PositionServo, BeginsAtRestWhereItsSpringsPullAtTheMotors) {
  OneJoint joint(antagonist(position_servo()), 0.2, 0.6, 1e-3, 1'000'000);
  double most = 0;
  for (int n = 0; n < 500; ++n) {
    joint.step();
    most = std::max(most, std::abs(joint.state.actuator.motor[0].speed));
  }
  EXPECT_LT(most, 0.05) << "its integral holds the spring's load from the first tick on";
}

TEST(PositionServo, ComesBackFromAStallAtOnce) {
  // The shaft is locked and the spring too stiff for the motor, which stalls at its limit of 5 N·m for five seconds.
  OneJoint joint(series(position_servo(), 100), 0.0, 0.0, 0.0, 1'000'000);
  joint.unit.command(joint.state, 1.0, 0.0);
  run(joint, 5.0);
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, 0.05, 0.002);
  joint.unit.command(joint.state, 0.0, 0.0);
  double lowest = 1;
  for (int n = 0; n < 300; ++n) {
    joint.step();
    lowest = std::min(lowest, joint.state.actuator.motor[0].angle);
    if (n == 250) {
      EXPECT_NEAR(joint.state.actuator.motor[0].angle, 0.0, 0.005);
    }
  }
  EXPECT_GT(lowest, -0.01);
}

TEST(PositionServo, KeepsCurrentAndSpeedWithinTheirLimits) {
  auto servo = position_servo();
  servo.current_max_A = 1;
  OneJoint joint(series(servo, 50), 0.0, 0.0, 1e-3, 1'000'000);
  const auto& limits = *joint.unit.config().servo;
  joint.unit.command(joint.state, 20.0, 0.0);
  double most_A = 0, fastest = 0;
  for (int n = 0; n < 1500; ++n) {
    joint.step();
    const auto& motor = joint.state.actuator.motor[0];
    most_A = std::max(most_A, std::abs(joint.unit.physics().motor_current(joint.state.actuator, 0, joint.state.held.voltage[0],
                                                                          joint.state.held.terminal[0])));
    fastest = std::max(fastest, motor.speed);
  }
  EXPECT_GT(most_A, 0.75 * limits.current_max_A);
  EXPECT_LT(most_A, 1.3 * limits.current_max_A) << "between two ticks it follows the speed";
  EXPECT_GT(fastest, 0.99 * limits.position.speed_max_rad_per_s);
  EXPECT_LT(fastest, 1.15 * limits.position.speed_max_rad_per_s);
}

TEST(PositionServo, CountsTurnsAndSpeedsThroughTheEncodersWrap) {
  OneJoint joint(series(position_servo(), 50), 0.0, 0.0, 1e-3, 1'000'000);
  joint.unit.command(joint.state, -20.0, 0.0);
  run(joint, 5.0);
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, -20.0, 0.001);
  EXPECT_NEAR(joint.q, -20.0, 0.01);
  EXPECT_NEAR(static_cast<double>(joint.state.servo.raw[2]) * kCount_rad, joint.q, 2 * kCount_rad);
}

TEST(PositionServo, ClampsReferencesToItsOwnLimit) {
  auto servo = position_servo();
  servo.reference_max_rad = 0.5;
  OneJoint joint(series(servo, 50), 0.0, 0.0, 1e-3, 1'000'000);
  joint.unit.command(joint.state, 2.0, 0.0);
  run(joint, 2.0);
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, 0.5, kCount_rad);
  const auto [low, high] = joint.unit.config().reference_range_raw(0);
  EXPECT_NEAR(vsa::radians(vsa::Raw{high}), 0.5, kCount_rad);
  EXPECT_EQ(low, -high);
}

TEST(PositionServo, HoldsItsVoltageFromTickToTick) {
  OneJoint joint(series(position_servo(), 50), 0.0, 0.0, 1e-3, 250'000);
  joint.unit.command(joint.state, 1.0, 0.0);
  int changes = 0;
  for (int n = 0; n < 400; ++n) {
    const double before = joint.state.held.voltage[0];
    const bool tick = joint.t_ns % 1'000'000 == 0;
    joint.step();
    if (!tick) {
      EXPECT_EQ(joint.state.held.voltage[0], before) << n;
    }
    changes += joint.state.held.voltage[0] != before ? 1 : 0;
  }
  EXPECT_GT(changes, 50);
}

TEST(PositionServo, IsStillOnCoarseEncoders) {
  // The reference lies between two counts: without counting it, too, the integral would never rest.
  vsa::device::UnitConfig config = series(position_servo(), 50, 0.4);
  config.actuator.side[0].encoder.bits = 10;
  OneJoint joint(config, 0.0, 0.0, 5e-3, 1'000'000);
  joint.load = [&](double) { return -0.05 * joint.v; };
  joint.unit.command(joint.state, 0.5, 0.0);
  run(joint, 6.0);
  const double there = joint.state.actuator.motor[0].angle, held = joint.state.servo.integral[0];
  run(joint, 20.0);
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, there, 1e-6);
  EXPECT_NEAR(joint.state.servo.integral[0], held, 1e-9);
  EXPECT_NEAR(there, 0.5, 2 * kPi / 1024);
}

TEST(PositionServo, EstimatesSpeedsThroughItsFilter) {
  auto servo = vsa::test::motor_voltages();
  servo.speed_filter_s = 0.009;
  OneJoint joint(series(servo, 50), 0.0, 0.0, 0.0, 1'000'000);
  for (int n = 0; n < 30; ++n) {
    joint.v = 8.0;
    joint.step();
    const double expected = 8.0 * (1.0 - std::pow(0.9, n));
    EXPECT_NEAR(joint.state.servo.speed[2], expected, 0.1) << n;
  }
}

TEST(PositionServo, GoesTheSameWayInStepsOfAnyLengthUpToAboutTheirOrder) {
  const auto end = [](std::int64_t step_ns) {
    OneJoint joint(series(position_servo(), 50), 0.0, 0.0, 0.01, step_ns);
    joint.unit.command(joint.state, 0.5, 0.0);
    run(joint, 0.08);
    return joint.state.actuator.motor[0].angle;
  };
  EXPECT_NEAR(end(4'000'000), end(250'000), 0.02);
  EXPECT_NEAR(end(1'000'000), end(250'000), 0.005);
}

}  // namespace
