// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/unit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/ledger.hpp"
#include "support/one_joint.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/errors.hpp"

namespace {

using vsa::test::maker_pro;
using vsa::test::OneJoint;

void command(OneJoint& joint, double equilibrium, double preset) {
  joint.unit.set_inputs(joint.state, joint.unit.inputs_for(equilibrium, preset));
}

void run(OneJoint& joint, double seconds) {
  const auto end = joint.t_ns + static_cast<std::int64_t>(seconds * 1e9);
  while (joint.t_ns < end) joint.step();
}

TEST(Unit, FollowsACommandedEquilibriumWithinItsDeadBand) {
  OneJoint joint(maker_pro(), 0.0, 0.2, 1e-3, 1'000'000);
  run(joint, 0.1);
  command(joint, 1.0, 0.2);
  run(joint, 2.0);
  EXPECT_NEAR(joint.q, 1.0, 0.1) << "the position loop's dead band is 0.03 rad, friction adds to it";
  EXPECT_GT(joint.q, 0.85);
}

TEST(Unit, ForgottenNumbersAreRefusedByName) {
  vsa::device::UnitConfig config = maker_pro();
  for (auto& side : config.actuator.side) side.motor = {};
  for (auto& side : config.actuator.side) side.motor.inertia_kgm2 = 0.001;
  try {
    const vsa::device::Unit unit(config);
    ADD_FAILURE() << "a motor without resistance";
  } catch (const vsa::InputError& error) {
    EXPECT_EQ(error.problems().size(), 4U) << error.what();
    EXPECT_NE(std::string(error.what()).find("drive.resistance_Ohm = nan: is out of range"), std::string::npos) << error.what();
  }
}

TEST(Unit, HoldsStillWithoutACommand) {
  OneJoint joint(maker_pro(), 0.3, 0.2, 1e-3, 1'000'000);
  run(joint, 1.0);
  EXPECT_NEAR(joint.q, 0.3, 2e-3);
}

TEST(Unit, NoLoadSpeedIsWhatVoltageFrictionAndBackEmfAllow) {
  // (K_τ V/R − τ_c)/(b + K_τ K_b/R) with V = 61/101·12 V: 3.8 rad/s
  OneJoint joint(maker_pro(), 0.0, 0.6, 1e-4, 1'000'000);
  run(joint, 0.1);
  command(joint, 2.0, 0.6);
  run(joint, 0.3);
  const double volts = 61.0 / 101.0 * 12.0;
  const double expected = (0.8 * volts / 2.3 - 0.8) / (0.01 + 0.8 * 1.3 / 2.3);
  const double mean = 0.5 * (joint.state.actuator.motor[0].speed + joint.state.actuator.motor[1].speed);
  EXPECT_NEAR(mean, expected, 0.05 * expected);
}

TEST(Unit, EnergyLedgerBalancesToRounding) {
  for (std::int64_t step_ns : {250'000, 1'000'000, 4'000'000}) {
    vsa::device::UnitConfig config = maker_pro();
    for (auto& side : config.actuator.side) side.motor.inductance_H = 1e-3;
    OneJoint joint(config, 0.0, 0.3, 1e-3, step_ns);
    joint.load = [](double q) { return -0.8 * std::sin(q); };
    for (int n = 0; n < 10; ++n) {
      command(joint, n % 2 == 0 ? 1.0 : -1.0, 0.1 * (n % 7));
      run(joint, 0.4);
    }
    joint.step();
    const auto& l = joint.state.actuator.ledger;
    EXPECT_GT(l.moved(), 5.0);
    EXPECT_LT(std::abs(l.imbalance()), 1e-11 * l.moved()) << step_ns;
    if (step_ns <= 1'000'000) {
      EXPECT_LT(std::abs(l.integrator) + std::abs(l.coupling), 0.01 * l.moved()) << step_ns;
    }
    EXPECT_GT(l.copper, 0);
    EXPECT_GT(l.motor_friction, 0);
    EXPECT_GT(l.shaft_friction, 0);
    EXPECT_GT(l.viscous, 0);
  }
}

TEST(Unit, DeliveredEnergyIsWhatTheJointReceived) {
  OneJoint joint(maker_pro(), 0.0, 0.3, 1e-3, 1'000'000);
  run(joint, 0.1);
  command(joint, 1.0, 0.3);
  double received = 0.5 * joint.inertia * joint.v * joint.v;  // it began at rest
  for (int n = 0; n < 500; ++n) {
    const double before = joint.v;
    joint.step();
    received += 0.5 * joint.inertia * (joint.v * joint.v - before * before);
  }
  const double torque = joint.last_torque;
  const double dy_open = joint.q - 0.5e-3 * joint.v - joint.state.start_y;  // the last step isn't settled yet
  EXPECT_NEAR(joint.state.actuator.ledger.delivered + torque * dy_open, received, 1e-11);
}

TEST(Unit, CopiedStateContinuesBitForBit) {
  OneJoint a(maker_pro(), 0.0, 0.3, 1e-3, 1'000'000);
  run(a, 0.2);
  command(a, 0.7, 0.5);
  run(a, 0.05);
  OneJoint b = a;
  run(a, 0.5);
  run(b, 0.5);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.state.actuator.ledger.supply, b.state.actuator.ledger.supply);
}

TEST(Unit, OrderOfTheTwoMotorsDoesNotMatter) {
  // Mirror the command: motor 1 and 2 change places, the shaft goes the other way.
  OneJoint a(maker_pro(), 0.0, 0.4, 1e-3, 1'000'000), b(maker_pro(), 0.0, -0.4, 1e-3, 1'000'000);
  run(a, 0.05);
  run(b, 0.05);
  command(a, 0.6, 0.4);
  command(b, 0.6, -0.4);
  run(a, 0.4);
  run(b, 0.4);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.state.actuator.motor[0].angle, b.state.actuator.motor[1].angle);
}

TEST(Unit, ClampsThePresetAndSixteenBitReferences) {
  const vsa::device::Unit unit(maker_pro());
  EXPECT_EQ(unit.inputs_for(0, 2.0), unit.inputs_for(0, 0.785));
  EXPECT_EQ(unit.inputs_for(100.0, 0)[0].value, 32767);
  EXPECT_EQ(unit.inputs_for(-100.0, 0)[0].value, -32768);
}

TEST(Unit, CoastsOrBrakesWhenOff) {
  for (const bool brake : {true, false}) {
    auto config = maker_pro();
    for (auto& side : config.actuator.side) side.bridge.brake_when_off = brake;
    for (auto& side : config.actuator.side) side.gearbox.friction = {0, 0};
    OneJoint joint(config, 0.0, 0.0, 1e-3, 1'000'000);
    joint.state.program.enable = 0;
    joint.q = 1.0;
    run(joint, 0.2);
    const double copper = joint.state.actuator.ledger.copper;
    if (brake) {
      EXPECT_GT(copper, 0.0);
    } else {
      EXPECT_EQ(copper, 0.0);
    }
  }
}

/// Fast switching: below half the duty a bridge with a modulated enable pin gives a standing motor nothing.
vsa::device::UnitConfig chopped() {
  auto config = maker_pro();
  for (auto& side : config.actuator.side) side.bridge.pin = vsa::drive::PwmPin::enable;
  for (auto& side : config.actuator.side) side.bridge.dead_band = 0;
  config.program.supply_table = false;
  return config;
}

TEST(Unit, AModulatedEnablePinGivesNothingBelowHalfTheDuty) {
  for (const double error : {0.03, -0.03, 0.085, -0.085}) {  // 0.096 rad is full output
    OneJoint joint(chopped(), 0.0, 0.0, 1e-3, 1'000'000);
    run(joint, 0.1);
    command(joint, error, 0.0);
    run(joint, 0.02);
    const double current = joint.unit.physics().motor_current(joint.state.actuator, 0, joint.state.held.voltage[0],
                                                              joint.state.held.terminal[0], joint.state.held.supply_V);
    EXPECT_GT(joint.state.held.voltage[0] * error, 0.0);
    if (std::abs(error) < 0.05) {
      EXPECT_EQ(joint.state.actuator.ledger.copper, 0.0);
      EXPECT_EQ(current, 0.0);
    } else {
      EXPECT_GT(joint.state.actuator.ledger.copper, 0.0);
      EXPECT_GT(current * error, 0.0);
    }
  }
}

TEST(Unit, AModulatedEnablePinFollowsACommandAndKeepsTheBooks) {
  auto config = chopped();
  for (auto& side : config.actuator.side) side.bridge.period_s = 50.5e-6;
  for (auto& side : config.actuator.side) side.motor.inductance_H = 2e-4;
  for (auto& side : config.actuator.side) side.gearbox.friction.coulomb_Nm = 0.2;
  for (const std::int64_t dt_ns : {1'000'000, 700'000, 4'000'000}) {
    OneJoint joint(config, 0.0, 0.3, 1e-3, dt_ns);
    run(joint, 0.1);
    command(joint, 1.0, 0.3);
    run(joint, 2.0);
    EXPECT_NEAR(joint.q, 1.0, 0.15) << dt_ns;
    const auto& ledger = joint.state.actuator.ledger;
    EXPECT_LT(std::abs(ledger.imbalance()), 1e-10 * ledger.moved()) << dt_ns;
    EXPECT_LT(std::abs(ledger.integrator), 0.02 * ledger.moved()) << dt_ns;
  }
}

TEST(Unit, OffOrWithoutSupplyAModulatedEnablePinLetsTheMotorsCoast) {
  for (const bool supply : {true, false}) {
    auto config = chopped();
    for (auto& side : config.actuator.side) side.gearbox.friction = {0, 0};
    OneJoint joint(config, 0.0, 0.0, 1e-3, 1'000'000);
    joint.state.program.enable = 0;
    joint.state.supply_on = supply;
    joint.q = 0.2;  // the springs turn the motors, more slowly than the diodes need
    run(joint, 0.2);
    EXPECT_EQ(joint.state.actuator.ledger.copper, 0.0);
    EXPECT_GT(std::abs(joint.state.actuator.motor[0].angle), 0.01);
  }
}

TEST(Unit, ASeriesElasticActuatorRunsThroughTheSameDoor) {
  auto config = maker_pro();
  config.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(10.0);
  OneJoint joint(config, 0.0, 0.0, 1e-3, 1'000'000);
  run(joint, 0.1);
  command(joint, 0.8, 0.0);
  run(joint, 2.0);
  EXPECT_NEAR(joint.q, 0.8, 0.1);
  EXPECT_EQ(joint.state.actuator.motor[1].angle, 0.0);
  EXPECT_LT(std::abs(joint.state.actuator.ledger.imbalance()), 1e-11 * joint.state.actuator.ledger.moved());
  vsa::test::expect_small_closures(joint.state.actuator.ledger, 0.01);
}

TEST(Unit, StaysBoundedWhateverItIsTold) {
  OneJoint joint(maker_pro(), 0.0, 0.0, 1e-4, 4'000'000);
  unsigned seed = 1;
  for (int n = 0; n < 2000; ++n) {
    seed = seed * 1664525u + 1013904223u;
    joint.unit.set_inputs(joint.state,
                          {vsa::Ticks{static_cast<std::int16_t>(seed >> 16)}, vsa::Ticks{static_cast<std::int16_t>(seed)}});
    for (int k = 0; k < 5; ++k) joint.step();
    ASSERT_TRUE(std::isfinite(joint.q) && std::isfinite(joint.v)) << n;
    ASSERT_LT(std::abs(joint.q), 20.0) << n;
  }
}

}  // namespace
