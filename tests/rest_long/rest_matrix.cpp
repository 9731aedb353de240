// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Chains of every shipped type, preset, step and posture come to rest in the embedded engine. docs/7-host.md has the table.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "chain/rest.hpp"
#include "chain/rest_cases.hpp"
#include "vsa/config/preset.hpp"

namespace vsa::test {
namespace {

const std::vector<double> kPresets{0.2, 0.575, 0.611, 0.785}, kSteps_s{0.5e-3, 1e-3, 2e-3, 4e-3};

constexpr double kLeftAlone_s = 5, kShortStep_s = 5e-5;

engine::World world_of(const RestCase& c) {
  engine::World world = engine::World::load_string(serial_world(c.chain));
  host::Robot& robot = world.robot(0);
  if (!c.supply) robot.set_supply(false);
  for (std::size_t i = 0; c.held_rad != 0 && i < robot.size(); ++i) EXPECT_TRUE(robot.command(i, c.held_rad, std::nullopt));
  return world;
}

Rest left_alone(const RestCase& c) {
  engine::World world = world_of(c);
  return rest_of(world, kLeftAlone_s);
}

/// Whether a unit's program meets the edge of an encoder count depends on where exactly its motors came to stand. So first on from
/// the state in which the last half second began; if that comes to rest, postures an encoder count or so beside it from their
/// start.
std::optional<Rest> in_short_steps(const RestCase& c, int attempt) {
  const auto beside = nearby(c, attempt);
  if (!beside) return std::nullopt;
  RestCase fine = *beside;
  fine.chain.step_s = kShortStep_s;
  engine::World short_steps = world_of(fine);
  if (attempt > 0) return rest_of(short_steps, 2);
  engine::World world = world_of(c);
  world.run(kLeftAlone_s - 0.5);
  short_steps.restore(*world.snapshot());
  return rest_of(short_steps, 1.25);
}

void expect_quiet(const SerialWorld& chain, RestTable& table) {
  for_every_rest_case(chain, kPresets, kSteps_s, [&](const RestCase& c) { table.expect_quiet(c); });
}

class RestMatrix : public testing::TestWithParam<std::string> {};

TEST_P(RestMatrix, ChainsOfModulesAreQuiet) {
  RestTable table(left_alone, in_short_steps);
  for (const int joints : {1, 2, 4, 12}) {
    SerialWorld chain;
    chain.type = GetParam();
    chain.joints = joints;
    expect_quiet(chain, table);
  }
  table.print(GetParam() + ", chains of 1, 2, 4, 12");
}

TEST_P(RestMatrix, LightLinksAndABareFingerAtTheEndAreQuiet) {
  RestTable table(left_alone, in_short_steps);
  SerialWorld light;
  light.type = GetParam();
  light.joints = 3;
  light.mass_kg = 0.05;
  light.inertia_kgm2 = 3e-5;
  expect_quiet(light, table);
  for (const int joints : {1, 2, 4}) {
    SerialWorld finger;
    finger.type = GetParam();
    finger.joints = joints;
    finger.last_mass_kg = 0.02;
    finger.last_inertia_kgm2 = 2e-5;
    expect_quiet(finger, table);
  }
  table.print(GetParam() + ", three links of 0.05 kg, a bare finger after 0, 1 and 3 modules");
}

INSTANTIATE_TEST_SUITE_P(Types, RestMatrix, testing::ValuesIn(config::PresetLibrary().names()),
                         [](const auto& c) { return c.param; });

}  // namespace
}  // namespace vsa::test
