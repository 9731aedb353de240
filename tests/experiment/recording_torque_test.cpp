// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Simulated less recorded torque at equal deflection.
#include <cmath>
#include <limits>

#include "recording_support.hpp"
#include "vsa/experiment/recording.hpp"

namespace vsa::experiment {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// δ = (τ − friction)/stiffness rising, (τ + friction)/stiffness falling, on a grid of 0.05 N·m.
Branches straight(double stiffness, double friction_Nm, double peak_Nm = 1.4) {
  Branches b;
  const auto reach = static_cast<int>(std::lround(peak_Nm / 0.05));
  for (int k = -reach; k <= reach; ++k) {
    const double tau = 0.05 * k;
    b.torque_Nm.push_back(tau);
    b.rising_rad.push_back((tau - friction_Nm) / stiffness);
    b.falling_rad.push_back((tau + friction_Nm) / stiffness);
    b.sd_rising_rad.push_back(0);
    b.sd_falling_rad.push_back(0);
  }
  return b;
}

TEST(TorqueDifference, OfABranchWithItselfIsNothing) {
  const Branches b = straight(3, 0.07);
  const TorqueDifference d = torque_difference(b, b);
  EXPECT_NEAR(d.both_Nm, 0, 1e-12);
  EXPECT_EQ(d.points, 2 * b.torque_Nm.size());
  EXPECT_EQ(d.extrapolated, 0u);
}

/// At equal deflection the torques differ by the friction's difference, whatever the stiffness; the deflections by that over σ.
TEST(TorqueDifference, IsTheDeflectionsTimesTheStiffness) {
  for (const double stiffness : {0.7, 70.0}) {
    const Branches ours = straight(stiffness, 0.04), theirs = straight(stiffness, 0.12);
    const TorqueDifference d = torque_difference(ours, theirs);
    EXPECT_NEAR(d.rising_Nm, 0.08, 1e-9);
    EXPECT_NEAR(d.falling_Nm, 0.08, 1e-9);
    EXPECT_NEAR(difference(ours, theirs).both_rad, 0.08 / stiffness, 1e-9);
    EXPECT_EQ(d.extrapolated, 4u) << "two at an end of each branch";
  }
}

/// A simulated joint that is too stiff doesn't reach the recorded deflections: those points count, and are told.
TEST(TorqueDifference, FollowsAStraightBranchBeyondItsEnds) {
  const Branches ours = straight(4, 0), theirs = straight(2, 0);
  const TorqueDifference d = torque_difference(ours, theirs);
  double square = 0;
  for (const double tau : theirs.torque_Nm) square += tau * tau / static_cast<double>(theirs.torque_Nm.size());
  EXPECT_NEAR(d.both_Nm, std::sqrt(square), 1e-9) << "τ_sim(δ) − τ = 4 τ/2 − τ";
  EXPECT_EQ(d.extrapolated, 2u * 28u) << "half of the points";
}

TEST(TorqueDifference, LeavesOutWhatWasntRecorded) {
  Branches theirs = straight(3, 0.1);
  for (double& v : theirs.falling_rad) v = kNaN;
  theirs.rising_rad[3] = kNaN;
  const TorqueDifference d = torque_difference(straight(3, 0), theirs);
  EXPECT_EQ(d.points, theirs.torque_Nm.size() - 1);
  EXPECT_NEAR(d.both_Nm, 0.1, 1e-9);
  EXPECT_TRUE(std::isnan(d.falling_Nm));
}

TEST(TorqueDifference, OfABranchOfOnePointIsNoNumber) {
  Branches one = straight(3, 0, 0);
  ASSERT_EQ(one.torque_Nm.size(), 1u);
  const TorqueDifference d = torque_difference(one, straight(3, 0));
  EXPECT_EQ(d.points, 0u);
  EXPECT_TRUE(std::isnan(d.both_Nm));
}

/// 0, 0.2, 0.1, 0.3 at τ = 0 … 3: the middle two are one knot, 0.15 at 1.5.
TEST(BranchInverse, PoolsWhatFallsBackAndIsMonotone) {
  const BranchInverse b({0, 1, 2, 3}, {0, 0.2, 0.1, 0.3});
  EXPECT_EQ(b.knots(), 3u);
  EXPECT_NEAR(b.at(0.15).torque_Nm, 1.5, 1e-12);
  EXPECT_NEAR(b.at(0.075).torque_Nm, 0.75, 1e-12);
  double before = -INFINITY;
  for (double d = -0.1; d < 0.4; d += 0.001) {
    EXPECT_GT(b.at(d).torque_Nm, before);
    before = b.at(d).torque_Nm;
  }
}

TEST(BranchInverse, ReachesItsEndsAndTellsWhatLiesBeyond) {
  const BranchInverse b({-1, -0.9, -0.6, 0, 0.6, 1, 1.1, 1.2}, {-0.4, -0.39, -0.36, 0, 0.3, 0.4, kNaN, 0.42});
  EXPECT_FALSE(b.at(-0.4).beyond || b.at(0.42).beyond);
  EXPECT_NEAR(b.at(0.42).torque_Nm, 1.2, 1e-12);
  EXPECT_TRUE(b.at(0.44).beyond && b.at(-0.41).beyond);
  EXPECT_NEAR(b.at(0.44).torque_Nm, 1.4, 1e-12) << "by the knots within 0.5 N·m: 10 N·m/rad";
  EXPECT_NEAR(b.at(-0.41).torque_Nm, -1.1, 1e-12);
  const BranchInverse turn({-1, -0.9, -0.6}, {-0.4, -0.399, -0.36});
  EXPECT_NEAR(turn.at(-0.42).torque_Nm, -1.2, 1e-12) << "not by the turn's 100 N·m/rad";
  EXPECT_NEAR(BranchInverse({-1, 0}, {-0.4, 0}).at(-0.6).torque_Nm, -1.5, 1e-12) << "the neighbour, however far";
}

}  // namespace
}  // namespace vsa::experiment
