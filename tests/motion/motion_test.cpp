// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/motion/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "motion/gait_file.hpp"
#include "vsa/units.hpp"

namespace vsa::motion {
namespace {

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const MotionParams& motion_of(const Gait& gait) { return *gait.params().motion; }

TEST(Motion, GoesFromAChannelsKeyframeToItsNextWhateverLiesBetween) {
  const Gait gait = Gait::load(written(kGoodMotion));
  ASSERT_EQ(motion_of(gait).tracks.size(), 1u);
  const MotionTrack& track = motion_of(gait).tracks[0];
  EXPECT_NEAR(*motion_value(track.equilibrium, false, 2.0), 45 * kPi / 180, 1e-12);
  EXPECT_NEAR(*motion_value(track.preset, false, 1.5), 15 * kPi / 180, 1e-12);
  EXPECT_NEAR(*motion_value(track.preset, false, 9.0), 20 * kPi / 180, 1e-12) << "the last value holds";
  EXPECT_FALSE(motion_value(track.equilibrium, false, 0.9)) << "not commanded before its first keyframe";
}

TEST(Motion, SmoothHasNoSpeedAndNoAccelerationAtItsKeyframes) {
  const std::vector<MotionKey> channel{{0, 0}, {2, 1}};
  const double h = 1e-4;
  const auto v = [&](double t) { return *motion_value(channel, true, t); };
  EXPECT_NEAR(v(1.0), 0.5, 1e-12);
  for (const double t : {0.0, 2.0 - 2 * h}) {
    EXPECT_NEAR((v(t + h) - v(t)) / h, 0, 1e-6);
    EXPECT_NEAR((v(t + 2 * h) - 2 * v(t + h) + v(t)) / (h * h), 0, 3e-3);
  }
  EXPECT_NEAR((v(1 + h) - v(1 - h)) / (2 * h), 15.0 / 16, 1e-6) << "15/8 of the mean speed in the middle";
}

TEST(Motion, LoopsFromTheTimeThatItsFileSays) {
  MotionParams motion;
  motion.end_s = 5;
  EXPECT_EQ(motion_time(motion, 7), 7);
  motion.loop_from_s = 2;
  EXPECT_EQ(motion_time(motion, 4), 4);
  for (const double end : {5, 8, 11}) EXPECT_EQ(motion_time(motion, end), 2) << "each time the same";
  EXPECT_NEAR(motion_time(motion, 6), 3, 1e-12);
  EXPECT_NEAR(motion_time(motion, 5 + 3 * 100 + 1), 3, 1e-9);
}

TEST(MotionFile, WithWavesBesidesIsRefused) {
  const std::string text = problems_of(written(std::string("ramp_s = 1.0\n") + kGoodMotion));
  EXPECT_TRUE(says(text, "ramp_s")) << text;
  EXPECT_TRUE(says(text, "either waves or keyframes")) << text;
}

TEST(MotionFile, WhoseTimesDontGrowIsRefused) {
  EXPECT_TRUE(
      says(problems_of(written(replaced(kGoodMotion, "time_s = 3.0", "time_s = 2.0"))), "keyframe 3: time_s = 2: not after"));
}

TEST(MotionFile, ReportsAllItsMistakesAtOnce) {
  std::string text = replaced(kGoodMotion, "shaft = 90.0", "shaft = nan");
  text = replaced(text, "shaft = 10.0", "shaft = 100.0");
  text = problems_of(written("speed = 2\n" + replaced(text, "\"linear\"", "\"cubic\"")));
  EXPECT_TRUE(says(text, "keyframe 3: equilibrium_deg.shaft")) << text;
  EXPECT_TRUE(says(text, "keyframe 1: preset_deg.shaft = 100: out of range (allowed: 0 … 90)")) << text;
  EXPECT_TRUE(says(text, "interpolation = cubic")) << text;
  EXPECT_TRUE(says(text, "speed = 2: unknown key")) << text;
}

TEST(MotionFile, WithATextForANumberOrAnEmptyKeyframeIsRefused) {
  EXPECT_TRUE(says(problems_of(written(replaced(kGoodMotion, "shaft = 90.0", "shaft = \"90\""))), "not a number"));
  EXPECT_TRUE(says(problems_of(written(replaced(kGoodMotion, "preset_deg = { shaft = 20.0 }", ""))), "says nothing"));
  EXPECT_TRUE(says(problems_of(written(replaced(kGoodMotion, "{ shaft = 20.0 }", "{}"))), "keyframe 2: preset_deg"));
  EXPECT_TRUE(says(problems_of(written(replaced(kGoodMotion, "{ shaft = 20.0 }", "20.0"))), "keyframe 2: preset_deg"));
  EXPECT_TRUE(says(problems_of(written(replaced(kGoodMotion, "time_s = 3.0", ""))), "keyframe 3: time_s: missing"));
}

TEST(MotionFile, ThatLoopsFromBehindItsEndIsRefused) {
  EXPECT_TRUE(says(problems_of(written(std::string("loop_from_s = 3.0\n") + kGoodMotion)), "not before the last keyframe"));
}

TEST(MotionFile, WhoseKeyframeIsNotAListOfTablesIsRefused) {
  EXPECT_TRUE(says(problems_of(written("title = \"a\"\nkeyframe = 3\n")), "keyframe: not a list of tables"));
  EXPECT_TRUE(says(problems_of(written("title = \"a\"\nkeyframe = [3]\n")), "keyframe 1: not a table"));
}

}  // namespace
}  // namespace vsa::motion
