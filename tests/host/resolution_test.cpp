// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The table of docs/explanation/7-host.md: what the coupling makes of a swing, by formula and by stepping a unit.
#include "vsa/host/resolution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/one_joint.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace {

using vsa::host::Resolution;
using vsa::host::resolution;
using vsa::test::OneJoint;

/// From three successive states of a unit with locked motors and a linear spring: s'' = tr·s' − det·s.
Resolution stepped(double x) {
  constexpr double kInertia = 1e-3, kStep_s = 1e-3;
  vsa::device::UnitConfig config = vsa::test::without_losses();
  config.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(x * x * kInertia / (kStep_s * kStep_s));
  OneJoint joint(config, 0.0, 0.0, kInertia, 1'000'000);
  joint.q = 1e-3;
  const auto y = [&] { return joint.q - 0.5 * kStep_s * joint.v; };
  joint.step();
  const double y0 = y(), v0 = joint.v;
  joint.step();
  const double y1 = y(), v1 = joint.v;
  joint.step();
  const double y2 = y(), v2 = joint.v;
  const double det = (y1 * v2 - y2 * v1) / (y0 * v1 - y1 * v0), trace = (y2 + det * y0) / y1;
  const double rest = det - 0.25 * trace * trace;
  return {std::sqrt(det), std::atan2(std::sqrt(rest), 0.5 * trace) / x};
}

TEST(Resolution, IsThatOfAUnitThatIsStepped) {
  for (const double x : {0.1, 0.3, 0.5, 1.0, 2.0, 3.0}) {
    const Resolution asked = resolution(x), found = stepped(x);
    EXPECT_NEAR(found.radius, asked.radius, 2e-4) << x;
    EXPECT_NEAR(found.frequency, asked.frequency, 2e-3) << x;
  }
}

TEST(Resolution, KeepsWhatIsResolvedAndDampsWhatIsNot) {
  const auto ten_periods = [](double x) {
    const Resolution r = resolution(x);
    return std::pow(r.radius, 2.0 * 10.0 * 6.283185307179586 / (r.frequency * x));
  };
  for (const double x : {0.05, 0.1, 0.2, 0.3}) EXPECT_GT(ten_periods(x), 0.99) << x;
  EXPECT_LT(ten_periods(1.0), 0.05);
  double last = 1.0;
  for (double x = 0.01; x < 1e4; x *= 1.1) {
    EXPECT_LE(resolution(x).radius, last) << x << ": the less it is resolved, the sooner it is gone";
    last = resolution(x).radius;
  }
  EXPECT_EQ(resolution(0).radius, 1.0);
  EXPECT_EQ(resolution(std::nan("")).radius, 1.0);
}

}  // namespace
