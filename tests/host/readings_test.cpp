// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Signs and sides of what a robot tells of itself.
#include <gtest/gtest.h>

#include <cmath>

#include "host/free_flanges.hpp"

namespace {

using vsa::test::chain;
using vsa::test::Flanges;

TEST(Readings, DeflectionIsTheShaftAheadOfTheMotorsMeanAndTorqueIsAgainstIt) {
  for (const double shaft : {0.3, -0.3}) {
    Flanges bench(chain(1));
    bench.in[0] = {shaft, 0, 0.0};  // held there
    for (int n = 0; n < 50; ++n) bench.robot.advance(n * bench.dt_ns, bench.dt_ns, bench.in, bench.out);
    const auto r = bench.robot.read(0);
    EXPECT_DOUBLE_EQ(r.shaft_rad, shaft);
    EXPECT_NEAR(r.deflection_rad, shaft - 0.5 * (r.motor_rad[0] + r.motor_rad[1]), 1e-12);
    EXPECT_GT(r.deflection_rad * shaft, 0.9 * shaft * shaft) << "the motors hold back";
    EXPECT_LT(r.torque_Nm * r.deflection_rad, 0);
    EXPECT_NEAR(r.torque_Nm, -(r.motor_torque_Nm[0] + r.motor_torque_Nm[1]), 0.0101) << "but for the shaft's friction";
  }
}

TEST(Readings, EachMotorsCurrentIsItsOwn) {
  // A higher preset drives the motors apart: equal currents of opposite signs, each the way its motor is beginning to turn.
  Flanges bench(chain(1));
  bench.run(20);
  ASSERT_TRUE(bench.robot.command(0, 0.0, 0.6));
  bench.run(20);
  const auto r = bench.robot.read(0);
  EXPECT_GT(std::abs(r.current_A[0]), 0.3);
  EXPECT_NEAR(r.current_A[1], -r.current_A[0], 1e-3);
  for (const int m : {0, 1}) EXPECT_GT(r.current_A[m] * r.motor_speed_rad_per_s[m], 0) << m;

  vsa::device::Faults unplugged;
  unplugged.motor_unplugged[1] = true;
  bench.robot.set_faults(0, unplugged);
  ASSERT_TRUE(bench.robot.command(0, 1.5, 0.0));
  bench.run(100);
  EXPECT_GT(std::abs(bench.robot.read(0).current_A[0]), 0.3);
  EXPECT_EQ(bench.robot.read(0).current_A[1], 0);
}

}  // namespace
