// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Actuators whose bridge has a modulated enable pin.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "vsa/actuator/actuator.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace {

using namespace vsa;
using actuator::Actuator;
using actuator::ActuatorParams;
using drive::Terminal;

constexpr double kV = 12;

ActuatorParams chopped() {
  ActuatorParams p;
  p.transmission = std::make_shared<elastic::TwoSinh>(elastic::TwoSinhParams{{8e-4, 8e-4}, {12.3, 12.3}, {0.27, 0.27}});
  p.set_both({.motor = {0.001, 0.01, 0.8, 0.8, 2.3, 2e-4},
              .gearbox = {1.0, {0.3, 0.03}, 0.2},
              .bridge = {.pin = drive::PwmPin::enable, .period_s = 50.5e-6, .switch_Ohm = 0.2, .diode_V = 0.7}});
  p.shaft_friction = {0.01, 0.03};
  p.tendon = {0.144, 2.6e-4};
  return p;
}

actuator::SegmentInput input(double dq, double duty_1, double duty_2, double supply = kV) {
  actuator::SegmentInput in;
  in.dq = dq;
  in.voltage = {duty_1 * supply, duty_2 * supply};
  in.supply_V = supply;
  return in;
}

/// A motor alone: springs that hardly pull.
ActuatorParams loose() {
  ActuatorParams p = chopped();
  p.transmission = std::make_shared<elastic::TwoSinh>(elastic::TwoSinhParams{{1e-9, 1e-9}, {1e-3, 1e-3}});
  for (auto& side : p.side) side.gearbox = {1.0, {0, 0}};
  p.tendon = {};
  return p;
}

TEST(Pwm, EveryLossIsPositiveAndTheBalanceClosesWhateverHappens) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    ActuatorParams p = chopped();
    if (trial % 3 == 1)
      for (auto& side : p.side) side.gearbox.friction = {};
    if (trial % 4 == 1)
      for (auto& side : p.side) side.bridge.period_s = 0;
    if (trial % 5 == 1)
      for (auto& side : p.side) side.gearbox.ratio = 3.0;
    Actuator a(p);
    auto s = a.initial({0.7 * unit(rng), 0.7 * unit(rng)}, 0.3 * unit(rng));
    auto last = s.ledger;
    for (int n = 0; n < 50; ++n) {
      const double h = std::pow(10.0, -4 + unit(rng));
      const auto in = input(0.02 * unit(rng), unit(rng), unit(rng), trial % 7 == 0 ? 0.0 : kV);
      s.ledger.delivered += a.segment(s, h, in).torque * in.dq;
      const auto& l = s.ledger;
      ASSERT_GE(l.copper, last.copper);
      ASSERT_GE(l.bridge, last.bridge);
      ASSERT_GE(l.viscous, last.viscous);
      ASSERT_GE(l.motor_friction, last.motor_friction - 1e-15);
      ASSERT_NEAR(l.conversion, 0.0, 1e-12 * (1 + l.moved()));
      ASSERT_NEAR(l.imbalance(), 0.0, 1e-10 * (1 + l.moved())) << trial << ' ' << n;
      last = l;
    }
    EXPECT_LT(std::abs(last.integrator), 1e-6) << "J, trial " << trial;
  }
}

TEST(Pwm, TheSupplyGivesWhatTheCircuitTakesAtTheSpeedsThatWere) {
  Actuator a(loose());
  auto s = a.initial({0, 0}, 0);
  double circuit = 0;
  const double h = 1e-3;
  for (int n = 0; n < 300; ++n) {
    const double duty = n < 150 ? 0.7 : 0.2, before = s.motor[0].angle;
    a.segment(s, h, input(0, duty, 0));
    const drive::PwmCycle cycle(loose().side[0].bridge, kV, 2.3, 2e-4, duty);
    circuit += h * cycle.power(0.8 * (s.motor[0].angle - before) / h).supply;
  }
  EXPECT_GT(circuit, 0.2);
  EXPECT_NEAR(s.ledger.supply, circuit, 2e-3 * circuit);
}

TEST(Pwm, AMotorOnAConstantDutyRunsUpToWhereTheCircuitFeedsItsFriction) {
  const ActuatorParams p = loose();
  for (const double duty : {0.2, 0.45, 0.61, 0.9, -0.61}) {
    Actuator a(p);
    auto s = a.initial({0, 0}, 0);
    for (int n = 0; n < 20000; ++n) a.segment(s, 1e-3, input(0, duty, 0));
    const double speed = s.motor[0].speed;
    const drive::PwmCycle cycle(p.side[0].bridge, kV, 2.3, 2e-4, duty);
    EXPECT_NEAR(0.8 * cycle.mean(0.8 * speed).current, 0.01 * speed, 1e-6) << duty;
    EXPECT_GT(speed * duty, 0.0);
    EXPECT_NEAR(a.motor_current(s, 0, duty * kV, Terminal::driven, kV), cycle.mean(0.8 * speed).current, 1e-12);
  }
}

TEST(Pwm, AStepOfAnyLengthLandsNearTheConvergedMotion) {
  const auto run = [](double h) {
    Actuator a(loose());
    auto s = a.initial({0, 0}, 0);
    const int half = static_cast<int>(std::lround(0.03 / h));
    for (int n = 0; n < 2 * half; ++n) a.segment(s, h, input(0, n < half ? 0.8 : -0.3, 0));
    return s.motor[0];
  };
  const drive::MotorState fine = run(1e-5), at_1ms = run(1e-3), at_half = run(5e-4);
  EXPECT_NEAR(at_1ms.angle, fine.angle, 2e-3 * std::abs(fine.angle));
  EXPECT_NEAR(at_1ms.speed, fine.speed, 0.02);
  EXPECT_LT(std::abs(at_half.angle - fine.angle), 0.6 * std::abs(at_1ms.angle - fine.angle) + 1e-9);
}

TEST(Pwm, AMotorThatSlowsDownIntoTheDrivenBranchIsDrivenWithinTheSameStep) {
  ActuatorParams p = loose();
  for (auto& side : p.side) side.bridge.period_s = 0;
  for (auto& side : p.side) side.motor.viscous_Nms_per_rad = 0.1;
  const auto run = [&](double h) {
    Actuator a(p);
    auto s = a.initial({0, 0}, 0);
    s.motor[0].speed = 12;  // 9.6 V: above the 6.8 V from which 0.8 of the duty drives
    for (int n = 0; n < std::lround(0.01 / h); ++n) a.segment(s, h, input(0, 0.8, 0));
    return s.motor[0];
  };
  const auto coarse = run(0.01), fine = run(1e-5);
  EXPECT_GT(fine.speed, 5.5) << "it would be 4.4 without current";
  EXPECT_NEAR(coarse.speed, fine.speed, 1.0);
}

TEST(Pwm, AtFullDutyItIsTheMotorOnTheSupplysVoltage) {
  ActuatorParams p = loose();
  Actuator chopped(p);
  for (auto& side : p.side) side.bridge.pin = drive::PwmPin::input;
  for (auto& side : p.side) side.motor.inductance_H.reset();
  Actuator plain(p);
  auto a = chopped.initial({0, 0}, 0), b = plain.initial({0, 0}, 0);
  for (int n = 0; n < 50; ++n) {
    chopped.segment(a, 2e-3, input(0, 1, -1));
    plain.segment(b, 2e-3, {0, {kV, -kV}});
  }
  EXPECT_NEAR(a.motor[0].speed, b.motor[0].speed, 1e-9);
  EXPECT_NEAR(a.motor[0].angle, b.motor[0].angle, 1e-9);
  EXPECT_NEAR(a.ledger.supply, b.ledger.supply, 1e-8);
  EXPECT_NEAR(a.ledger.copper + a.ledger.bridge, b.ledger.copper + b.ledger.bridge, 1e-8);
}

TEST(Pwm, AtDutyZeroTheMotorCoastsAndWithTheSupplyGoneToo) {
  for (const double supply : {kV, 0.0}) {
    ActuatorParams p = loose();
    for (auto& side : p.side) side.motor.viscous_Nms_per_rad = 0;
    Actuator a(p);
    auto s = a.initial({0, 0}, 0);
    s.motor[0].speed = 5;  // 4 V
    for (int n = 0; n < 100; ++n) a.segment(s, 1e-3, input(0, supply > 0 ? 0.0 : 0.5, 0, supply));
    EXPECT_NEAR(s.motor[0].speed, 5.0, 1e-6);
    EXPECT_EQ(s.ledger.copper, 0.0);
  }
}

TEST(Pwm, AMotorFasterThanTheSupplyFeedsItBack) {
  ActuatorParams p = loose();
  for (auto& side : p.side) side.motor.viscous_Nms_per_rad = 0;
  Actuator a(p);
  auto s = a.initial({0, 0}, 0);
  s.motor[0].speed = 30;  // 24 V
  for (int n = 0; n < 50; ++n) a.segment(s, 1e-3, input(0, 0, 0));
  EXPECT_LT(s.motor[0].speed, 17.3) << "down to 12 V and two diodes";
  EXPECT_GT(s.motor[0].speed, 16.0);
  EXPECT_LT(s.ledger.supply, -0.1);
  EXPECT_GT(s.ledger.bridge, 0.01);
}

TEST(Pwm, AnUnloadedUnitComesToRestAtAnyDutyBelowItsFriction) {
  Actuator a(chopped());
  auto s = a.initial({0.5, -0.5}, 0.0);
  for (int n = 0; n < 2000; ++n) a.segment(s, 1e-3, input(0, 0.15, -0.15));
  const double angle = s.motor[0].angle;
  for (int n = 0; n < 500; ++n) a.segment(s, 1e-3, input(0, 0.15, -0.15));
  EXPECT_NEAR(s.motor[0].angle, angle, 1e-6);
  EXPECT_LT(std::abs(s.motor[0].speed), 1e-4);
}

TEST(Pwm, SwitchesInTheWayOfModulatedInputsAreInTheBridgesEntry) {
  ActuatorParams p = chopped();
  for (auto& side : p.side) side.bridge.pin = drive::PwmPin::input;
  for (auto& side : p.side) side.motor.inductance_H.reset();
  Actuator with(p);
  for (auto& side : p.side) side.bridge.switch_Ohm = 0;
  for (auto& side : p.side) side.motor.resistance_Ohm = 2.5;
  Actuator without(p);
  auto a = with.initial({0, 0}, 0), b = without.initial({0, 0}, 0);
  for (int n = 0; n < 100; ++n) {
    with.segment(a, 1e-3, {0.001, {5, -3}});
    without.segment(b, 1e-3, {0.001, {5, -3}});
  }
  EXPECT_EQ(a.motor[0].speed, b.motor[0].speed);
  EXPECT_NEAR(a.ledger.copper + a.ledger.bridge, b.ledger.copper, 1e-12);
  EXPECT_NEAR(a.ledger.bridge, b.ledger.copper * 0.2 / 2.5, 1e-12);
}

}  // namespace
