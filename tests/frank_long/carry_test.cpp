// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "frank/hands.hpp"

namespace vsa::engine {
namespace {

TEST(Carry, HoldsTwoHundredGramsForAMinuteWhileTheArmMoves) {
  World w = world("frank_table");
  Gait g = motion("frank_carry");
  play(w, g, 8.5);
  const auto grasp = baton_in_hand(w, "frank::right_forearm");
  double low = 1e9, high = -1e9, least = 1e9, slip = 0;
  play(w, g, 68.5, [&] {
    const double z = pose(w, "baton::link").position[2];
    low = std::min(low, z), high = std::max(high, z);
    least = std::min(least, grip_N(w, "frank::right"));
    const auto now = baton_in_hand(w, "frank::right_forearm");
    slip = std::max(slip, std::hypot(now[0] - grasp[0], now[1] - grasp[1], now[2] - grasp[2]));
  });
  EXPECT_GT(low, 0.27 + 0.01) << "above where it stood";
  EXPECT_GT(high - low, 0.03) << "it is carried about, not only held";
  EXPECT_GT(least, 2.0);
  EXPECT_LT(slip, 0.015) << "friction creeps a little in the engine, and no more";
  EXPECT_LT(lean_rad(w), 0.02);
  EXPECT_LT(shift_m(w), 0.01);
  RecordProperty("slip_mm", std::to_string(slip * 1e3));
  RecordProperty("grip_least_N", std::to_string(least));
}

}  // namespace
}  // namespace vsa::engine
