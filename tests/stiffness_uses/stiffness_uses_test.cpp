// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The physics behind docs/explanation/what-stiffness-is-good-for.md: impulse is change of momentum, moments balance, energy closes,
// and the trends that the page claims.
#include <gtest/gtest.h>

#include <cmath>

#include "stiffness_uses/gripper.hpp"
#include "stiffness_uses/impact.hpp"
#include "stiffness_uses/terrain.hpp"
#include "stiffness_uses/throwing.hpp"
#include "vsa/units.hpp"

namespace vsa::stiffness_uses {
namespace {

constexpr double kDegree = kPi / 180;

TEST(Impact, TheContactsImpulseIsTheBallsChangeOfMomentum) {
  for (const double preset_deg : {5.0, 44.9}) {
    const ImpactRun r = run_impact(preset_deg * kDegree, 2.0);
    EXPECT_GT(r.impulse_Ns, 0.3);
    EXPECT_NEAR(r.impulse_Ns, r.momentum_Ns, 1e-8 * std::abs(r.momentum_Ns)) << preset_deg;
  }
}

TEST(Impact, TheBallComesAtTheSpeedOfItsFall) {
  const ImpactRun r = run_impact(25 * kDegree, 1.0);
  // ½ I q̇² = m g l (1 − cos 24°), but for the last 2 mm of the way; 0.4 r² of the ball turns with the cord.
  const double expected = std::sqrt(2 * 9.81 * 0.6 * (1 - std::cos(24 * kDegree)) / (1 + 0.4 * 0.05 * 0.05 / 0.36));
  EXPECT_NEAR(r.ball_speed_m_per_s, expected, 0.01 * expected);
}

TEST(Impact, AStifferArmGivesWayLessPushesMoreAndSettlesSooner) {
  const ImpactRun soft = run_impact(5 * kDegree), table_two = run_impact(35 * kDegree), stiff = run_impact(44.9 * kDegree);
  EXPECT_GT(soft.shoulder_deg, table_two.shoulder_deg + 3);
  EXPECT_GT(table_two.shoulder_deg, stiff.shoulder_deg + 0.5);
  EXPECT_LT(soft.push_N, table_two.push_N);
  EXPECT_LT(table_two.push_N, stiff.push_N);
  EXPECT_GT(soft.settle_s, table_two.settle_s);
  EXPECT_GT(table_two.settle_s, stiff.settle_s);
  EXPECT_NEAR(soft.peak_N, stiff.peak_N, 0.1 * soft.peak_N) << "the first blow is a matter of the masses, not of the springs";
}

TEST(Gripper, ForceForASmallCommandGrowsWithThePresetUntilTheMotorsSaturate) {
  double before = 0;
  for (const double preset_deg : {5.0, 15.0, 25.0, 35.0}) {
    const double force = run_gripper("hard", preset_deg * kDegree, {10}).points[0].force_N;
    EXPECT_GT(force, 1.3 * before) << preset_deg;
    before = force;
  }
}

TEST(Gripper, ASoftObjectTakesLessThanAHardOneAndItsSpringCarriesTheForce) {
  const GripPoint hard = run_gripper("hard", 25 * kDegree, {20}).points[0],
                  soft = run_gripper("soft", 25 * kDegree, {20}).points[0];
  EXPECT_LT(soft.force_N, 0.9 * hard.force_N);
  // The pad's touching point moves by about the lever times the finger's angle; 600 N/m.
  EXPECT_NEAR(soft.force_N, 600 * 0.09 * std::tan(soft.finger_deg * kDegree), 0.35 * soft.force_N);
}

TEST(Gripper, AtRestTheContactsMomentIsTheActuatorsTorque) {
  const GripRun r = run_gripper("hard", 25 * kDegree, {10, 20, 30});
  for (const GripPoint& p : r.points) {
    EXPECT_GT(p.force_N, 0.5) << p.command_deg;
    EXPECT_NEAR(std::abs(p.moment_Nm), std::abs(p.torque_Nm), 1e-3 + 0.01 * std::abs(p.torque_Nm)) << p.command_deg;
  }
}

TEST(Gripper, IsOpenBeforeThePadsTouch) {
  const GripRun r = run_gripper("hard", 25 * kDegree, {-10});
  EXPECT_EQ(r.points[0].force_N, 0);
}

TEST(Throwing, TheEnergyLedgerCloses) {
  ThrowPlan plan;
  plan.preset_rad = 5 * kDegree;
  const ThrowRun r = run_throw(plan);
  EXPECT_LT(std::abs(r.imbalance_J), 1e-9 * std::max(1.0, r.supply_J));
  EXPECT_LT(r.kinetic_J, r.supply_J) << "what the ball has came from the supply";
}

TEST(Throwing, ASoftSpringMakesTheLinkFasterThanItsMotorsAndAStiffOneHardly) {
  ThrowPlan plan;
  plan.preset_rad = 5 * kDegree;
  const ThrowRun soft = run_throw(plan);
  plan.preset_rad = 44.9 * kDegree;
  const ThrowRun stiff = run_throw(plan);
  EXPECT_GT(soft.ratio(), 1.3);
  EXPECT_GT(soft.ratio(), stiff.ratio());
}

TEST(Throwing, ABackSwingOfTheRightLengthBeatsNoneAndOneTooLong) {
  ThrowPlan plan;
  plan.preset_rad = 5 * kDegree;
  const auto runs = sweep_throw(plan, {0.0, 0.25, 0.8});
  EXPECT_EQ(&best_of(runs), &runs[1]);
  EXPECT_GT(runs[1].ratio(), runs[0].ratio() + 0.1);
}

TEST(Terrain, MeasuresSpeedCostAndContactForce) {
  TerrainPlan plan;
  plan.duration_s = 8;
  const TerrainRun r = run_terrain(plan);
  EXPECT_GT(r.net_m, 0.2);
  EXPECT_LE(r.net_m, r.path_m + 1e-12);
  EXPECT_GT(r.cost_of_transport, 1);
  EXPECT_GT(r.force_99_N, 5.85 * 9.81 / 52) << "the weight over all spheres";
  EXPECT_GE(r.force_peak_N, r.force_99_N);
}

}  // namespace
}  // namespace vsa::stiffness_uses
