// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "vsa/actuator/actuator.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace {

using vsa::actuator::Actuator;
using vsa::actuator::ActuatorParams;
using vsa::actuator::SegmentInput;
using vsa::drive::Terminal;

ActuatorParams maker_pro() {
  ActuatorParams p;
  p.transmission = std::make_shared<vsa::elastic::TwoSinh>(vsa::elastic::TwoSinhParams{{0.022, 0.022}, {6.85, 6.85}});
  p.set_both({.motor = {0.001, 0.01, 0.8, 1.3, 2.3, std::nullopt}, .gearbox = {1.0, {0.8, 0.03}}});
  p.shaft_friction = {0.01, 0.03};
  return p;
}

/// With every loss: linear parts, tendon friction, gear loss.
ActuatorParams lossy() {
  ActuatorParams p = maker_pro();
  p.transmission = std::make_shared<vsa::elastic::TwoSinh>(vsa::elastic::TwoSinhParams{{8e-4, 8e-4}, {12.3, 12.3}, {0.27, 0.27}});
  for (auto& side : p.side) side.gearbox.load_loss = 0.2;
  p.tendon = {0.144, 2.6e-4};
  return p;
}

TEST(Segment, WhatTheTransmissionDoesToTheShaftItDoesToThePulleysTheOtherWay) {
  ActuatorParams p = lossy();
  p.shaft_friction = {0, 0};
  Actuator a(p);
  auto s = a.initial({0.3, -0.3}, 0.0);
  for (int n = 0; n < 40; ++n) a.segment(s, 1e-3, {n < 30 ? 0.004 : -0.002, {0, 0}, {Terminal::driven, Terminal::driven}});
  const auto springs = a.spring(s, s.shaft), all = a.response(s, s.shaft);
  EXPECT_GT(std::abs(all.torque - springs.torque), 0.01) << "the tendons rub";
  EXPECT_NEAR(all.torque + all.load[0] + all.load[1], 0.0, 1e-12);
}

/// Parameters may change between steps, a winding's inductance with them.
TEST(Segment, ACurrentThatNoInductanceHoldsIsGone) {
  for (const double share : {1.0, 1.1}) {
    for (const double friction : {0.8, 0.0}) {
      ActuatorParams p = lossy();
      for (auto& side : p.side) side.gearbox.friction.coulomb_Nm = friction;
      p.side[1].motor.inertia_kgm2 *= share;
      Actuator a(p);
      auto s = a.initial({0.2, -0.2}, 0.0);
      s.motor[0].current = 1;
      s.motor[1].current = -2;
      a.segment(s, 1e-3, {0.0, {3, 3}, {Terminal::driven, Terminal::driven}});
      for (const auto& motor : s.motor) EXPECT_EQ(motor.current, 0) << share << ' ' << friction;
      EXPECT_EQ(s.ledger.magnetic, 0);
    }
  }
}

TEST(Segment, AShaftThatWasPutElsewhereHasItsTendonsBentNoFurtherThanTheyGo) {
  const ActuatorParams p = lossy();
  Actuator a(p);
  const double most = 2 * 0.5 * p.tendon.friction * p.tendon.presliding_J;  // two springs' bristles at their limit
  auto s = a.initial({0.2, -0.2}, 0.0);
  for (const double shaft : {0.3, -0.3, 0.31}) {
    a.relocate(s, shaft);
    EXPECT_NEAR(s.ledger.tendon_bristle, most, 1e-9 * most) << shaft;
    EXPECT_LT(std::abs(s.ledger.imbalance()), 1e-12);
    // And so in the next step: the tendons rub at their limit, they don't pull as far as the shaft went.
    auto next = s;
    a.segment(next, 1e-4, {0.0, {0, 0}, {Terminal::open, Terminal::open}});
    EXPECT_LE(next.ledger.tendon_bristle, most * (1 + 1e-9));
    EXPECT_NEAR(next.ledger.tendon_friction, 0.0, 1e-3 * p.tendon.friction * next.ledger.elastic) << shaft;
  }
}

TEST(Segment, EveryLossIsPositiveAndTheBalanceClosesWhateverHappens) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    ActuatorParams p = trial % 2 == 0 ? maker_pro() : lossy();
    if (trial % 7 == 1) p.tendon.presliding_J = 1e-6;
    if (trial % 11 == 1)
      for (auto& side : p.side) side.gearbox.friction.coulomb_Nm = 0;
    if (trial % 3 == 1)
      for (auto& side : p.side) side.motor.inductance_H = 1e-3;
    if (trial % 4 == 1)
      for (auto& side : p.side) side.gearbox.friction.presliding_rad = 0;
    if (trial % 5 == 1)
      for (auto& side : p.side) side.gearbox.ratio = 3.0;
    if (trial % 6 == 1)
      for (auto& side : p.side) side.gearbox.back_loss = 0.5 * (trial % 12 == 1);
    for (auto& side : p.side) side.motor.back_emf_Vs_per_rad = 0.8;  // K_b = K_τ: no conversion entry
    Actuator a(p);
    auto s = a.initial({0.7 * unit(rng), 0.7 * unit(rng)}, 0.3 * unit(rng));
    auto last = s.ledger;
    for (int n = 0; n < 50; ++n) {
      const double h = std::pow(10.0, -4 + unit(rng));
      a.segment(s, h,
                {1e-2 * unit(rng),
                 {8 * unit(rng), 8 * unit(rng)},
                 {n % 7 == 0 ? Terminal::open : Terminal::driven, n % 11 == 0 ? Terminal::open : Terminal::driven}});
      a.shaft_friction(s, 0.0);
      const auto& l = s.ledger;
      ASSERT_GE(l.copper, last.copper - 1e-12);
      ASSERT_GE(l.viscous, last.viscous - 1e-12);
      ASSERT_GE(l.motor_friction, last.motor_friction - 1e-12);
      ASSERT_GE(l.shaft_friction, last.shaft_friction - 1e-12);
      ASSERT_GE(l.tendon_friction, last.tendon_friction - 1e-10);  // w − z rounds to 1e-16 of w, much for a bristle of 1e-6 J
      ASSERT_GE(l.tendon_bristle, 0.0);
      ASSERT_NEAR(l.conversion, 0.0, 1e-12);
      last = l;
    }
  }
}

/// Moves the shaft of a unit with locked pulleys; the torque at its end.
double push(Actuator& a, vsa::actuator::ActuatorState& s, double to, int steps) {
  const double step = (to - s.shaft) / steps;
  double torque = 0;
  for (int n = 0; n < steps; ++n) torque = a.segment(s, 1e-3, {step, {0, 0}, {Terminal::driven, Terminal::driven}}).torque;
  return torque;
}

TEST(Segment, TendonFrictionTakesItsShareOfTheTensionBothWays) {
  ActuatorParams p = lossy();
  for (auto& side : p.side) side.gearbox = {1.0, {100.0, 0.0}};  // nothing moves the motors
  Actuator a(p);
  auto s = a.initial({0, 0}, 0.0);
  push(a, s, 0.5, 5000);
  const double loading = push(a, s, 0.5 + 1e-7, 1);
  const double elastic = a.spring(s, s.shaft).torque;
  EXPECT_NEAR(loading, elastic * (1 + 0.144), 1e-4 * std::abs(elastic));
  push(a, s, 0.55, 500);
  push(a, s, 0.5, 500);
  const double unloading = push(a, s, 0.5 - 1e-7, 1);
  EXPECT_NEAR(unloading, elastic * (1 - 0.144), 1e-4 * std::abs(elastic));
}

TEST(Segment, AClosedLoopOfTheShaftCostsTheTendonsTwiceTheirShareOfTheEnergy) {
  // Both springs from 0 to H and back: heat 2μΣH, less the presliding at the turn, which w_max → 0 removes.
  ActuatorParams p = lossy();
  for (auto& side : p.side) side.gearbox = {1.0, {100.0, 0.0}};
  p.tendon.presliding_J = 1e-6;
  Actuator a(p);
  auto s = a.initial({0, 0}, 0.0);
  push(a, s, 0.5, 5000);
  const double stored = s.ledger.elastic;
  push(a, s, 0.0, 5000);
  EXPECT_NEAR(s.ledger.tendon_friction, 2 * 0.144 * stored, 1e-3 * stored);
  EXPECT_LT(std::abs(s.ledger.integrator), 1e-9);
}

TEST(Segment, SmallSwingsInsideThePreslidingOfTheTendonsLoseNothing) {
  ActuatorParams p = lossy();
  for (auto& side : p.side) side.gearbox = {1.0, {100.0, 0.0}};
  Actuator a(p);
  auto s = a.initial({0.5, -0.5}, 0.0);
  for (int n = 0; n < 20; ++n) {
    push(a, s, 1e-4, 20);
    push(a, s, -1e-4, 20);
  }
  EXPECT_EQ(s.ledger.tendon_friction, 0.0);
  EXPECT_GT(s.ledger.tendon_bristle, 0.0);
}

TEST(Segment, AGearLossHoldsMoreTheMoreItCarries) {
  // Back-driven, a pulley slides until load = τ_c + λ·load: 0.4/(1 − 0.2) = 0.5 N·m, less the bristle's bend.
  ActuatorParams p = maker_pro();
  for (auto& side : p.side) side.gearbox = {1.0, {0.4, 1e-3}, 0.2};
  Actuator a(p);
  for (const double load : {0.48, 0.9}) {
    const double deflection = std::asinh(load / 0.022) / 6.85;
    auto s = a.initial({-deflection, 0}, 0.0);
    for (int n = 0; n < 3000; ++n) a.segment(s, 1e-3, {0, {0, 0}, {Terminal::driven, Terminal::driven}});
    const double carried = a.spring(s, 0.0).load[0];
    EXPECT_LE(carried, 0.4 / 0.8 + 1e-6) << load;
    EXPECT_GT(carried, 0.46) << "it slides no further than its limit asks";
  }
}

TEST(Segment, AGearThatLosesLessBackwardsHoldsLessThanItsMotorNeedsToDrive) {
  // One motor against a spring at rest: it starts to give way below M (1 − λ_b) = load, to drive above M = load (1 + λ_f).
  const auto moved = [](double back, double torque) {
    ActuatorParams p = maker_pro();
    p.transmission = std::make_shared<vsa::elastic::TwoSinh>(vsa::elastic::TwoSinhParams{{1e-4, 1e-4}, {1, 1}, {1.0, 1.0}});
    for (auto& side : p.side) side.gearbox = {1.0, {0, 0.0}, 0.3, back};
    Actuator a(p);
    auto s = a.initial({1.0, 1.0}, 0.0);  // the shaft at 0 pulls either pulley back with 1 N·m
    const double volts = torque * 2.3 / 0.8;
    for (int n = 0; n < 300; ++n) a.segment(s, 1e-3, {0.0, {volts, volts}, {Terminal::driven, Terminal::driven}});
    return s.motor[0].angle - 1.0;
  };
  const double load = 1.0;
  EXPECT_LT(moved(0.1, 0.85 * load), -0.01);
  EXPECT_NEAR(moved(0.1, 0.92 * load), 0.0, 2e-3);
  EXPECT_NEAR(moved(0.3, 0.85 * load), 0.0, 2e-3) << "a symmetric one holds";
  EXPECT_NEAR(moved(0.1, 1.25 * load), 0.0, 2e-3);
  EXPECT_GT(moved(0.1, 1.4 * load), 0.01);
}

TEST(Segment, LockedPulleysDeflectAsTheClosedFormSays) {
  ActuatorParams p = maker_pro();
  for (auto& side : p.side) side.gearbox.friction = {100.0, 0.0};  // nothing moves the motors
  Actuator a(p);
  auto s = a.initial({0.4, -0.4}, 0.0);
  for (int n = 0; n < 300; ++n) a.segment(s, 1e-3, {1e-3, {0, 0}, {Terminal::driven, Terminal::driven}});
  EXPECT_DOUBLE_EQ(s.motor[0].angle, 0.4);
  EXPECT_NEAR(a.spring(s, s.shaft).torque, -2 * 0.022 * std::cosh(6.85 * 0.4) * std::sinh(6.85 * 0.3), 1e-10);
}

TEST(Segment, ALoadedMotorSettlesWhereFrictionHoldsIt) {
  // Unpowered and open: the pulley creeps until spring load and friction agree.
  ActuatorParams p = maker_pro();
  Actuator a(p);
  auto s = a.initial({0.0, 0.0}, 0.75);
  for (int n = 0; n < 4000; ++n) a.segment(s, 1e-3, {0, {0, 0}, {Terminal::driven, Terminal::driven}});
  EXPECT_NEAR(s.motor[0].speed, 0.0, 1e-6);
  EXPECT_LE(std::abs(a.spring(s, s.shaft).load[0]), 0.8 + 1e-9);
  EXPECT_GT(s.motor[0].angle, 0.03);
}

TEST(Segment, TorqueSlopeIsTheDerivativeOfTheMeanTorque) {
  for (const double coulomb : {0.0, 0.8}) {
    for (const bool losses : {false, true}) {
      ActuatorParams p = losses ? lossy() : maker_pro();
      for (auto& side : p.side) side.gearbox.friction.coulomb_Nm = coulomb;
      Actuator a(p);
      const auto start = a.initial({0.5, -0.5}, 0.1);
      auto torque = [&](double dq) {
        auto s = start;
        return a.segment(s, 1e-3, {dq, {5, 1}, {Terminal::driven, Terminal::driven}}).torque;
      };
      auto s = start;
      const double slope = a.segment(s, 1e-3, {0.01, {5, 1}, {Terminal::driven, Terminal::driven}}).slope;
      EXPECT_NEAR(slope, -(torque(0.01 + 1e-4) - torque(0.01 - 1e-4)) / 2e-4, 2e-2 * slope);
    }
  }
}

TEST(Segment, SolvesSpringsThatHardenExponentially) {
  ActuatorParams p = maker_pro();
  Actuator a(p);
  for (const double jump : {-1.5, -0.8, 0.8, 1.5}) {
    auto s = a.initial({0.785, -0.785}, 0.0);
    const double stored = s.ledger.stored();
    const auto r = a.segment(s, 4e-3, {jump, {0, 0}, {Terminal::driven, Terminal::driven}});
    ASSERT_TRUE(std::isfinite(r.torque)) << jump;
    EXPECT_GE(r.slope, 0.0);
    const double work = -r.torque * jump;  // put in by whoever moved the shaft
    EXPECT_NEAR(s.ledger.copper + s.ledger.conversion + s.ledger.viscous + s.ledger.motor_friction + s.ledger.stored() - stored +
                    s.ledger.integrator - s.ledger.supply,
                work, 1e-9 * (1 + std::abs(work)))
        << jump;
    EXPECT_LT(std::abs(s.ledger.integrator), 1e-3 * (1 + std::abs(work))) << jump;
  }
}

}  // namespace
