// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"

namespace vsa::engine {
namespace {

namespace fs = std::filesystem;
using motion::Gait;

const fs::path kModels = fs::path(VSA_SOURCE_DIR) / "models";

World world(const char* name) { return World::load(kModels / "worlds" / (std::string(name) + ".sdf")); }
Gait gait(const char* name) { return Gait::load(kModels / "gaits" / (std::string(name) + ".toml")); }

void play(World& w, Gait& g, double seconds) {
  const auto steps = std::llround(seconds / w.step_s());
  for (std::int64_t i = 0; i < steps; ++i) {
    g.apply(w);
    w.step();
  }
}

TEST(Worlds, AllLoadWithTheirActuators) {
  for (const auto& [name, count] : {std::pair{"module", 1},
                                    {"bench_free", 1},
                                    {"bench_load", 1},
                                    {"snake_flat", 12},
                                    {"snake_rubble", 12},
                                    {"snake_hills", 12}}) {
    EXPECT_EQ(world(name).actuators().size(), static_cast<std::size_t>(count)) << name;
  }
}

TEST(Snake, TravelsOnFlatGround) {
  World w = world("snake_flat");
  Gait g = gait("sidewind");
  const auto before = w.center_of_mass("qbmove_snake");
  play(w, g, 6.0);
  const auto after = w.center_of_mass("qbmove_snake");
  EXPECT_GT(std::hypot(after[0] - before[0], after[1] - before[1]), 0.2);
  EXPECT_NEAR(after[2], before[2], 0.05) << "it neither sinks nor flies";
}

TEST(Snake, CrawlsOnEveryGroundWithNothingToTell) {
  // Contacts strike the joints at any time, so that frictions reverse within steps; the demo's run is among these.
  for (const auto& [ground, pattern] :
       {std::pair{"snake_rubble", "climb"}, {"snake_flat", "sidewind"}, {"snake_hills", "steered"}}) {
    World w = world(ground);
    Gait g = gait(pattern);
    play(w, g, 20.0);
    for (const host::Notice& n : w.robot(0).take_notices()) ADD_FAILURE() << ground << ", " << pattern << ": " << n.text;
  }
}

TEST(Snake, LiesStillWithoutAGait) {
  World w = world("snake_flat");
  const auto before = w.center_of_mass("qbmove_snake");
  w.run(1.0);
  const auto after = w.center_of_mass("qbmove_snake");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(after[i], before[i], 2e-3);
}

TEST(Snake, LyingThereForLongIsNothingToTell) {
  // Firmware plucks joints that the ground holds, and what that makes adds up: 4e-4 W in all.
  World w = world("snake_flat");
  w.run(40.0);
  EXPECT_LT(w.robot(0).ledger().coupling, -0.01) << "otherwise this shows nothing";
  for (const host::Notice& n : w.robot(0).take_notices()) ADD_FAILURE() << n.text;
}

TEST(Snake, StartsOnTheHillsNeitherInsideNorFarAboveThem) {
  World w = world("snake_hills");
  const double before = w.center_of_mass("qbmove_snake")[2];
  w.run(1.0);
  EXPECT_NEAR(w.center_of_mass("qbmove_snake")[2], before, 0.01);
}

TEST(GaitInAWorld, GivesTheSameBitsTwiceAndAfterAReset) {
  World first = world("snake_flat"), second = world("snake_flat");
  Gait a = gait("steered"), b = gait("steered");
  play(first, a, 4.0);
  play(second, b, 4.0);
  EXPECT_EQ(first.center_of_mass("qbmove_snake"), second.center_of_mass("qbmove_snake"));
  second.reset();
  play(second, b, 4.0);  // the gait notices that time went back
  EXPECT_EQ(first.center_of_mass("qbmove_snake"), second.center_of_mass("qbmove_snake"));
}

TEST(GaitInAWorld, ACopyGoesOnFromASnapshotAsTheOriginal) {
  World w = world("snake_flat");
  Gait g = gait("steered");
  play(w, g, 4.0);
  const auto saved = w.snapshot();
  Gait copy = g;
  play(w, g, 2.0);
  const auto there = w.center_of_mass("qbmove_snake");
  w.restore(*saved);
  play(w, copy, 2.0);
  EXPECT_EQ(w.center_of_mass("qbmove_snake"), there);
}

TEST(GaitInAWorld, CommandsWhatEquationTenSays) {
  World w = world("snake_flat");
  Gait g = gait("sidewind");
  play(w, g, 0.5);
  const auto& group = g.params().groups[0];
  const auto now = w.read(group.actuators[0]);
  EXPECT_NEAR(now.equilibrium_command_rad, g.equilibrium(group, 0, 0.49), 1e-12);
  EXPECT_NEAR(now.preset_command, group.preset_rad, 1e-12);
}

TEST(GaitInAWorld, NamesEveryActuatorThatTheWorldHasNot) {
  World w = world("module");
  Gait g = gait("sidewind");
  try {
    g.bind(w);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 12u);
    EXPECT_NE(std::string(error.what()).find("joint_11"), std::string::npos);
  }
}

TEST(Bench, HoldsItsLoadLevelAgainstGravity) {
  World w = world("bench_load");
  w.command("shaft", 0.8, 0.6);
  w.run(3.0);
  // The load still swings on its spring; over many swings the actuator carries the mean of M g r sin q. What is left is the change
  // of momentum over the window and the shaft's friction, 0.01 N·m.
  double torque = 0, weight = 0, angle = 0;
  const int samples = 4000;
  for (int i = 0; i < samples; ++i) {
    w.step();
    const auto now = w.read("shaft");
    torque += now.torque_Nm / samples;
    weight += 1.0 * 9.81 * 0.15 * std::sin(now.shaft_rad) / samples;
    angle += now.shaft_rad / samples;
  }
  EXPECT_NEAR(torque, weight, 0.02);
  EXPECT_GT(angle, 0.5);
}

}  // namespace
}  // namespace vsa::engine
