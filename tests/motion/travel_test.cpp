// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/motion/travel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vsa::motion {
namespace {

TEST(Travel, DoesNotCountTheSwingOfACycle) {
  Travel travel(1.0, 0.01);
  const double speed = 0.2, swing = 0.5;
  for (int k = 0; k <= 1000; ++k) {
    const double t = 0.01 * k;
    travel.add({speed * t, swing * std::sin(2 * 3.14159265358979 * t), 0.1 * std::sin(7 * t)});
  }
  ASSERT_TRUE(travel.measured());
  EXPECT_NEAR(travel.path_m(), speed * 9.01, 1e-6) << "10 s less the first window";
  EXPECT_NEAR(travel.net_m(), travel.path_m(), 1e-6);
}

TEST(Travel, CountsAClosedCircleAsPathButNotAsNetDisplacement) {
  Travel travel(0.1, 0.01);
  const double radius = 1.5, lap_s = 20;
  for (int k = 0; k <= 2009; ++k) {
    const double angle = 2 * 3.14159265358979 * 0.01 * k / lap_s;
    travel.add({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  EXPECT_NEAR(travel.path_m(), 2 * 3.14159265358979 * radius, 0.02);
  EXPECT_NEAR(travel.net_m(), 0, 1e-6);
}

TEST(Travel, SaysThatARunShorterThanItsWindowIsNotMeasured) {
  Travel travel(1.0, 0.01);
  for (int k = 0; k < 99; ++k) travel.add({0.1 * k, 0, 0});
  EXPECT_FALSE(travel.measured());
  travel.add({9.9, 0, 0});
  EXPECT_TRUE(travel.measured());
  travel.restart();
  EXPECT_FALSE(travel.measured());
}

}  // namespace
}  // namespace vsa::motion
