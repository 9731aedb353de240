// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the pace of a run is computed from.
#include "terminal/pace.hpp"

#include <gtest/gtest.h>

namespace {

using vsa::app::RealTimePace;
using namespace std::chrono_literals;

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
