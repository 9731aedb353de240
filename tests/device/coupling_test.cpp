// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The shaft coupling's criteria (include/vsa/host/robot.hpp), on the smallest host that integrates as every engine does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "support/one_joint.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace {

using vsa::test::maker_pro;
using vsa::test::OneJoint;
using vsa::test::without_losses;

/// Times at which the shaft crosses its equilibrium upwards, by linear interpolation.
std::vector<double> upward_crossings(OneJoint& joint, double duration_s) {
  std::vector<double> times;
  const double dt = static_cast<double>(joint.dt_ns) * 1e-9;
  double before = joint.q;
  while (static_cast<double>(joint.t_ns) * 1e-9 < duration_s) {
    joint.step();
    if (before < 0 && joint.q >= 0) times.push_back(static_cast<double>(joint.t_ns) * 1e-9 - dt * joint.q / (joint.q - before));
    before = joint.q;
  }
  return times;
}

TEST(Coupling, AnUndampedUnitKeepsItsEnergyAndItsFrequencyForASecond) {
  // DESIGN: p = 0.611 rad, J = 4e-4 kg·m², 1 ms: 90–110 % of the energy after 1 s, frequency within 1 %.
  OneJoint joint(without_losses(), 0.0, 0.611, 4e-4, 1'000'000);
  const auto x = joint.state.actuator.motor;
  const double p = 0.5 * (x[0].angle - x[1].angle);
  joint.q = 0.01;
  joint.step();
  const double before = joint.energy();
  const auto times = upward_crossings(joint, 1.0);
  EXPECT_NEAR(joint.energy() / before, 1.0, 1e-5);
  const double sigma = 2 * 6.85 * 0.022 * std::cosh(6.85 * p);
  const double frequency = static_cast<double>(times.size() - 1) / (times.back() - times.front());
  EXPECT_NEAR(frequency * 2 * vsa::kPi / std::sqrt(sigma / 4e-4), 1.0, 0.01);
}

TEST(Coupling, SpringMassFrequencyFollowsThePreset) {
  for (double preset : {0.0, 0.2, 0.46, 0.69}) {
    OneJoint joint(without_losses(), 0.0, preset, 1e-3, 250'000);
    const auto x = joint.state.actuator.motor;
    joint.q = 0.002;
    const auto times = upward_crossings(joint, 3.0);
    const double sigma = 2 * 6.85 * 0.022 * std::cosh(6.85 * 0.5 * (x[0].angle - x[1].angle));
    const double frequency = static_cast<double>(times.size() - 1) / (times.back() - times.front());
    EXPECT_NEAR(frequency * 2 * vsa::kPi / std::sqrt(sigma / 1e-3), 1.0, 1e-3) << preset;
  }
}

TEST(Coupling, ABareFlangeKickedFarAtTheLargestPresetNeverGainsEnergy) {
  for (std::int64_t step_ns : {500'000, 1'000'000, 2'000'000, 4'000'000}) {
    for (const bool losses : {true, false}) {
      OneJoint joint(losses ? maker_pro() : without_losses(), 0.0, 0.785, 1e-4, step_ns);
      joint.q = 0.8;
      joint.step();
      // With motors on, the firmware pushes energy in; the ledger says how much.
      auto stored = [&] { return 0.5 * joint.inertia * joint.v * joint.v + joint.state.actuator.ledger.stored(); };
      const double first = stored() - joint.state.actuator.ledger.supply;
      double worst = 0;
      for (int n = 0; n < 2000; ++n) {
        joint.step();
        ASSERT_TRUE(std::isfinite(joint.q) && std::isfinite(joint.v)) << step_ns << " step " << n;
        worst = std::max(worst, stored() - joint.state.actuator.ledger.supply - first);
      }
      EXPECT_LT(worst, 1e-4 * first) << step_ns << " ns, losses " << losses;
      const double y = joint.q - 0.5e-9 * static_cast<double>(step_ns) * joint.v;
      EXPECT_LT(std::abs(y), 0.81) << step_ns;
    }
  }
}

TEST(Coupling, ASpringWhoseLawLeavesTheNumbersBehindIsFoundNoFurtherThanItReaches) {
  // The advanced unit's springs, 165 J in them: a guess from one side lands where exp overflows.
  vsa::device::UnitConfig hard = maker_pro();
  hard.actuator.transmission =
      std::make_shared<vsa::elastic::TwoSinh>(vsa::elastic::TwoSinhParams{{0.0019, 0.0019}, {8.9992, 8.9992}});
  for (auto& side : hard.actuator.side) side.motor.inertia_kgm2 = 0.0233;
  for (std::int64_t step_ns : {500'000, 1'000'000, 2'000'000, 4'000'000}) {
    OneJoint joint(hard, 0.0, 0.785, 1e-4, step_ns);
    joint.q = 0.8;
    joint.step();
    auto stored = [&] { return 0.5 * joint.inertia * joint.v * joint.v + joint.state.actuator.ledger.stored(); };
    const double first = stored() - joint.state.actuator.ledger.supply;
    for (int n = 0; n < 500; ++n) {
      joint.step();
      ASSERT_TRUE(std::isfinite(joint.q) && std::isfinite(joint.v)) << step_ns << " step " << n;
      ASSERT_LT(stored() - joint.state.actuator.ledger.supply, first * (1 + 1e-4)) << step_ns << " step " << n;
    }
  }
}

TEST(Coupling, ALightFlangeComesToRestThoughTicksFallInsideItsSteps) {
  // The ticks see a predicted path; one that overshoots drives the motors, and they drive the flange.
  for (const double inertia : {1e-4, 2.25e-5}) {
    for (std::int64_t step_ns : {2'000'000, 3'000'000, 4'000'000, 8'000'000}) {
      OneJoint joint(maker_pro(), 0.0, 0.785, inertia, step_ns);
      joint.v = 20;
      double fastest = 0;
      while (joint.t_ns < 4'000'000'000) {
        joint.step();
        if (joint.t_ns > 3'000'000'000) fastest = std::max(fastest, std::abs(joint.v));
      }
      EXPECT_LT(fastest, 1.0) << inertia << " kg·m², " << step_ns << " ns";
    }
  }
}

/// How fast shaft or motor of a lossless unit become at most in 200 steps, per what they began with: a shaft that swings with
/// 1/ratio of the motor's inertia, on a spring on which the motor swings with ω·dt = theta.
double fastest(double theta, double ratio, double dt_s) {
  const double motor_kgm2 = 0.03;
  auto config = without_losses();
  const double stiffness = theta * theta * motor_kgm2 / (dt_s * dt_s);
  config.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(stiffness);
  for (auto& side : config.actuator.side) side.motor = {motor_kgm2, 0.0, 0.0, 0.0, 1.0, std::nullopt};
  OneJoint joint(config, 0.0, 0.0, motor_kgm2 * ratio, std::llround(dt_s * 1e9));
  joint.v = 1.0;
  double most = 0;
  for (int step = 0; step < 200; ++step) {
    joint.step();
    most = std::max({most, std::abs(joint.v), std::abs(joint.state.actuator.motor[0].speed)});
  }
  return most;
}

TEST(Coupling, WhatAStepResolvesNeitherOfShaftNorOfMotorGainsNoEnergy) {
  // Segments that went their way one by one made it 1e20 and more, from ω·dt = π of the motor on (TREE's lime at 4 ms blew up).
  std::mt19937 random(3);
  const auto draw = [&](double from, double to) {
    return std::pow(10.0, std::uniform_real_distribution<double>(from, to)(random));
  };
  for (int run = 0; run < 400; ++run) {
    const double theta = draw(-1.0, 1.2), ratio = draw(-3.0, 1.0);
    const double dt_s = 1e-3 * static_cast<double>(1 + random() % 16);
    EXPECT_LT(fastest(theta, ratio, dt_s), 4.0) << theta << ", " << ratio << ", " << dt_s;
  }
  // A step of one segment after one of several: nothing of the one is left in the other.
  OneJoint mixed(without_losses(), 0.0, 0.3, 1e-4, 16'000'000), fresh(without_losses(), 0.0, 0.3, 1e-4, 1'000'000);
  mixed.q = 0.4;
  mixed.step();
  fresh.state = mixed.state;
  fresh.q = mixed.q, fresh.v = mixed.v, fresh.t_ns = mixed.t_ns;
  mixed.dt_ns = 1'000'000;
  for (int step = 0; step < 20; ++step) {
    mixed.step();
    fresh.step();
    ASSERT_EQ(mixed.q, fresh.q) << step;
  }
  for (const double dt_s : {0.7e-3, 1.3e-3, 2.9e-3, 7.7e-3})
    for (const double theta : {2.5, 3.4, 5.0, 9.0}) EXPECT_LT(fastest(theta, 0.03, dt_s), 4.0) << theta << ", " << dt_s;
}

TEST(Coupling, AFrictionlessFlangeKeepsItsEnergyOverTenPeriods) {
  // Kicked by 0.2 rad at the largest preset, J = 1e-4, 0.5 ms: ω·dt = 0.35. What is resolved (below 0.3) keeps 99 %.
  OneJoint joint(without_losses(), 0.0, 0.785, 1e-4, 500'000);
  joint.q = 0.2;
  joint.step();
  const double before = joint.energy();
  int crossings = 0;
  for (double last = joint.q; crossings < 20; last = joint.q) {
    joint.step();
    crossings += (last < 0) != (joint.q < 0);
    ASSERT_LT(joint.t_ns, 1'000'000'000);
  }
  EXPECT_GT(joint.energy() / before, 0.99);
  EXPECT_LT(joint.energy() / before, 1.0);
}

TEST(Coupling, ConvergesWithTheSecondOrderOfItsMidpointRule) {
  // A swing under a foreign load: y (the angle that goes with v) and v after 48 ms against a step of 8 µs. Halving the step
  // quarters the error.
  struct End {
    double y, v;
  };
  const auto end = [](std::int64_t step_ns) {
    OneJoint joint(without_losses(), 0.0, 0.5, 1e-3, step_ns);
    joint.q = 0.1;
    joint.load = [](double q) { return -0.3 * std::sin(q); };
    while (joint.t_ns < 48'000'000) joint.step();
    return End{joint.q - 0.5e-9 * static_cast<double>(step_ns) * joint.v, joint.v};
  };
  const End reference = end(8'000);
  End before{};
  for (const std::int64_t step_ns : {2'000'000, 1'000'000, 500'000, 250'000}) {
    const End now = end(step_ns);
    const End error{std::abs(now.y - reference.y), std::abs(now.v - reference.v)};
    if (step_ns < 2'000'000) {
      EXPECT_NEAR(before.y / error.y, 4.0, 0.2) << step_ns;
      EXPECT_NEAR(before.v / error.v, 4.0, 0.2) << step_ns;
    }
    before = error;
  }
}

TEST(Coupling, WithTheSupplyCutTheStoredEnergyNeverGrows) {
  OneJoint joint(maker_pro(), 0.0, 0.6, 1e-3, 1'000'000);
  joint.q = 0.3;
  joint.state.supply_on = false;
  joint.step();
  auto total = [&] { return 0.5 * joint.inertia * joint.v * joint.v + joint.state.actuator.ledger.stored(); };
  double last = total();
  const double first = last;
  for (int n = 0; n < 3000; ++n) {
    joint.step();
    ASSERT_LE(total(), last + 2e-6 * first) << n;
    last = total();
  }
  EXPECT_LT(last, first);
}

}  // namespace
