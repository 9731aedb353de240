// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/motor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "vsa/drive/bridge.hpp"

namespace {

using namespace vsa::drive;

MotorParams maker_pro() { return {0.001, 0.01, 0.8, 1.3, 2.3, std::nullopt}; }

/// Reference by brute force: explicit midpoint with tiny steps.
struct Reference {
  double x = 0, w = 0, i = 0, charge = 0, ii = 0, ww = 0, iw = 0;
};

Reference brute(const MotorParams& m, double w0, double i0, double V, double T, double h) {
  Reference r;
  r.w = w0;
  r.i = i0;
  const int n = 200000;
  const double dt = h / n;
  auto current = [&](double w, double i) { return m.inductance_H ? i : (V - m.back_emf_Vs_per_rad * w) / m.resistance_Ohm; };
  auto dw = [&](double w, double i) {
    return (m.torque_constant_Nm_per_A * current(w, i) - m.viscous_Nms_per_rad * w + T) / m.inertia_kgm2;
  };
  auto di = [&](double w, double i) {
    return m.inductance_H ? (V - m.resistance_Ohm * i - m.back_emf_Vs_per_rad * w) / *m.inductance_H : 0.0;
  };
  for (int k = 0; k < n; ++k) {
    const double wm = r.w + 0.5 * dt * dw(r.w, r.i), im = r.i + 0.5 * dt * di(r.w, r.i);
    const double c = current(wm, im);
    r.x += dt * wm;
    r.charge += dt * c;
    r.ii += dt * c * c;
    r.ww += dt * wm * wm;
    r.iw += dt * c * wm;
    const double nw = r.w + dt * dw(wm, im), ni = r.i + dt * di(wm, im);
    r.w = nw;
    r.i = ni;
  }
  if (!m.inductance_H) r.i = current(r.w, 0);
  return r;
}

void expect_exact(const MotorParams& m, double h) {
  const MotorStepper stepper(m, Terminal::driven, h);
  const MotorState s{0, 1.7, m.inductance_H ? 0.4 : 0.0};
  const MotorStep step = stepper.step(s, 5.0, -0.6);
  const Reference r = brute(m, s.speed, s.current, 5.0, -0.6, h);
  EXPECT_NEAR(step.displacement, r.x, 1e-9 * (1 + std::abs(r.x)));
  EXPECT_NEAR(step.speed, r.w, 1e-8 * (1 + std::abs(r.w)));
  EXPECT_NEAR(step.current, r.i, 1e-8);
  EXPECT_NEAR(step.charge, r.charge, 1e-9);
  EXPECT_NEAR(step.int_II, r.ii, 1e-9);
  EXPECT_NEAR(step.int_ww, r.ww, 1e-8);
  EXPECT_NEAR(step.int_Iw, r.iw, 1e-8);
}

TEST(Motor, TheStepIsExactWithoutInductance) {
  expect_exact(maker_pro(), 1e-3);
  expect_exact(maker_pro(), 16e-3);
}

TEST(Motor, TheStepIsExactWithInductance) {
  MotorParams m = maker_pro();
  m.inductance_H = 2e-3;  // L/R of the same size as the mechanical time constant
  expect_exact(m, 1e-3);
  m.inductance_H = 4.0;  // Table I's, implausible but allowed
  expect_exact(m, 1e-3);
}

TEST(Motor, TinyInductanceTendsToNone) {
  MotorParams m = maker_pro();
  m.inductance_H = 1e-7;
  const MotorStepper with(m, Terminal::driven, 1e-3), without(maker_pro(), Terminal::driven, 1e-3);
  const auto a = with.step({0, 2.0, (5.0 - 1.3 * 2.0) / 2.3}, 5.0, 0.1), b = without.step({0, 2.0, 0}, 5.0, 0.1);
  EXPECT_NEAR(a.speed, b.speed, 1e-3);
  EXPECT_NEAR(a.int_II, b.int_II, 1e-6);
}

TEST(Motor, ReachesTheClosedFormSteadyState) {
  // ω = (K_τ V/R + T)/(b + K_τ K_b/R)
  const MotorParams m = maker_pro();
  const MotorStepper stepper(m, Terminal::driven, 1e-3);
  MotorState s;
  for (int n = 0; n < 200; ++n) s.speed = stepper.step(s, 7.3, -0.8).speed;
  EXPECT_NEAR(s.speed, (0.8 * 7.3 / 2.3 - 0.8) / (0.01 + 0.8 * 1.3 / 2.3), 1e-12);
}

TEST(Motor, RisesWithItsTimeConstant) {
  // J/(b + K_τ K_b/R) = 2.16 ms: 1 − 1/e of the final speed after it
  const MotorParams m = maker_pro();
  const double tau = 0.001 / (0.01 + 0.8 * 1.3 / 2.3);
  const MotorStepper stepper(m, Terminal::driven, tau);
  const double final_speed = (0.8 * 7.3 / 2.3) / (0.01 + 0.8 * 1.3 / 2.3);
  EXPECT_NEAR(stepper.step({}, 7.3, 0).speed / final_speed, 1 - std::exp(-1.0), 1e-12);
}

TEST(Motor, EnergyBalancesExactlyOverAStep) {
  MotorParams m = maker_pro();
  m.inductance_H = 2e-3;
  const MotorStepper stepper(m, Terminal::driven, 1e-3);
  MotorState s{0, 3.0, 0.7};
  const double V = -6, T = 0.4;
  const MotorStep r = stepper.step(s, V, T);
  const double magnetic = 0.5 * 2e-3 * (r.current * r.current - 0.49);
  EXPECT_NEAR(V * r.charge, 2.3 * r.int_II + magnetic + 1.3 * r.int_Iw, 1e-13);
  EXPECT_NEAR(0.8 * r.int_Iw + T * r.displacement, 0.01 * r.int_ww + 0.5e-3 * (r.speed * r.speed - 9.0), 1e-13);
}

TEST(Motor, OpenTerminalsCarryNoCurrent) {
  const MotorStepper stepper(maker_pro(), Terminal::open, 1e-3);
  const MotorStep r = stepper.step({0, 2.0, 0}, 0.0, 0.0);
  EXPECT_EQ(r.current, 0.0);
  EXPECT_EQ(r.int_II, 0.0);
  EXPECT_NEAR(r.speed, 2.0 * std::exp(-0.01 / 0.001 * 1e-3), 1e-12);
}

TEST(Gearbox, AnyRatioIsThePulleySideMotor) {
  // A motor behind n = 100 equals its own parameters carried to the pulley: eq. (4)–(5).
  const MotorParams motor{1e-7, 1e-6, 8e-3, 13e-3, 2.3, std::nullopt};
  const MotorParams p = at_pulley(motor, 100);
  EXPECT_DOUBLE_EQ(p.inertia_kgm2, 1e-3);
  EXPECT_DOUBLE_EQ(p.viscous_Nms_per_rad, 1e-2);
  EXPECT_DOUBLE_EQ(p.torque_constant_Nm_per_A, 0.8);
  EXPECT_DOUBLE_EQ(p.back_emf_Vs_per_rad, 1.3);
  EXPECT_DOUBLE_EQ(at_pulley(FrictionParams{8e-3, 0.03}, 100).coulomb_Nm, 0.8);
}

TEST(Bridge, HasNoDeadBandUnlessAsked) { EXPECT_EQ(bridge_duty(BridgeParams{}, 0.1, 1.0), 0.1); }

TEST(Bridge, HasADeadBandASaturationAndTheRightSign) {
  const BridgeParams p{.dead_band = 0.3};
  EXPECT_EQ(bridge_voltage(p, 12.0, 0.3, 0.6), 0.0);
  EXPECT_EQ(bridge_voltage(p, 12.0, -0.2, 0.6), 0.0);
  EXPECT_DOUBLE_EQ(bridge_voltage(p, 12.0, 1.0, 0.6), 7.2);
  EXPECT_DOUBLE_EQ(bridge_voltage(p, 12.0, 5.0, 0.6), 7.2);
  EXPECT_NEAR(bridge_voltage(p, 12.0, 0.65, 0.6), 3.6, 1e-12);
  EXPECT_NEAR(bridge_voltage(p, 12.0, -0.65, 0.6), -3.6, 1e-12) << "the authors' program reverses this sign";
}

}  // namespace
