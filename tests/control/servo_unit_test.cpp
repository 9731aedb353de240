// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What all servos share: voltages, states, places, faults, parameters.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/servos.hpp"
#include "vsa/device/emulation.hpp"
#include "vsa/device/reading.hpp"
#include "vsa/device/unit_batch.hpp"

namespace {

using vsa::device::Unit;
using vsa::device::UnitConfig;
using vsa::test::antagonist;
using vsa::test::motor_voltages;
using vsa::test::OneJoint;
using vsa::test::position_servo;
using vsa::test::series;
using vsa::test::torque_servo;

void run(OneJoint& joint, double seconds) {
  const auto end = joint.t_ns + static_cast<std::int64_t>(seconds * 1e9);
  while (joint.t_ns < end) joint.step();
}

TEST(MotorVoltages, TurnAMotorAsTheOpenLoopDoes) {
  // J ω' = K_τ (V − K_b ω)/R − b ω:  ω = ω∞ (1 − e^{−t/T}),  ω∞ = K_τ V/(K_τ K_b + R b),  T = J R/(K_τ K_b + R b)
  UnitConfig config = series(motor_voltages(), 1e-6);
  config.actuator.side[0].motor.inertia_kgm2 = 0.02;
  OneJoint joint(config, 0.0, 0.0, 0.0, 1'000'000);
  Unit::command_direct(joint.state, {6.0, 0.0});
  const double loss = 1.0 + 2.3 * 0.01, time_s = 0.02 * 2.3 / loss;
  for (int n = 1; n <= 200; ++n) {
    joint.step();
    const double expected = 6.0 / loss * (1 - std::exp(-n * 1e-3 / time_s));
    EXPECT_NEAR(joint.state.actuator.motor[0].speed, expected, 1e-5 + 1e-6 * expected) << n;
  }
}

TEST(MotorVoltages, EndAtTheSupplyAndTakeNoOtherCommand) {
  OneJoint joint(antagonist(motor_voltages()), 0.0, 0.0, 1e-3, 1'000'000);
  joint.unit.command(joint.state, 1.0, 0.4);
  run(joint, 0.5);
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, 0.0, 1e-6);
  Unit::command_direct(joint.state, {100.0, -3.0});
  joint.step();
  EXPECT_EQ(joint.state.held.voltage[0], 12.0);
  EXPECT_EQ(joint.state.held.voltage[1], -3.0);
}

std::vector<UnitConfig> each_kind() {
  return {series(position_servo(), 50, 0.2), antagonist(position_servo()), series(torque_servo(), 50, 0.2),
          antagonist(motor_voltages())};
}

/// Commands now and then; a load that swings.
void play(OneJoint& joint, int from, int steps) {
  joint.load = [](double q) { return 0.3 * std::cos(5 * q); };
  for (int n = from; n < from + steps; ++n) {
    if (n % 40 == 0) {
      joint.unit.command(joint.state, 0.3 * std::sin(0.01 * n), 0.1);
      Unit::command_direct(joint.state, {std::sin(0.02 * n), -0.5 * std::sin(0.02 * n)});
    }
    joint.step();
  }
}

TEST(Servo, StateAsNumbersGoesOnWithTheSameBits) {
  for (const UnitConfig& config : each_kind()) {
    OneJoint joint(config, 0.1, 0.0, 2e-3, 700'000);
    play(joint, 0, 333);
    std::vector<double> kept(Unit::state_size());
    Unit::save(joint.state, kept);
    const double q = joint.q, v = joint.v;
    const auto t_ns = joint.t_ns;
    play(joint, 333, 300);
    std::vector<double> straight(Unit::state_size()), again(Unit::state_size());
    Unit::save(joint.state, straight);
    Unit::restore(joint.state, kept);
    joint.q = q, joint.v = v, joint.t_ns = t_ns;
    play(joint, 333, 300);
    Unit::save(joint.state, again);
    EXPECT_EQ(vsa::first_difference(straight, again), std::nullopt) << vsa::control::name_of(config.servo->kind);
  }
}

TEST(Servo, EnergyLedgerBalances) {
  for (const UnitConfig& config : each_kind()) {
    OneJoint joint(config, 0.1, 0.0, 2e-3, 1'000'000);
    play(joint, 0, 2000);
    joint.step();
    const auto& l = joint.state.actuator.ledger;
    EXPECT_GT(l.moved(), 0.01);
    EXPECT_LT(std::abs(l.imbalance()), 1e-10 * l.moved()) << vsa::control::name_of(config.servo->kind);
  }
}

TEST(Servo, UnitsOfABatchGoAsTheyDoAlone) {
  for (const UnitConfig& config : each_kind()) {
    constexpr std::size_t kUnits = 5;
    vsa::device::UnitBatch batch(config, kUnits);
    OneJoint joint(config, 0.0, 0.0, 2e-3, 500'000);
    std::vector<double> q(kUnits), v(kUnits), a(kUnits, 500.0), torque(kUnits);
    for (int n = 0; n < 400; ++n) {
      if (n == 20) {
        joint.unit.command(joint.state, 0.4, 0.1);
        for (std::size_t i = 0; i < kUnits; ++i) batch.command(i, 0.4, 0.1);
      }
      batch.step(joint.dt_ns, q, v, a, torque);
      joint.step();
      for (std::size_t i = 0; i < kUnits; ++i) {
        ASSERT_EQ(torque[i], joint.last_torque) << n;
        v[i] += 500e-6 * torque[i] / 2e-3;
        q[i] += 500e-6 * v[i];
      }
      ASSERT_EQ(q[3], joint.q) << n;
    }
    EXPECT_EQ(batch.state(2).servo.raw, joint.state.servo.raw);
  }
}

TEST(Servo, IsPlacedWithoutAKick) {
  for (const UnitConfig& config : each_kind()) {
    if (config.servo->kind == vsa::control::ServoKind::motor_voltages) continue;  // nothing holds its springs
    OneJoint joint(config, 0.0, 0.0, 5e-3, 1'000'000);
    play(joint, 0, 100);
    Unit::command_direct(joint.state, {});
    joint.load = [](double) { return 0.0; };
    const double preset = config.preset_max > 0 ? 0.3 : 0.0;
    vsa::Problems problems;
    const vsa::device::UnitPlace there{7.0, 0.0, 7.0, preset, 0.0};
    joint.unit.check_place(joint.state, there, "", problems);
    problems.throw_if_any();
    joint.unit.place(joint.state, there);
    joint.q = 7.0, joint.v = 0;
    for (int n = 0; n < 300; ++n) {
      joint.step();
      ASSERT_NEAR(joint.q, 7.0, 2e-3) << vsa::control::name_of(config.servo->kind) << " " << n;
    }
  }
}

TEST(Servo, CannotBePlacedBeyondItsReferences) {
  const Unit unit(series(position_servo(), 50));
  vsa::Problems problems;
  unit.check_place(unit.initial(0, 0, 0), {60.0, 0.0, 60.0, 0.0, 0.0}, "elbow: ", problems);
  ASSERT_EQ(problems.list().size(), 1u);
  EXPECT_NE(problems.list()[0].text().find("control.reference_max_rad"), std::string::npos);
}

TEST(Servo, IsLimpWithoutPowerAndGoesOnWithIt) {
  OneJoint joint(series(position_servo(), 50), 0.0, 0.0, 5e-3, 1'000'000);
  joint.unit.command(joint.state, 1.0, 0.0);
  run(joint, 1.0);
  vsa::device::Faults dead;
  dead.powered = false;
  Unit::set_faults(joint.state, dead);
  joint.load = [](double) { return -1.0; };
  run(joint, 5.0);
  EXPECT_LT(joint.q, -2.0) << "the load turns it back, more than half a turn";
  EXPECT_EQ(joint.state.held.voltage[0], 0.0);
  Unit::set_faults(joint.state, {});
  run(joint, 4.0);
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, 1.0, 1e-3);
}

TEST(Servo, AnUnpluggedMotorHasNoCurrentAndAStuckEncoderBlindsIt) {
  OneJoint joint(series(position_servo(), 50), 0.0, 0.0, 5e-3, 1'000'000);
  vsa::device::Faults faults;
  faults.motor_unplugged[0] = true;
  Unit::set_faults(joint.state, faults);
  joint.unit.command(joint.state, 1.0, 0.0);
  run(joint, 1.0);
  EXPECT_NEAR(joint.state.actuator.motor[0].angle, 0.0, 1e-9);
  faults = {};
  faults.encoder[0].stuck = true;
  Unit::set_faults(joint.state, faults);
  run(joint, 2.0);
  EXPECT_GT(joint.state.actuator.motor[0].angle, 2.0) << "it never sees itself arrive";
}

TEST(Servo, ParametersChangeWhileItGoesOn) {
  const UnitConfig before = series(position_servo(), 50);
  UnitConfig after = before;
  after.servo->position.gain_per_s = 5;
  OneJoint joint(before, 0.0, 0.0, 5e-3, 1'000'000);
  joint.unit.command(joint.state, 1.0, 0.0);
  run(joint, 0.05);
  const auto counted = joint.state.servo.raw;
  Unit next(after);
  next.adopt(joint.state, before);
  EXPECT_EQ(joint.state.servo.raw, counted);
  EXPECT_EQ(joint.state.servo.command.equilibrium, 1.0);
}

TEST(Servo, TellsPositionsInTheUnitsTicks) {
  OneJoint joint(series(position_servo(), 50), 0.5, 0.0, 5e-3, 1'000'000);
  run(joint, 0.1);
  const auto ticks = vsa::device::measured(joint.unit, joint.state);
  EXPECT_NEAR(vsa::radians({ticks[2].value * 2}), 0.5, 1e-3);
  EXPECT_NEAR(vsa::radians({ticks[0].value * 2}), 0.5, 1e-3);
}

TEST(Servo, ParametersThatNoDriveHasAreRefusedByName) {
  const auto refused = [](const UnitConfig& config, const char* text) {
    try {
      const Unit unit(config);
      ADD_FAILURE() << text;
    } catch (const vsa::InputError& error) {
      EXPECT_EQ(error.problems().size(), 1u) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  const UnitConfig good = series(position_servo(), 50);
  UnitConfig c = good;
  c.servo->current_max_A = std::numeric_limits<double>::quiet_NaN();
  refused(c, "control.current_max_A = nan: is out of range");
  c = good, c.servo->position.gain_per_s = 0;
  refused(c, "control.position_gain_per_s");
  c = good, c.actuator.side[0].bridge.dead_band = 0.3;
  refused(c, "drive.dead_band = 0.3: a servo's drive gives the voltages that it is told");
  c = good, c.actuator.side[0].bridge.pin = vsa::drive::PwmPin::enable;
  refused(c, "drive.pwm_pin");
  c = good, c.actuator.side[0].motor.torque_constant_Nm_per_A = 0;
  refused(c, "drive.torque_constant_Nm_per_A");
  c = series(torque_servo(), 50), c.servo->torque.damping_Nms_per_rad = -1;
  refused(c, "control.damping_Nms_per_rad = -1");
}

TEST(Servo, HasNoLineToBeEmulatedOn) {
  try {
    const vsa::device::Emulation emulation({{series(position_servo(), 50), 1}}, {});
    ADD_FAILURE() << "a servo that speaks the qbmove's protocol";
  } catch (const vsa::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("speaks no qbmove protocol"), std::string::npos) << error.what();
  }
}

}  // namespace
