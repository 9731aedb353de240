// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A motion in a world.
#include <gtest/gtest.h>

#include <filesystem>

#include "motion/gait_file.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/units.hpp"

namespace vsa::engine {
namespace {

namespace fs = std::filesystem;
using motion::Gait;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Motion, IsPlayedThroughTheCommandEntry) {
  World world = World::load(fs::path(VSA_SOURCE_DIR) / "models/worlds/bench_free.sdf");
  Gait gait = Gait::load(motion::written(motion::kGoodMotion));
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
  Gait gait = Gait::load(
      motion::written(motion::replaced(motion::kGoodMotion, "{ shaft = 0.0 }", "{ shaft = 0.0, elbow = 1.0, knee = 1.0 }")));
  try {
    gait.bind(world);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
    EXPECT_TRUE(says(error.what(), "equilibrium_deg = knee: no such actuator")) << error.what();
  }
}

}  // namespace
}  // namespace vsa::engine
