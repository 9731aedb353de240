// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Chains of every shipped type, preset, step and posture come to rest in the embedded engine. docs/explanation/7-host.md has the
// table.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chain/rest.hpp"
#include "chain/rest_cases.hpp"
#include "vsa/config/actuator_type.hpp"

namespace vsa::test {
namespace {

const std::vector<double> kPresets{0.2, 0.575, 0.611, 0.785}, kSteps_s{0.5e-3, 1e-3, 2e-3, 4e-3};

constexpr double kLeftAlone_s = 5, kMeasured_s = 0.5;

engine::World world_of(const RestCase& c) {
  engine::World world = engine::World::load_string(serial_world(c.chain));
  host::Robot& robot = world.robot(0);
  if (!c.supply) robot.set_supply(false);
  for (std::size_t i = 0; c.held_rad != 0 && i < robot.size(); ++i) EXPECT_TRUE(robot.command(i, c.held_rad, std::nullopt));
  return world;
}

/// Runs cases, and what wasn't quiet once more in short steps.
class LeftAlone {
 public:
  explicit LeftAlone(double short_step_s) : short_step_s_(short_step_s) {}

  Rest run(const RestCase& c) {
    engine::World world = world_of(c);
    RestMeter meter(world.actuators().size());
    run_on(world, kLeftAlone_s - kMeasured_s, false, meter);
    before_ = world.snapshot();
    return run_on(world, kMeasured_s, true, meter);
  }

  /// Whether a unit's program meets the edge of an encoder count depends on where exactly its motors came to stand. So first on
  /// from the state in which the measured half second began; if that comes to rest, postures an encoder count or so beside it from
  /// their start.
  std::optional<Rest> in_short_steps(const RestCase& c, int attempt) const {
    auto fine = nearby(c, attempt);
    if (!fine) return std::nullopt;
    fine->chain.step_s = short_step_s_;
    engine::World world = world_of(*fine);
    if (attempt == 0) world.restore(*before_);
    return rest_of(world, attempt == 0 ? 1 : 2);
  }

 private:
  static Rest run_on(engine::World& world, double seconds, bool count, RestMeter& meter) {
    const int steps = static_cast<int>(std::lround(seconds / world.step_s()));
    for (int step = 0; step < steps; ++step) {
      world.step();
      for (std::size_t i = 0; i < world.actuators().size(); ++i) meter.sample(i, world.read(world.actuators()[i]), count);
    }
    return count ? meter.rest(world.ledger()) : Rest{};
  }

  double short_step_s_;
  std::shared_ptr<const engine::World::Snapshot> before_;
};

void expect_quiet(const std::vector<SerialWorld>& chains, double short_step_s, const std::string& title) {
  LeftAlone alone(short_step_s);
  RestTable table([&](const RestCase& c) { return alone.run(c); },
                  [&](const RestCase& c, int attempt) { return alone.in_short_steps(c, attempt); });
  for (const SerialWorld& chain : chains)
    for_every_rest_case(chain, kPresets, kSteps_s, [&](const RestCase& c) { table.expect_quiet(c); });
  table.print(title);
}

class RestMatrix : public testing::TestWithParam<std::string> {};

TEST_P(RestMatrix, ChainsOfModulesAreQuiet) {
  std::vector<SerialWorld> chains(4);
  int i = 0;
  for (const int joints : {1, 2, 4, 12}) chains[i++].joints = joints;
  for (SerialWorld& chain : chains) chain.type = GetParam();
  expect_quiet(chains, 1e-4, GetParam() + ", chains of 1, 2, 4, 12");
}

TEST_P(RestMatrix, LightLinksAndABareFingerAtTheEndAreQuiet) {
  std::vector<SerialWorld> chains(4);
  chains[0].joints = 3;
  chains[0].mass_kg = 0.05;
  chains[0].inertia_kgm2 = 3e-5;
  for (int i = 1; i < 4; ++i) {
    chains[i].joints = 1 << (i - 1);
    chains[i].last_mass_kg = 0.02;
    chains[i].last_inertia_kgm2 = 2e-5;
  }
  for (SerialWorld& chain : chains) chain.type = GetParam();
  expect_quiet(chains, 5e-5, GetParam() + ", three links of 0.05 kg, a bare finger after 0, 1 and 3 modules");
}

INSTANTIATE_TEST_SUITE_P(Types, RestMatrix, testing::ValuesIn(config::TypeLibrary().names()),
                         [](const auto& c) { return c.param; });

}  // namespace
}  // namespace vsa::test
