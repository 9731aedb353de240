// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The torque servo of a series elastic unit against closed forms. Signs, the feedforward, the integral and each gain show in one of
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/servos.hpp"

namespace {

using vsa::kPi;
using vsa::test::OneJoint;
using vsa::test::series;
using vsa::test::torque_servo;

double spring_Nm(const OneJoint& joint) {
  return joint.unit.physics().spring(joint.state.actuator, joint.state.actuator.shaft).torque;
}

void run(OneJoint& joint, double seconds) {
  const auto end = joint.t_ns + static_cast<std::int64_t>(seconds * 1e9);
  while (joint.t_ns < end) joint.step();
}

TEST(TorqueServo, GivesATorqueOnALockedShaftWithoutSteadyError) {
  for (const double wanted : {1.5, -3.0}) {
    OneJoint joint(series(torque_servo(), 50, 0.4), 0.0, 0.0, 0.0, 1'000'000);
    vsa::device::Unit::command_direct(joint.state, {wanted, 0});
    run(joint, 2.0);
    EXPECT_NEAR(spring_Nm(joint), wanted, 0.01) << "a count of the encoders on the spring is 0.005 N·m";
  }
}

TEST(TorqueServo, MakesTheJointASpringOfTheStiffnessCommanded) {
  for (const double preset : {0.0, 10.0, -15.0}) {
    OneJoint joint(series(torque_servo(), 50, 0.4), 0.3, 0.0, 0.02, 1'000'000);
    joint.load = [&](double) { return 1.0 - 0.3 * joint.v; };
    joint.unit.command(joint.state, 0.3, preset);
    run(joint, 4.0);
    EXPECT_NEAR(joint.q, 0.3 + 1.0 / (20.0 + preset), 0.01 / (20.0 + preset) + 2e-4) << preset;
  }
}

TEST(TorqueServo, HasNoNegativeStiffness) {
  const vsa::device::Unit unit(series(torque_servo(), 50));
  EXPECT_EQ(unit.servo()->stiffness(-25.0), 0.0);
  EXPECT_EQ(unit.servo()->stiffness(5.0), 25.0);
}

/// On a locked shaft with τ = k x:  (J s² + (b + d_x) s + k) x = (1 + k_τ + k_ξ/s) τ* − (k_τ + k_ξ/s) k x.
std::complex<double> closed_loop(const vsa::device::UnitConfig& c, double k, double frequency_Hz) {
  const std::complex<double> s{0, 2 * kPi * frequency_Hz};
  const auto& p = c.servo->torque;
  const std::complex<double> pi = p.gain + p.integral_per_s / s;
  const auto& m = c.actuator.side[0].motor;
  const auto plant = (m.inertia_kgm2 * s * s + (m.viscous_Nms_per_rad + p.motor_damping_Nms_per_rad) * s) / k + 1.0;
  return (1.0 + pi) / (plant + pi);
}

TEST(TorqueServo, HasTheBandwidthOfItsLinearModel) {
  constexpr double kSpring = 50;
  vsa::device::UnitConfig config = series(torque_servo(), kSpring);
  config.actuator.side[0].motor.inertia_kgm2 = 0.01;
  config.servo->torque.motor_damping_Nms_per_rad = 1.0;
  for (const double frequency_Hz : {2.0, 8.0, 14.0, 20.0}) {
    OneJoint joint(config, 0.0, 0.0, 0.0, 250'000);
    std::complex<double> found = 0;
    const int steps = static_cast<int>(std::lround(20 / frequency_Hz / 250e-6));
    for (int n = 0; n < 2 * steps; ++n) {
      const double t = static_cast<double>(joint.t_ns) * 1e-9, phase = 2 * kPi * frequency_Hz * t;
      vsa::device::Unit::command_direct(joint.state, {0.5 * std::sin(phase), 0});
      joint.step();
      const double after = phase + 2 * kPi * frequency_Hz * 250e-6;
      if (n >= steps) found += spring_Nm(joint) * std::polar(1.0, -after) * 2.0 / (0.5 * steps);
    }
    const std::complex<double> expected = closed_loop(config, kSpring, frequency_Hz);
    EXPECT_NEAR(std::abs(found), std::abs(expected), 0.04 * std::abs(expected)) << frequency_Hz << " Hz";
  }
  EXPECT_LT(std::abs(closed_loop(config, kSpring, 20.0)), std::sqrt(0.5)) << "beyond the bandwidth";
  EXPECT_GT(std::abs(closed_loop(config, kSpring, 14.0)), std::sqrt(0.5)) << "within it";
}

TEST(TorqueServo, IsPassiveAtTheShaftWhateverDrivesIt) {
  for (const double preset : {-20.0, 0.0, 20.0}) {
    for (const double frequency_Hz : {0.5, 2.0, 5.0, 10.0, 20.0}) {
      OneJoint joint(series(torque_servo(), 50, 0.2), 0.0, preset, 0.0, 1'000'000);
      double work = 0, stored = 0;
      const int period = static_cast<int>(std::lround(1000 / frequency_Hz));
      for (int n = 0; n < 6 * period; ++n) {
        const double phase = 2 * kPi * n / period;
        const double next = 0.05 * std::sin(phase + 2 * kPi / period);
        joint.v = (next - joint.q) * 1e3;
        joint.step();
        if (n < 2 * period) continue;
        work += joint.last_torque * joint.v * 1e-3;
        stored = std::max(stored, 0.5 * 20 * joint.q * joint.q);
      }
      EXPECT_LT(work, 0.01 * stored) << preset << " N·m/rad, " << frequency_Hz << " Hz";
    }
  }
}

TEST(TorqueServo, BeginsWithItsSpringAsItWasWhereverTheShaftIsFound) {
  OneJoint joint(series(torque_servo(), 50), 0.0, 0.0, 0.0, 1'000'000);
  joint.q = 3.7;
  joint.unit.command(joint.state, 3.6, 0.0);
  joint.step();
  EXPECT_LT(std::abs(spring_Nm(joint)), 0.5) << "not 50 N·m/rad times 3.7 rad";
  run(joint, 0.5);
  EXPECT_NEAR(spring_Nm(joint), -20.0 * 0.1, 0.02);
}

TEST(TorqueServo, LetsErrorsOfItsDeadZoneStand) {
  using vsa::control::dead_zone;
  EXPECT_EQ(dead_zone(0.2, 0.3), 0.0);
  EXPECT_EQ(dead_zone(0.5, 0.25), 0.25);
  EXPECT_EQ(dead_zone(-0.5, 0.25), -0.25);
  auto servo = torque_servo();
  servo.torque.dead_zone_Nm = 0.3;
  servo.torque.gain = 0;
  OneJoint joint(series(servo, 50, 0.4), 0.0, 0.0, 0.0, 1'000'000);
  vsa::device::Unit::command_direct(joint.state, {1.5, 0});
  run(joint, 10.0);
  EXPECT_GT(std::abs(spring_Nm(joint) - 1.5), 0.05) << "friction of 0.4 N·m keeps what isn't integrated";
  EXPECT_LT(std::abs(spring_Nm(joint) - 1.5), 0.31);
}

TEST(TorqueServo, IsOfALawWithOneMotor) {
  try {
    const vsa::device::Unit unit(vsa::test::antagonist(torque_servo()));
    ADD_FAILURE() << "a torque servo of two motors";
  } catch (const vsa::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("control.kind = torque_servo: is of a law with one motor"), std::string::npos)
        << error.what();
  }
}

}  // namespace
