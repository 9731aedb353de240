// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "hands.hpp"

namespace vsa::engine {
namespace {

TEST(Grasp, LiftsTheBatonOffTheTable) {
  World w = world("frank_table");
  Gait g = motion("frank_grasp");
  const double before = pose(w, "baton::link").position[2];
  play(w, g, 10.0);
  EXPECT_GT(pose(w, "baton::link").position[2], before + 0.015);
  EXPECT_EQ(grip_N(w, "frank_table"), 0) << "the table doesn't carry it";
  EXPECT_GT(grip_N(w, "frank::"), 2 * 2.0) << "two pads press at least its weight each";
  EXPECT_LT(baton_lean_rad(w), 0.35) << "it tilts with the hand, by 13°";
  EXPECT_LT(lean_rad(w), 0.02);
}

TEST(Grasp, LeavesTheBatonAloneWhileTheHandReachesRoundIt) {
  World w = world("frank_table");
  Gait g = motion("frank_grasp");
  const auto before = pose(w, "baton::link").position;
  play(w, g, 4.5);
  const auto now = pose(w, "baton::link").position;
  EXPECT_LT(std::hypot(now[0] - before[0], now[1] - before[1]), 0.003);
}

TEST(HandOver, PutsTheBatonFromTheRightIntoTheLeftHand) {
  World w = world("frank_table");
  Gait g = motion("frank_handover");
  play(w, g, 9.5);
  EXPECT_GT(grip_N(w, "frank::right"), 2.0);
  EXPECT_EQ(grip_N(w, "frank::left"), 0);
  play(w, g, 18.0);
  EXPECT_EQ(grip_N(w, "frank::right"), 0) << "the right hand has let go";
  EXPECT_GT(grip_N(w, "frank::left"), 2.0);
  EXPECT_GT(pose(w, "baton::link").position[2], 0.27 + 0.05) << "and the left one has lifted it";
}

}  // namespace
}  // namespace vsa::engine
