// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What is said of a badly resolved swing is what a unit does.
#include "vsa/host/resolution.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "support/one_joint.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace {

using vsa::host::resolution;

/// A locked unit's linear spring on an inertia, ω·dt = x: q'' = sum·q' − product·q, by two pairs of steps.
struct Recurrence {
  double sum, product;
};

Recurrence recurrence(double x) {
  constexpr double kStiffness = 20, kStep_s = 1e-3;
  vsa::device::UnitConfig config = vsa::test::without_losses();
  config.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(kStiffness);
  vsa::test::OneJoint joint(config, 0, 0, kStiffness * kStep_s * kStep_s / (x * x), 1'000'000);
  joint.state.supply_on = false;
  joint.step();
  joint.v = 1;
  for (int n = 0; n < 4; ++n) joint.step();
  std::array<double, 4> q{};
  for (double& at : q) {
    at = joint.q;
    joint.step();
  }
  const double det = q[1] * q[1] - q[0] * q[2];
  return {(q[1] * q[2] - q[0] * q[3]) / det, (q[2] * q[2] - q[1] * q[3]) / det};
}

TEST(Resolution, OfASwingIsItsRadiusAndFrequencyInAUnit) {
  for (const double x : {0.1, 0.3, 1.0, 2.0}) {
    const Recurrence r = recurrence(x);
    ASSERT_LT(0.25 * r.sum * r.sum, r.product) << "it swings";
    EXPECT_NEAR(resolution(x).radius, std::sqrt(r.product), 1e-4) << x;
    EXPECT_NEAR(resolution(x).frequency, std::acos(0.5 * r.sum / std::sqrt(r.product)) / x, 1e-3) << x;
  }
}

TEST(Resolution, OfAFineStepIsPerfectAndACoarseOneEndsTheSwing) {
  EXPECT_EQ(resolution(0).radius, 1);
  EXPECT_NEAR(resolution(0.01).radius, 1, 1e-7);
  EXPECT_NEAR(resolution(0.01).frequency, 1, 1e-4);
  EXPECT_LT(resolution(20).radius, 0.1);
}

}  // namespace
