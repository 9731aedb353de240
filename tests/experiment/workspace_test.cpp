// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/workspace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/one_joint.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/elastic/two_sinh.hpp"
#include "vsa/experiment/datasheet.hpp"

namespace vsa::experiment {
namespace {

constexpr double kK = 0.022, kA = 6.85;  // symmetric pair
constexpr double kSupply = 12, kDuty = 61.0 / 101.0;

device::UnitConfig drive_only() {
  device::UnitConfig u;
  for (auto& side : u.actuator.side) side.motor = {0.001, 0.01, 0.8, 1.3, 2.3, {}};
  for (auto& side : u.actuator.side) side.gearbox.friction = {0.8, 0.03};
  u.actuator.supply_V = kSupply;
  for (auto& side : u.actuator.side) side.bridge.dead_band = 0.3;
  u.actuator.shaft_friction = {0.01, 0.03};
  u.actuator.shaft_inertia_kgm2 = 1e-4;
  u.preset_max = 0.785;
  return u;
}

device::UnitConfig qbmove(double k2 = kK) {
  device::UnitConfig u = drive_only();
  u.actuator.transmission = std::make_shared<elastic::TwoSinh>(elastic::TwoSinhParams{{kK, k2}, {kA, kA}, {}});
  return u;
}

device::UnitConfig series(double stiffness) {
  device::UnitConfig u = drive_only();
  u.actuator.transmission = std::make_shared<elastic::SeriesSpring>(stiffness);
  return u;
}

constexpr double kVoltage = kSupply * kDuty;
constexpr double kStall = 0.8 * kVoltage / 2.3;
constexpr double kBack = 0.8 * 1.3 / 2.3 + 0.01;
constexpr double kMost = kStall - 0.8;  // M⁺(0)

TEST(MotorLine, IsTheStraightLineOfADcMotorBehindItsFriction) {
  const MotorLine line = motor_line(qbmove(), 0);
  EXPECT_NEAR(line.voltage_V, kVoltage, 1e-12);
  EXPECT_NEAR(line.stall_current_A, kVoltage / 2.3, 1e-12);
  EXPECT_NEAR(line.most_Nm(0), 0.8 * kVoltage / 2.3 - 0.8, 1e-12);
  EXPECT_NEAR(line.most_Nm(2), kMost - 2 * kBack, 1e-12);
  EXPECT_NEAR(line.least_Nm(2), -(kStall + 0.8 + 2 * kBack), 1e-12);
  EXPECT_NEAR(line.no_load_speed_rad_per_s(), kMost / kBack, 1e-12);
  EXPECT_NEAR(line.most_Nm(line.no_load_speed_rad_per_s()), 0, 1e-12);
}

TEST(MotorLine, OfAModulatedEnablePinIsTheCircuitsCurrentBehindTheFriction) {
  device::UnitConfig u = qbmove();
  for (auto& side : u.actuator.side) side.bridge.pin = drive::PwmPin::enable;
  for (auto& side : u.actuator.side) side.gearbox.friction.coulomb_Nm = 0.2;
  const MotorLine line = motor_line(u, 0);
  EXPECT_NEAR(line.voltage_V, (2 * kDuty - 1) * kSupply, 1e-12) << "fast switching: (2d - 1)V";
  EXPECT_NEAR(line.most_Nm(0), 0.8 * line.voltage_V / 2.3 - 0.2, 1e-12);
  EXPECT_NEAR(line.most_Nm(line.no_load_speed_rad_per_s()), 0, 1e-9);
  EXPECT_NEAR(line.least_Nm(1), -(0.8 * (line.voltage_V + 1.3) / 2.3 + 0.2 + 0.01), 1e-12);
  EXPECT_NEAR(standing_voltage(u, 0, 0.8, line.full_duty), 0, 1e-12) << "below half the duty there is none";
  // A slow PWM leaves the current time to rise: the line bends, and a fast motor still has some torque.
  for (auto& side : u.actuator.side) side.bridge.period_s = 50.5e-6;
  for (auto& side : u.actuator.side) side.motor.inductance_H = 1e-4;
  const MotorLine bent = motor_line(u, 0);
  EXPECT_GT(bent.voltage_V, line.voltage_V);
  EXPECT_GT(bent.no_load_speed_rad_per_s(), 1.2 * line.no_load_speed_rad_per_s());
}

TEST(MotorLine, GivesTheSameAtThePulleyThroughAGearbox) {
  device::UnitConfig geared = qbmove();
  const double n = 50;
  actuator::SideParams& second = geared.actuator.side[1];
  drive::MotorParams& m = second.motor;
  m.viscous_Nms_per_rad /= n * n;
  m.torque_constant_Nm_per_A /= n;
  m.back_emf_Vs_per_rad /= n;
  second.gearbox.friction.coulomb_Nm /= n;
  second.gearbox.ratio = n;
  const MotorLine a = motor_line(geared, 0), b = motor_line(geared, 1);
  EXPECT_NEAR(a.stall_Nm, b.stall_Nm, 1e-12);
  EXPECT_NEAR(a.friction_Nm, b.friction_Nm, 1e-12);
  EXPECT_NEAR(a.back_Nms_per_rad, b.back_Nms_per_rad, 1e-12);
}

TEST(MotorLine, LosesMoreUnderLoadBehindALossyGear) {
  device::UnitConfig u = qbmove();
  for (auto& side : u.actuator.side) side.gearbox.load_loss = 0.25;  // an efficiency of 0.8
  EXPECT_NEAR(motor_line(u, 0).most_Nm(1), 0.8 * (kMost - kBack), 1e-12);
}

TEST(MotorLine, StandsStillWhereFrictionIsMoreThanTheMotorGives) {
  device::UnitConfig u = qbmove();
  u.actuator.supply_V = 1;
  EXPECT_EQ(motor_line(u, 0).no_load_speed_rad_per_s(), 0);
}

TEST(MotorLine, TakesTheVoltageThatTheUnitGivesAtFullOutput) {
  for (const double supply : {7.0, 12.0, 24.0}) {
    for (const bool limited : {true, false}) {
      device::UnitConfig u = qbmove();
      u.actuator.supply_V = supply;
      u.program.supply_table = limited;
      device::Unit unit(u);
      device::UnitState s = unit.initial(0, 0, 0);
      unit.set_inputs(s, unit.inputs_for(2, 0));
      for (int k = 0; k < 4; ++k) unit.step(s, k * 1'000'000, 1'000'000, {0, 0, 0});
      EXPECT_NEAR(s.held.voltage[0], motor_line(u, 0).voltage_V, 1e-9) << supply << " V, limit " << limited;
    }
  }
}

TEST(Workspace, OfASoftPairEndsWhereBothMotorsAreAtTheirMost) {
  const Workspace w(qbmove());
  const double lag = std::asinh(kMost / kK) / kA;
  const Reach peak = w.reach(0, 0);
  EXPECT_NEAR(peak.torque_Nm, 2 * kMost - 0.01, 1e-9);
  EXPECT_NEAR(peak.deflection_rad, lag, 1e-9);
  EXPECT_NEAR(peak.stiffness_Nm_per_rad, 2 * kA * kK * std::cosh(kA * lag), 1e-6);
  EXPECT_NEAR(peak.energy_J, 2 * kK / kA * (std::cosh(kA * lag) - 1), 1e-9);
  EXPECT_NEAR(w.no_load_speed(0), (2 * kMost - 0.01) / (2 * kBack), 1e-9);
  EXPECT_NEAR(w.stiffness_at_rest(0.3), 2 * kA * kK * std::cosh(kA * 0.3), 1e-12);
}

TEST(Workspace, PaysForPretensionWithTorqueAndSpeed) {
  const Workspace w(qbmove());
  const double p = 0.4, lag = std::asinh(kMost / kK) / kA - p;  // the leading motor: k sinh(a(d + p)) = M⁺
  const Reach peak = w.reach(p, 0);
  EXPECT_NEAR(peak.deflection_rad, lag, 1e-9);
  EXPECT_NEAR(peak.torque_Nm, 2 * kK * std::cosh(kA * p) * std::sinh(kA * lag) - 0.01, 1e-9);
  EXPECT_LT(w.no_load_speed(p), w.no_load_speed(0));
  EXPECT_LT(w.reach(p, 1).torque_Nm, w.reach(0, 1).torque_Nm);
}

TEST(Workspace, HoldsMoreThanItMovesAndSomethingWithoutVoltage) {
  const Workspace w(qbmove());
  EXPECT_NEAR(w.reach(0, 0, Task::hold).torque_Nm, 2 * (kStall + 0.8) + 0.01, 1e-9);
  EXPECT_NEAR(w.reach(0, 0, Task::unpowered).torque_Nm, 2 * 0.8 + 0.01, 1e-9);
  const double too_stiff = std::asinh(0.81 / kK) / kA;  // the springs' own tension is more than the friction
  EXPECT_TRUE(std::isnan(w.reach(too_stiff, 0, Task::unpowered).torque_Nm));
}

TEST(Workspace, PaysForWhatFrictionDoesntHoldWithTheHeatOfTheWindings) {
  const double p = std::asinh(1.0 / kK) / kA;  // each spring's tension is 1 N·m, of which friction holds 0.8
  const Workspace w(qbmove());
  const double current = (1.0 - 0.8) / 0.8;
  EXPECT_NEAR(w.holding(p).current_A, 2 * current, 1e-9);
  EXPECT_NEAR(w.holding(p).power_W, 2 * 2.3 * current * current, 1e-9);
  EXPECT_EQ(w.holding(0).power_W, 0) << "slack springs";
  // A load that one motor takes over and the other gives up: k sinh(a(p + d)) = 1.4, k sinh(a(p − d)) = 0.6 N·m at most.
  const double d = std::asinh(1.4 / kK) / kA - p;
  const double load = 1.4 - kK * std::sinh(kA * (p - d));
  EXPECT_NEAR(w.holding(p, load).current_A, (1.4 - 0.8) / 0.8, 1e-6);
  EXPECT_NEAR(w.holding(p, -load).power_W, w.holding(p, load).power_W, 1e-9) << "a symmetric pair";
  EXPECT_TRUE(std::isnan(w.holding(0, 2 * (kStall + 0.8) + 0.1).power_W)) << "beyond full voltage";
}

TEST(Workspace, WindsItsSpringsUpToTheMotorsTorque) {
  EXPECT_NEAR(Workspace(qbmove()).attainable_preset(), std::asinh(kMost / kK) / kA, 1e-9);
  device::UnitConfig limited = qbmove();
  limited.preset_max = 0.5;
  EXPECT_EQ(Workspace(limited).attainable_preset(), 0.5);
  limited.actuator.supply_V = 1;
  EXPECT_EQ(Workspace(limited).attainable_preset(), 0) << "friction holds the motors";
}

TEST(Workspace, OfASeriesSpringIsItsMotorsLine) {
  const double k = 10;
  const Workspace w(series(k));
  for (const double speed : {0.0, 1.0, 3.0}) {
    const Reach r = w.reach(0, speed);
    EXPECT_NEAR(r.torque_Nm, kMost - kBack * speed - 0.01, 1e-9);
    EXPECT_NEAR(r.deflection_rad, (kMost - kBack * speed) / k, 1e-9);
    EXPECT_NEAR(r.stiffness_Nm_per_rad, k, 1e-12);
  }
  EXPECT_EQ(w.attainable_preset(), 0);
  EXPECT_NEAR(w.stiffness_under(0, 1.0), k, 1e-12);
  EXPECT_TRUE(std::isnan(w.stiffness_under(0, kMost + 0.01)));
}

TEST(Workspace, HasItsMostPowerInTheMiddleOfAStraightLine) {
  const Workspace w(series(10));
  const auto boundary = w.boundary(0, 201);
  const double stall = kMost - 0.01, fastest = stall / kBack;
  EXPECT_NEAR(boundary.back().speed_rad_per_s, fastest, 1e-9);
  EXPECT_NEAR(boundary.back().reach.torque_Nm, 0, 1e-9);
  const BestPower best = best_power(boundary);
  EXPECT_NEAR(best.power_W, stall * fastest / 4, 1e-9);
  EXPECT_NEAR(best.speed_rad_per_s, fastest / 2, 1e-9);
  EXPECT_NEAR(best.torque_Nm, stall / 2, 1e-9);
}

TEST(Workspace, StiffnessUnderALoadIsTheLawsAtItsDeflection) {
  const Workspace w(qbmove());
  const double p = 0.2, load = 1.2, deflection = std::asinh(load / (2 * kK * std::cosh(kA * p))) / kA;
  const double sigma = 2 * kA * kK * std::cosh(kA * p) * std::cosh(kA * deflection);
  EXPECT_NEAR(w.stiffness_under(p, load), sigma, 1e-9);
  EXPECT_NEAR(w.stiffness_under(p, -load), sigma, 1e-9);
}

TEST(Workspace, CurvesRunBetweenTheLoadsOfBothDirections) {
  const Workspace w(qbmove(0.015));  // unequal springs
  const auto curve = w.law_curve(0.3, 51);
  EXPECT_NEAR(curve.front().load_Nm, -(w.reach(0.3, 0, Task::move, 1).torque_Nm + 0.01), 1e-9);
  EXPECT_NEAR(curve.back().load_Nm, w.reach(0.3, 0, Task::move, -1).torque_Nm + 0.01, 1e-9);
  EXPECT_GT(std::abs(curve.front().load_Nm + curve.back().load_Nm), 1e-3) << "the two directions differ";
  for (std::size_t i = 1; i < curve.size(); ++i) EXPECT_GT(curve[i].load_Nm, curve[i - 1].load_Nm);
}

TEST(Workspace, IsWhatTheSimulatedUnitGivesToAShaftThatTurnsSteadily) {
  const Workspace w(qbmove());
  device::UnitConfig unit = qbmove();
  unit.memory.limits_on = 0;  // a long way to run
  for (const double speed : {0.5, 1.5, 3.0}) {
    test::OneJoint joint(unit, -2.8, 0, 0, 1'000'000);
    joint.q -= 0.7;
    joint.v = speed;                                                   // without inertia the shaft's motion is prescribed
    joint.unit.set_inputs(joint.state, {Ticks{32767}, Ticks{32767}});  // one turn ahead
    while (joint.q < 4) joint.step();
    const double lag = joint.state.actuator.motor[0].angle - joint.q;
    EXPECT_NEAR(joint.last_torque, w.reach(0, speed).torque_Nm, 1e-3) << speed << " rad/s";
    EXPECT_NEAR(lag, w.reach(0, speed).deflection_rad, 2e-3) << speed << " rad/s";
  }
}

TEST(Workspace, OfUnequalSpringsStartsWhereTheShaftRests) {
  const Workspace w(qbmove(0.06));  // k of the other is kK
  const auto& law = *qbmove(0.06).actuator.transmission;
  for (const double p : {0.1, 0.3}) {
    const auto x = law.references({0, p});
    // By hand: the shaft goes where k₁ sinh(a(q − p)) + k₂ sinh(a(q + p)) = 0.
    double low = -p, high = p;
    for (int i = 0; i < 100; ++i) (law.evaluate({0.5 * (low + high), x}).torque > 0 ? low : high) = 0.5 * (low + high);
    ASSERT_GT(std::abs(low), 0.01);
    EXPECT_NEAR(w.stiffness_at_rest(p), law.evaluate({low, x}).curvature.qq, 1e-9);
    EXPECT_NEAR(w.energy_at_rest(p), law.evaluate({low, x}).energy, 1e-12);
    EXPECT_LT(w.energy_at_rest(p), law.evaluate({0, x}).energy) << "at rest there is the least";
    EXPECT_NEAR(w.stiffness_under(p, 1e-9), w.stiffness_at_rest(p), 1e-6);
    EXPECT_NEAR(w.stiffness_under(p, -1e-9), w.stiffness_at_rest(p), 1e-6);
  }
}

TEST(DataSheet, TellsBothDirectionsAndTheMirroredActuatorHasThemExchanged) {
  config::ActuatorType one, mirrored;
  one.unit = qbmove(0.06);
  mirrored.unit = one.unit;
  elastic::TwoSinhParams springs;
  springs.k_Nm = {0.06, kK};
  springs.a_per_rad = {kA, kA};
  mirrored.unit.actuator.transmission = std::make_shared<elastic::TwoSinh>(springs);
  const DataSheet a = data_sheet(one), b = data_sheet(mirrored);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    const PresetColumn &x = a.columns[i], &y = b.columns[i];
    EXPECT_NEAR(x.peak.torque_Nm, y.back.peak.torque_Nm, 1e-9);
    EXPECT_NEAR(x.back.peak.torque_Nm, y.peak.torque_Nm, 1e-9);
    EXPECT_NEAR(x.no_load_speed_rad_per_s, y.back.no_load_speed_rad_per_s, 1e-9);
    EXPECT_NEAR(x.stiffness_at_half_Nm_per_rad, y.back.stiffness_at_half_Nm_per_rad, 1e-6);
    EXPECT_EQ(x.weaker().peak.torque_Nm, std::min(x.peak.torque_Nm, x.back.peak.torque_Nm));
  }
  EXPECT_GT(std::abs(a.columns[2].peak.torque_Nm - a.columns[2].back.peak.torque_Nm), 0.01) << "they differ";
}

TEST(DataSheet, StoresTheMostEnergyAtItsCorners) {
  config::ActuatorType type;
  type.unit = qbmove();
  const DataSheet sheet = data_sheet(type);
  ASSERT_EQ(sheet.columns.size(), 5U);
  EXPECT_EQ(sheet.columns.front().preset, 0);
  EXPECT_NEAR(sheet.columns.back().preset, 0.9 * sheet.attainable_preset, 1e-12);
  const double corner = 2 * kK / kA * (std::cosh(std::asinh(kMost / kK)) - 1);
  EXPECT_NEAR(sheet.most_energy_J, corner, 1e-9);
  const Workspace w(type.unit);
  EXPECT_NEAR(w.energy_at_rest(sheet.attainable_preset), corner, 1e-9) << "wound up instead of deflected";
  EXPECT_NEAR(w.reach(sheet.attainable_preset, 0).torque_Nm, -0.01, 1e-6) << "nothing is left for a load";
  EXPECT_NEAR(sheet.stiffest_Nm_per_rad, 2 * kA * kK * std::cosh(std::asinh(kMost / kK)), 1e-6);
}

TEST(DataSheet, ErrorsOfThePositionLoopFollowFromItsGainDeadBandAndFriction) {
  config::ActuatorType type;
  type.unit = qbmove();
  const LoopErrors e = data_sheet(type).errors[0];
  const double full = 100 / (6553 / 65536.0) * 2 * 3.14159265358979 / 65536;
  EXPECT_NEAR(e.full_rad, full, 1e-9);
  EXPECT_NEAR(e.moves_rad, full * (0.3 + 0.7 * 0.8 / kStall), 1e-9);
  type.unit.actuator.supply_V = 1;
  EXPECT_TRUE(std::isnan(data_sheet(type).errors[0].moves_rad));
}

TEST(DataSheet, OfAnActuatorWithoutPresetHasOneColumn) {
  config::ActuatorType type;
  type.unit = series(10);
  const DataSheet sheet = data_sheet(type);
  ASSERT_EQ(sheet.columns.size(), 1U);
  EXPECT_NEAR(sheet.most_energy_J, 0.5 * kMost * kMost / 10, 1e-9);
}

}  // namespace
}  // namespace vsa::experiment
