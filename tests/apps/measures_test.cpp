// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the summary and the pace of a run are computed from.
#include <gtest/gtest.h>

#include <cmath>

#include "run/travel.hpp"
#include "terminal/pace.hpp"

namespace {

using vsa::app::RealTimePace;
using vsa::app::Travel;
using namespace std::chrono_literals;

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

TEST(RealTimePace, IsDueWhenTheWallHasMovedAsFarAsTheSimulation) {
  RealTimePace pace;
  const RealTimePace::Clock::time_point start{1h};
  RealTimePace::Clock::time_point due;
  pace.anchor(5'000'000, start);
  EXPECT_TRUE(pace.keeps_up(8'000'000, start, due));
  EXPECT_EQ(due, start + 3ms);
}

TEST(RealTimePace, IsLateOnlyBeyondItsSlackAndThenDoesNotRaceToCatchUp) {
  RealTimePace pace;
  const RealTimePace::Clock::time_point start{1h};
  RealTimePace::Clock::time_point due;
  pace.anchor(0, start);
  EXPECT_TRUE(pace.keeps_up(1'000'000, start + 101ms, due)) << "100 ms behind is made good";
  EXPECT_FALSE(pace.keeps_up(1'000'000, start + 500ms, due));
  EXPECT_TRUE(pace.keeps_up(2'000'000, start + 500ms, due));
  EXPECT_EQ(due, start + 401ms) << "499 ms behind became 99 ms";
}

}  // namespace
