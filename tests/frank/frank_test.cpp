// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "frank.hpp"

#include <algorithm>

namespace vsa::engine {
namespace {

TEST(Frank, HasEightModulesOnOneBus) {
  const World w = world("frank");
  ASSERT_EQ(w.robot_count(), 1u);
  const auto& config = w.robot(0).config();
  ASSERT_EQ(config.actuators.size(), 8u);
  EXPECT_EQ(config.buses.size(), 1u);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(config.actuators[i].id, static_cast<int>(i) + 1);
}

TEST(Frank, StandsByItsOwnWeightWithItsArmsHanging) {
  World w = world("frank");
  w.run(5.0);
  EXPECT_LT(lean_rad(w), 1e-3);
  EXPECT_LT(shift_m(w), 1e-3);
  for (const char* joint : {"right_shoulder", "right_elbow", "left_shoulder", "left_elbow", "head_pan", "head_tilt"}) {
    EXPECT_NEAR(w.joint_angle(std::string("frank::") + joint), 0, 0.03) << joint;
  }
}

TEST(Frank, RaisesAHandForwardAndBendsAnElbowForwardAtPositiveAngles) {
  World w = world("frank");
  const double before = pose(w, "frank::right_finger").position[0];
  w.command("right_shoulder", 0.5, 0.6);
  w.command("left_elbow", 0.5, 0.6);
  w.run(2.0);
  EXPECT_GT(pose(w, "frank::right_finger").position[0], before + 0.05);
  EXPECT_GT(pose(w, "frank::left_finger").position[0], before + 0.03);
}

TEST(Frank, MovesTheHandsOfItsTurnedInArmsTowardsEachOther) {
  World w = world("frank");
  const auto apart = [&] { return pose(w, "frank::left_finger").position[1] - pose(w, "frank::right_finger").position[1]; };
  const double before = apart();
  for (const char* side : {"right", "left"}) {
    w.command(std::string(side) + "_shoulder", 0.6, 0.6);
    w.command(std::string(side) + "_elbow", 0.6, 0.6);
  }
  w.run(2.0);
  EXPECT_LT(apart(), before - 0.1);
}

TEST(Frank, WavesWithItsHandAboveTheShoulderAndStandsStill) {
  World w = world("frank");
  Gait g = motion("frank_wave");
  play(w, g, 5.0);
  double low = 1e9, high = -1e9, hand = 1e9, lean = 0;
  play(w, g, 10.0, [&] {
    low = std::min(low, w.joint_angle("frank::right_elbow"));
    high = std::max(high, w.joint_angle("frank::right_elbow"));
    hand = std::min(hand, pose(w, "frank::right_finger").position[2]);
    lean = std::max(lean, lean_rad(w));
  });
  EXPECT_GT(high - low, 30 * kPi / 180) << "the forearm swings";
  EXPECT_GT(hand, 0.42) << "the hand stays above the shoulders";
  EXPECT_LT(lean, 0.02);
  EXPECT_LT(shift_m(w), 5e-3);
}

TEST(Frank, NodsAndShakesItsHead) {
  World w = world("frank");
  Gait g = motion("frank_nod");
  double tilt_low = 0, tilt_high = 0, pan_low = 0, pan_high = 0;
  play(w, g, 5.0, [&] {
    const double tilt = w.joint_angle("frank::head_tilt"), pan = w.joint_angle("frank::head_pan");
    tilt_low = std::min(tilt_low, tilt), tilt_high = std::max(tilt_high, tilt);
    pan_low = std::min(pan_low, pan), pan_high = std::max(pan_high, pan);
  });
  EXPECT_GT(tilt_high, 15 * kPi / 180);
  EXPECT_LT(tilt_low, -5 * kPi / 180);
  EXPECT_GT(pan_high, 25 * kPi / 180);
  EXPECT_LT(pan_low, -25 * kPi / 180);
}

TEST(Frank, LosesReachWithAPresetThatItsMotorsHaveToHoldAgainstTheLoad) {
  const auto shoulder_deg = [](double preset_deg) {
    World w = world("frank");
    w.command("right_elbow", 30 * kPi / 180, 32 * kPi / 180);
    w.command("right_shoulder", 60 * kPi / 180, preset_deg * kPi / 180);
    w.run(5.0);
    return w.joint_angle("frank::right_shoulder") * 180 / kPi;
  };
  const double soft = shoulder_deg(15), middle = shoulder_deg(32), stiff = shoulder_deg(44.9);
  EXPECT_GT(middle, soft + 3) << "a soft spring gives way";
  EXPECT_GT(middle, stiff + 2) << "a stiff one takes up the motors' torque";
}

TEST(Frank, ReachesForwardWithBothHands) {
  World w = world("frank");
  Gait g = motion("frank_reach");
  play(w, g, 3.4);
  for (const char* hand : {"frank::right_finger", "frank::left_finger"}) EXPECT_GT(pose(w, hand).position[0], 0.15) << hand;
  EXPECT_LT(lean_rad(w), 0.02);
}

}  // namespace
}  // namespace vsa::engine
