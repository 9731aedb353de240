// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/friction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using vsa::drive::bristle_energy;
using vsa::drive::follow_friction;
using vsa::drive::Friction;
using vsa::drive::friction_heat;
using vsa::drive::FrictionParams;
using vsa::drive::FrictionStep;
using vsa::drive::solve_friction;

TEST(Friction, IsPassiveInEveryBranch) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const FrictionParams& params : {FrictionParams{0.8, 0.03}, FrictionParams{0.8, 0.0}, FrictionParams{0.0, 0.03},
                                       FrictionParams{0, 0}, FrictionParams{0.01, 1e-9}}) {
    const Friction p(params);
    for (int n = 0; n < 5000; ++n) {
      const double u = p.coulomb_Nm > 0 ? p.presliding_rad * unit(rng) : 0.0;
      const double free = std::pow(10.0, -6 + 6 * std::abs(unit(rng))) * unit(rng);
      const double c = std::pow(10.0, -6 + 6 * std::abs(unit(rng)));
      const FrictionStep s = solve_friction(p, u, free, c);
      const double end = p.presliding_rad > 0 && p.coulomb_Nm > 0 ? u + s.displacement - s.anchor_travel : 0.0;
      const double heat = friction_heat(p, u, s);
      EXPECT_GE(heat, -1e-15) << p.coulomb_Nm << ' ' << p.presliding_rad;
      // x − z rounds to 1e-16 of the travel, which is much for a bristle of 1e-9 rad.
      const double rounding = p.presliding_rad > 0 ? p.coulomb_Nm * (2e-16 / p.presliding_rad) * std::abs(s.displacement) : 0.0;
      EXPECT_NEAR(-s.torque * s.displacement, heat + bristle_energy(p, end) - bristle_energy(p, u), 1e-12 + 4 * rounding);
      EXPECT_LE(std::abs(s.torque), p.coulomb_Nm * (1 + 1e-12));
      EXPECT_NEAR(s.displacement, free + c * s.torque, 1e-12 * (1 + std::abs(free))) << "solves its own equation";
    }
  }
}

TEST(Friction, SolvingAndFollowingAgree) {
  std::mt19937 rng(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Friction p(FrictionParams{0.8, 0.03});
  for (int n = 0; n < 2000; ++n) {
    const double u = 0.03 * unit(rng);
    const FrictionStep a = solve_friction(p, u, 0.2 * unit(rng), 1e-2);
    const FrictionStep b = follow_friction(p, u, a.displacement);
    EXPECT_NEAR(a.torque, b.torque, 1e-12);
    EXPECT_NEAR(a.anchor_travel, b.anchor_travel, 1e-14);
  }
}

TEST(Friction, CoulombHoldsUpToItsTorqueAndThenSlides) {
  const Friction p(FrictionParams{0.5, 0.0});
  EXPECT_EQ(solve_friction(p, 0.0, 0.4e-3, 1e-3).displacement, 0.0);
  EXPECT_DOUBLE_EQ(solve_friction(p, 0.0, 0.4e-3, 1e-3).torque, -0.4);
  EXPECT_NEAR(solve_friction(p, 0.0, 0.7e-3, 1e-3).displacement, 0.2e-3, 1e-18);
  EXPECT_DOUBLE_EQ(solve_friction(p, 0.0, -0.7e-3, 1e-3).torque, 0.5);
}

TEST(Friction, TheAnchorStaysWhileTheBristleBends) {
  const Friction p(FrictionParams{0.8, 0.03});
  EXPECT_EQ(follow_friction(p, 0.0, 0.029).anchor_travel, 0.0);
  EXPECT_NEAR(follow_friction(p, 0.0, 0.05).anchor_travel, 0.02, 1e-15);
  EXPECT_EQ(follow_friction(p, 0.03, -0.06).anchor_travel, 0.0) << "reversal takes up twice the bristle first";
}

TEST(Friction, ThatLeadsIsTheMeanBlendedWithWhereThePartIsAtTheEndOfTheStep) {
  const Friction p(FrictionParams{0.8, 0.04});
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 200; ++n) {
    const double u = 0.04 * unit(rng), dx = 0.03 * unit(rng), drift = 0.02 * unit(rng), w = 0.5 * (1 + unit(rng));
    const auto torque = [&](double moved) { return vsa::drive::leading_friction(p, u, moved, drift, w).torque; };
    const double ahead = -p.stiffness * std::clamp(u + 2 * dx - drift, -0.04, 0.04);
    EXPECT_NEAR(torque(dx), (1 - w) * follow_friction(p, u, dx).torque + w * ahead, 1e-14);
    if (std::abs(std::abs(u + dx) - 0.04) < 1e-5 || std::abs(std::abs(u + 2 * dx - drift) - 0.04) < 1e-5) continue;  // a kink
    const double slope = (torque(dx - 1e-6) - torque(dx + 1e-6)) / 2e-6;
    EXPECT_NEAR(vsa::drive::leading_friction(p, u, dx, drift, w).slope, slope, 1e-6);
  }
}

TEST(Friction, HasNoStepLimit) {
  // Explicitly this would need (τ_c/z_max) dt²/J < 4; here it is 2.7e7.
  const Friction p(FrictionParams{0.8, 3e-8});
  double x = 0, v = 1.0, z = 0;
  const double dt = 1e-3, inertia = 1e-3 * 1e-3, c = dt * dt / (2 * inertia);
  for (int n = 0; n < 100; ++n) {
    const FrictionStep s = solve_friction(p, x - z, dt * v, c);
    v = 2 * s.displacement / dt - v;
    x += s.displacement;
    z += s.anchor_travel;
    ASSERT_LE(std::abs(v), 1.0 + 1e-9);
  }
}

}  // namespace
