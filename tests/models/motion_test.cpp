// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/engine/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "vsa/engine/gait.hpp"
#include "vsa/units.hpp"

namespace vsa::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGood = R"(title = "test"
interpolation = "linear"
[[keyframe]]
time_s = 1.0
equilibrium_deg = { shaft = 0.0 }
preset_deg = { shaft = 10.0 }
[[keyframe]]
time_s = 2.0
preset_deg = { shaft = 20.0 }
[[keyframe]]
time_s = 3.0
equilibrium_deg = { shaft = 90.0 }
)";

fs::path written(const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / "vsa_motion_test.toml";
  std::ofstream(file) << text;
  return file;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string problems_of(const std::string& text) {
  try {
    (void)Gait::load(written(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const MotionParams& motion_of(const Gait& gait) { return *gait.params().motion; }

TEST(Motion, GoesFromAChannelsKeyframeToItsNextWhateverLiesBetween) {
  const Gait gait = Gait::load(written(kGood));
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
  EXPECT_NEAR(motion_time(motion, 6), 3, 1e-12);
  EXPECT_NEAR(motion_time(motion, 5 + 3 * 100 + 1), 3, 1e-9);
}

TEST(Motion, IsPlayedThroughTheCommandEntry) {
  World world = World::load(fs::path(VSA_SOURCE_DIR) / "models/worlds/bench_free.sdf");
  Gait gait = Gait::load(written(kGood));
  const auto play = [&](double until_s) {
    while (world.time_s() < until_s - 1e-9) {
      gait.apply(world);
      world.step();
    }
  };
  play(0.9);
  EXPECT_EQ(world.read("shaft").equilibrium_command_rad, 0.0);
  EXPECT_EQ(world.read("shaft").preset_command, 0.2) << "the world's own, until the motion says more";
  play(2.0);
  EXPECT_NEAR(world.read("shaft").equilibrium_command_rad, 45 * kPi / 180, 1 * kPi / 180);
  play(4.0);
  EXPECT_NEAR(world.read("shaft").equilibrium_command_rad, 90 * kPi / 180, 1e-12);
  EXPECT_NEAR(world.read("shaft").preset_command, 20 * kPi / 180, 1e-12);
  EXPECT_NEAR(world.read("shaft").shaft_rad, 90 * kPi / 180, 0.1) << "and the shaft follows";
}

TEST(Motion, NamesEveryActuatorThatTheWorldHasNot) {
  const World world = World::load(fs::path(VSA_SOURCE_DIR) / "models/worlds/bench_free.sdf");
  Gait gait = Gait::load(written(replaced(kGood, "{ shaft = 0.0 }", "{ shaft = 0.0, elbow = 1.0, knee = 1.0 }")));
  try {
    gait.bind(world);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
    EXPECT_TRUE(says(error.what(), "keyframe = knee: no such actuator")) << error.what();
  }
}

TEST(MotionFile, WithWavesBesidesIsRefused) {
  const std::string text = problems_of(std::string("ramp_s = 1.0\n") + kGood);
  EXPECT_TRUE(says(text, "ramp_s")) << text;
  EXPECT_TRUE(says(text, "either waves or keyframes")) << text;
}

TEST(MotionFile, WhoseTimesDontGrowIsRefused) {
  EXPECT_TRUE(says(problems_of(replaced(kGood, "time_s = 3.0", "time_s = 2.0")), "keyframe[2].time_s = 2: not after"));
}

TEST(MotionFile, ReportsAllItsMistakesAtOnce) {
  std::string text = replaced(kGood, "shaft = 90.0", "shaft = nan");
  text = replaced(text, "shaft = 10.0", "shaft = 100.0");
  text = problems_of("speed = 2\n" + replaced(text, "\"linear\"", "\"cubic\""));
  EXPECT_TRUE(says(text, "keyframe[2].equilibrium_deg.shaft")) << text;
  EXPECT_TRUE(says(text, "keyframe[0].preset_deg.shaft = 100: out of range (allowed: 0 … 90)")) << text;
  EXPECT_TRUE(says(text, "interpolation = cubic")) << text;
  EXPECT_TRUE(says(text, "speed = 2: unknown key")) << text;
}

TEST(MotionFile, WithATextForANumberOrAnEmptyKeyframeIsRefused) {
  EXPECT_TRUE(says(problems_of(replaced(kGood, "shaft = 90.0", "shaft = \"90\"")), "not a number"));
  EXPECT_TRUE(says(problems_of(replaced(kGood, "preset_deg = { shaft = 20.0 }", "")), "says nothing"));
  EXPECT_TRUE(says(problems_of(replaced(kGood, "{ shaft = 20.0 }", "{}")), "keyframe[1].preset_deg"));
  EXPECT_TRUE(says(problems_of(replaced(kGood, "{ shaft = 20.0 }", "20.0")), "keyframe[1].preset_deg"));
  EXPECT_TRUE(says(problems_of(replaced(kGood, "time_s = 3.0", "")), "keyframe[2].time_s: missing"));
}

TEST(MotionFile, ThatLoopsFromBehindItsEndIsRefused) {
  EXPECT_TRUE(says(problems_of(std::string("loop_from_s = 3.0\n") + kGood), "not before the last keyframe"));
}

TEST(MotionFile, WhoseKeyframeIsNotAListOfTablesIsRefused) {
  EXPECT_TRUE(says(problems_of("title = \"a\"\nkeyframe = 3\n"), "keyframe: not a list of tables"));
  EXPECT_TRUE(says(problems_of("title = \"a\"\nkeyframe = [3]\n"), "keyframe[0]: not a table"));
}

}  // namespace
}  // namespace vsa::engine
