// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Servos as matrices, against closed forms and against the simulated unit.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/servos.hpp"
#include "vsa/linear/linear.hpp"
#include "vsa/linear/robot.hpp"

namespace {

using vsa::linear::DryFriction;
using vsa::linear::Firmware;
using vsa::linear::Model;
using vsa::test::antagonist;
using vsa::test::motor_voltages;
using vsa::test::OneJoint;
using vsa::test::position_servo;
using vsa::test::series;
using vsa::test::torque_servo;

constexpr double kSpring = 50;

TEST(LinearServo, StandsStaticallyOnItsSpringOrOnTheStiffnessCommanded) {
  EXPECT_NEAR(linearize(series(position_servo(), kSpring), {}, Firmware::averaged).static_stiffness_Nm_per_rad, kSpring, 1e-6);
  vsa::linear::OperatingPoint point;
  point.preset = 10;
  EXPECT_NEAR(linearize(series(torque_servo(), kSpring), point, Firmware::sampled).static_stiffness_Nm_per_rad, 30, 1e-6);
  EXPECT_EQ(linearize(series(motor_voltages(), kSpring), {}, Firmware::averaged).static_stiffness_Nm_per_rad, 0);
  auto proportional = position_servo();
  proportional.position.integral_Nm_per_rad = 0;
  const double motor = proportional.position.gain_per_s * proportional.position.speed_gain_Nms_per_rad;
  EXPECT_NEAR(linearize(series(proportional, kSpring), {}, Firmware::averaged).static_stiffness_Nm_per_rad,
              kSpring * motor / (kSpring + motor), 1e-6);
}

TEST(LinearServo, FollowsItsReferenceWithoutAnError) {
  for (const auto& unit : {series(position_servo(), kSpring), series(torque_servo(), kSpring)}) {
    vsa::linear::OperatingPoint point;
    point.inertia_kgm2 = 0.02;
    point.damping_Nms_per_rad = 0.1;
    const Model m = linearize(unit, point, Firmware::averaged);
    const Eigen::VectorXd rest = m.a.fullPivLu().solve(-m.b.col(1));
    EXPECT_NEAR(rest[0], 1.0, 1e-9);
    EXPECT_LT(m.a.eigenvalues().real().maxCoeff(), 0);
    EXPECT_EQ(m.states.size(), static_cast<std::size_t>(m.a.rows()));
    EXPECT_EQ(m.inputs[1].unit, "rad");
  }
}

/// A small step of the command, from tick to tick.
template <class Command>
void expect_same_motion(const vsa::device::UnitConfig& unit, Command&& command, double bound) {
  constexpr double kStep_rad = 0.02, kInertia = 0.02, kDamping = 0.2;
  vsa::linear::OperatingPoint point;
  point.inertia_kgm2 = kInertia;
  point.damping_Nms_per_rad = kDamping;
  const Model m = linearize(unit, point, Firmware::sampled);
  ASSERT_EQ(m.period_s, 1e-3);
  OneJoint joint(unit, 0.0, 0.0, kInertia, 250'000);
  joint.load = [&](double) { return -kDamping * joint.v; };
  for (int n = 0; n < 4; ++n) joint.step();
  command(joint, kStep_rad);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(m.a.rows());
  double worst = 0;
  for (int k = 0; k < 400; ++k) {
    worst = std::max(worst, std::abs(joint.q - x[0]));
    for (int n = 0; n < 4; ++n) joint.step();
    x = m.a * x + m.b.col(1) * kStep_rad;
  }
  EXPECT_LT(worst, bound * kStep_rad);
  EXPECT_NEAR(joint.q, kStep_rad, 0.1 * kStep_rad);
}

TEST(LinearServo, SampledGoesAsTheUnitDoesFromTickToTick) {
  const auto equilibrium = [](OneJoint& joint, double step) { joint.unit.command(joint.state, step, 0.0); };
  expect_same_motion(series(position_servo(), kSpring), equilibrium, 0.03);
  expect_same_motion(series(torque_servo(), kSpring), equilibrium, 0.03);
}

TEST(LinearServo, HasItsStatesBehindThoseOfAFirmwareUnitOfTheSameBodies) {
  vsa::linear::Bodies bodies;
  for (const char* name : {"a", "b"}) bodies.joints.push_back({name, false, 0, 0.1, 0});
  bodies.mass = 0.02 * Eigen::MatrixXd::Identity(2, 2);
  bodies.gravity_stiffness = Eigen::MatrixXd::Zero(2, 2);
  vsa::device::UnitConfig qbmove = vsa::test::maker_pro();
  for (auto& side : qbmove.actuator.side) side.bridge.dead_band = 0;
  const auto servo = series(torque_servo(), kSpring);
  for (const Firmware firmware : {Firmware::averaged, Firmware::sampled}) {
    const auto m = linearize(bodies, {{"q", qbmove, {}, 0}, {"s", servo, {}, 1}}, firmware);
    vsa::linear::OperatingPoint alone;
    alone.inertia_kgm2 = 0.02;
    alone.damping_Nms_per_rad = 0.1;
    auto poles = [](const vsa::linear::System& system) {
      const Eigen::VectorXcd all = system.a.eigenvalues();
      return std::vector<std::complex<double>>(all.begin(), all.end());
    };
    const auto together = poles(m);
    for (const auto& unit : {qbmove, servo}) {
      for (const auto& pole : poles(linearize(unit, alone, firmware))) {
        double nearest = 1e9;
        for (const auto& other : together) nearest = std::min(nearest, std::abs(other - pole));
        EXPECT_LT(nearest, 1e-4 * (1 + std::abs(pole))) << pole;
      }
    }
    EXPECT_NEAR(m.static_stiffness(1, 1), 20, 1e-6);
    EXPECT_EQ(m.states.size(), static_cast<std::size_t>(m.a.rows()));
  }
}

}  // namespace
