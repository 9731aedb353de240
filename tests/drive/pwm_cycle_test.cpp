// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/pwm_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace vsa::drive;

constexpr double kR = 2.3, kL = 2e-4, kT = 50.5e-6, kV = 12.0;

BridgeParams bridge(PwmPin pin, double period = kT, double switches = 0, double diode = 0) {
  BridgeParams p;
  p.pin = pin;
  p.period_s = period;
  p.switch_Ohm = switches;
  p.diode_V = diode;
  return p;
}

/// The switched circuit followed through its periods until they repeat: exact exponentials between events, Simpson for the
/// integrals.
struct Circuit {
  BridgeParams b;
  double V, R, L;
  struct Sums {
    double charge = 0, on = 0, off = 0, jj_on = 0, jj_off = 0;
  };

  /// L di/dt = u − r i for t, or until i is 0.
  static double run(double& i, double u, double r, double L, double t, bool to_zero, double& q, double& qq) {
    const double end = u / r, tau = L / r;
    double span = t;
    if (to_zero && i != 0) {
      const double share = end / (end - i);  // e^(−t/τ) at the zero
      if (share > 0 && share < 1) span = std::min(t, -tau * std::log(share));
    }
    const auto at = [&](double s) { return end + (i - end) * std::exp(-s / tau); };
    const int n = 2 * std::max(4, static_cast<int>(std::ceil(40 * span / tau)));
    for (int k = 0; k < n; ++k) {
      const double h = span / n, a = at(k * h), m = at((k + 0.5) * h), z = at((k + 1) * h);
      q += h / 6 * (a + 4 * m + z);
      qq += h / 6 * (a * a + 4 * m * m + z * z);
    }
    i = to_zero && span < t ? 0.0 : at(span);
    return span;
  }

  void off(double& i, double e, double t, Sums& s) const {
    if (b.pin == PwmPin::input) {
      run(i, -e, R + b.switch_Ohm, L, t, false, s.off, s.jj_off);
      return;
    }
    const double wall = V + 2 * b.diode_V;
    double left = t;
    if (i != 0) left -= run(i, i > 0 ? -wall - e : wall - e, R, L, t, true, s.off, s.jj_off);
    if (left > 0 && i == 0 && std::abs(e) > wall) run(i, e > 0 ? wall - e : -wall - e, R, L, left, false, s.off, s.jj_off);
  }

  /// Mean current and the mean powers.
  std::pair<double, PwmPower> settle(double d, double e, double T) const {
    const double sense = d < 0 ? -1 : 1, size = std::abs(d);
    e *= sense;
    double i = 0;
    Sums s;
    for (int n = 0; n < 4000; ++n) {
      s = {};
      const double before = i;
      if (size > 0) run(i, V - e, R + b.switch_Ohm, L, size * T, false, s.on, s.jj_on);
      if (size < 1) off(i, e, (1 - size) * T, s);
      if (n > 2 && std::abs(i - before) <= 1e-14 * (1 + std::abs(i))) break;
    }
    const double charge = sense * (s.on + s.off);
    // The off current runs back into the supply through two diodes, whichever way it flows.
    if (b.pin == PwmPin::input)
      return {charge / T, {V * s.on / T, R * (s.jj_on + s.jj_off) / T, b.switch_Ohm * (s.jj_on + s.jj_off) / T}};
    return {charge / T,
            {V * (s.on - std::abs(s.off)) / T, R * (s.jj_on + s.jj_off) / T,
             (b.switch_Ohm * s.jj_on + 2 * b.diode_V * std::abs(s.off)) / T}};
  }
};

TEST(PwmCycle, IsTheSteadyStateOfTheSwitchedCircuitInEveryBranch) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int open = 0, closed = 0, fed_back = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double T = 50e-6, R = 0.5 + 9.5 * unit(rng), L = R * T * std::pow(10.0, -1.5 + 3.0 * unit(rng));
    const double duty = trial % 17 == 0 ? std::round(2 * unit(rng) - 1) : 2 * unit(rng) - 1, emf = 40 * unit(rng) - 20;
    const BridgeParams b = bridge(trial % 4 == 0 ? PwmPin::input : PwmPin::enable, T, trial % 2 ? 0.3 * unit(rng) : 0.0,
                                  trial % 3 ? 0.9 * unit(rng) : 0.0);
    const auto [current, power] = Circuit{b, kV, R, L}.settle(duty, emf, T);
    const PwmCycle cycle(b, kV, R, L, duty);
    const PwmMean mean = cycle.mean(emf);
    const PwmPower got = cycle.power(emf);
    const double scale = 40 / R, W = 40 * scale;
    ASSERT_NEAR(mean.current, current, 2e-7 * scale) << "duty " << duty << " emf " << emf << " L " << L << " R " << R;
    ASSERT_NEAR(got.supply, power.supply, 1e-6 * W) << duty << ' ' << emf;
    ASSERT_NEAR(got.winding, power.winding, 1e-6 * W) << duty << ' ' << emf;
    ASSERT_NEAR(got.bridge, power.bridge, 1e-6 * W) << duty << ' ' << emf;
    (mean.conductance * (R + b.switch_Ohm) < 0.999 ? open : closed)++;
    fed_back += got.supply < 0;
  }
  EXPECT_GT(open, 500);
  EXPECT_GT(closed, 500);
  EXPECT_GT(fed_back, 300);
}

TEST(PwmCycle, NoneGivesMoreThanItTakesAndMoreBackEmfNeverBringsMoreCurrent) {
  for (const PwmPin pin : {PwmPin::input, PwmPin::enable})
    for (const double T : {0.0, 5e-6, kT, 1e-3})
      for (const double diode : {0.0, 0.7})
        for (int percent = -101; percent <= 101; ++percent) {
          const PwmCycle cycle(bridge(pin, T, 0.24, diode), kV, kR, kL, percent / 101.0);
          double last = INFINITY;
          for (double e = -20; e <= 20; e += 0.25) {
            const PwmMean m = cycle.mean(e);
            const PwmPower p = cycle.power(e);
            ASSERT_LE(m.current, last + 1e-12) << percent << ' ' << e;
            ASSERT_GE(m.conductance, 0.0);
            ASSERT_GE(p.winding, -1e-12);
            ASSERT_GE(p.bridge, -1e-12);
            ASSERT_NEAR(p.supply, e * m.current + p.winding + p.bridge, 1e-9) << percent << ' ' << e << ' ' << T;
            last = m.current;
          }
        }
}

TEST(PwmCycle, ItsConductanceIsTheSlopeOfItsCurrent) {
  std::mt19937 rng(8);
  std::uniform_real_distribution<double> unit(0, 1);
  int tested = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const PwmCycle cycle(bridge(PwmPin::enable, kT, 0.3 * unit(rng), 0.8 * unit(rng)), kV, kR,
                         kL * std::pow(10.0, 2 * unit(rng) - 1), 2 * unit(rng) - 1);
    const double e = 36 * unit(rng) - 18, h = 1e-4;
    const double before = cycle.mean(e - h).conductance, after = cycle.mean(e + h).conductance;
    if (std::abs(after - before) > 1e-3 / kR) continue;  // between two branches
    const double slope = (cycle.mean(e - h).current - cycle.mean(e + h).current) / (2 * h);
    ASSERT_NEAR(cycle.mean(e).conductance, slope, 1e-5 / kR) << e << ' ' << cycle.duty();
    ++tested;
  }
  EXPECT_GT(tested, 1900);
}

TEST(PwmCycle, NothingJumpsWhereConductionBreaksOrTheCurrentTurns) {
  for (const double T : {0.0, kT, 5e-4})
    for (int percent = -100; percent <= 100; percent += 5) {
      const PwmCycle cycle(bridge(PwmPin::enable, T, 0.2, 0.6), kV, kR, kL, percent / 101.0);
      for (double e = -20; e < 20; e += 1e-3) {
        const double step = cycle.mean(e).current - cycle.mean(e + 1e-3).current;
        ASSERT_LE(step, 1.2e-3 / kR) << percent << " at " << e;
        ASSERT_NEAR(cycle.power(e).supply, cycle.power(e + 1e-3).supply, 0.06) << percent << " at " << e;
      }
      const PwmCycle next(bridge(PwmPin::enable, T, 0.2, 0.6), kV, kR, kL, percent / 101.0 + 1e-6);
      for (double e = -20; e < 20; e += 0.1) ASSERT_NEAR(next.mean(e).current, cycle.mean(e).current, 1e-4) << percent << ' ' << e;
    }
}

TEST(PwmCycle, WithModulatedInputsALockedMotorHasTheMeanVoltageOverItsResistance) {
  for (const double T : {0.0, kT, 1e-2})
    for (const double d : {-1.0, -0.3, 0.0, 0.1, 0.61}) {
      const PwmCycle cycle(bridge(PwmPin::input, T, 0.2), kV, kR, kL, d);
      EXPECT_NEAR(cycle.mean(0).current, d * kV / 2.5, 1e-12);
      EXPECT_NEAR(cycle.mean(3).current, (d * kV - 3) / 2.5, 1e-12) << "and the same line at any speed";
      EXPECT_NEAR(cycle.mean(3).conductance, 1 / 2.5, 1e-12);
    }
}

TEST(PwmCycle, FastSwitchingOfTheEnablePinGivesALockedMotorNothingBelowHalfTheDuty) {
  const auto current = [](double d, double e, double diode = 0.0) {
    return PwmCycle(bridge(PwmPin::enable, 0, 0, diode), kV, kR, kL, d).mean(e).current;
  };
  for (const double d : {0.1, 0.3, 0.5}) EXPECT_EQ(current(d, 0), 0.0);
  EXPECT_NEAR(current(0.8, 0), (2 * 0.8 - 1) * kV / kR, 1e-12);
  EXPECT_NEAR(current(-0.8, 0), -(2 * 0.8 - 1) * kV / kR, 1e-12);
  EXPECT_NEAR(current(0.8, 2, 0.7), ((2 * 0.8 - 1) * kV - 2 * 0.2 * 0.7 - 2) / kR, 1e-12);
  EXPECT_EQ(current(0.8, 11.9), 0.0) << "driven on by its load it coasts up to the supply's voltage";
  EXPECT_NEAR(current(0.8, 13), -(0.8 * 1 + 0.2 * 1) / kR, 1e-12) << "and beyond it brakes";
  // Finite periods tend to it.
  double off = INFINITY;
  for (const double T : {4e-5, 1e-5, 2.5e-6, 6e-7}) {
    const PwmCycle cycle(bridge(PwmPin::enable, T), kV, kR, kL, 0.3);
    EXPECT_LT(cycle.mean(0).current, 0.3 * off);
    off = cycle.mean(0).current;
  }
  EXPECT_LT(off, 0.005);
}

TEST(PwmCycle, SlowSwitchingLeavesTheCurrentTimeToFollow) {
  const PwmCycle cycle(bridge(PwmPin::enable, 10.0), kV, kR, kL, 0.3);
  EXPECT_NEAR(cycle.mean(2).current, 0.3 * (kV - 2) / kR, 1e-4) << "the supply for three tenths of the time, nothing for the rest";
  EXPECT_NEAR(cycle.mean(2).conductance, 0.3 / kR, 1e-4);
}

TEST(PwmCycle, AtDutyZeroAnOpenBridgeLetsTheMotorCoastAndAShortedOneBrakesIt) {
  const PwmCycle open(bridge(PwmPin::enable, kT, 0, 0.7), kV, kR, kL, 0), shorted(bridge(PwmPin::input), kV, kR, kL, 0);
  for (const double e : {-13.0, -1.0, 0.5, 13.0}) {
    EXPECT_EQ(open.mean(e).current, 0.0) << e;
    EXPECT_EQ(open.mean(e).conductance, 0.0) << e;
    EXPECT_NEAR(shorted.mean(e).current, -e / kR, 1e-12) << e;
  }
  EXPECT_NEAR(open.mean(15).current, -(15 - 13.4) / kR, 1e-12) << "the diodes charge the supply";
  EXPECT_NEAR(open.power(15).supply, -kV * (15 - 13.4) / kR, 1e-9);
  EXPECT_NEAR(open.power(15).bridge, 1.4 * (15 - 13.4) / kR, 1e-9);
}

TEST(PwmCycle, AtTheSpeedOfTheSupplyNoCurrentFlowsAtAnyDuty) {
  for (int percent = 1; percent <= 101; ++percent) {
    const PwmCycle cycle(bridge(PwmPin::enable, kT, 0.1, 0.7), kV, kR, kL, percent / 101.0);
    EXPECT_NEAR(cycle.mean(kV).current, 0.0, 1e-12) << percent;
    EXPECT_GT(cycle.mean(kV - 0.1).current, 0.0) << "a motor without load runs up to it, slowly where the duty is small";
  }
}

TEST(PwmCycle, AFullDutyIsTheSupplyItself) {
  const PwmCycle cycle(bridge(PwmPin::enable, kT, 0.2, 0.7), kV, kR, kL, 1.0);
  for (const double e : {-15.0, 0.0, 7.0, 18.0}) EXPECT_NEAR(cycle.mean(e).current, (kV - e) / 2.5, 1e-9) << e;
}

TEST(PwmCycle, AHugeInductanceLosesNoDigits) {
  // j is nearly constant or a thin triangle; both have simple limits.
  const PwmCycle triangle(bridge(PwmPin::enable, kT), kV, kR, 4.0, 0.3), even(bridge(PwmPin::enable, kT), kV, kR, 4.0, 0.8);
  const double peak = kV * 0.3 * kT / 4.0;
  EXPECT_NEAR(triangle.mean(0).current, 0.5 * peak * 0.6, 1e-4 * peak);
  EXPECT_NEAR(triangle.power(0).winding, kR * peak * peak / 3 * 0.6, 1e-4 * kR * peak * peak);
  EXPECT_NEAR(even.mean(0).current, 0.6 * kV / kR, 1e-8);
  EXPECT_NEAR(even.power(0).winding, kR * std::pow(0.6 * kV / kR, 2), 1e-6);
}

}  // namespace
