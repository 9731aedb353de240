// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An actuator that a hand has moved goes back to its gait without a jump.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "motion/gait_file.hpp"
#include "vsa/engine/world.hpp"

namespace vsa::engine {
namespace {

namespace fs = std::filesystem;
using motion::ByHand;
using motion::Gait;

const fs::path kGaits = fs::path(VSA_SOURCE_DIR) / "models" / "gaits";

// What is given back, in a world: the commands of one actuator, control period by control period.
class GivenBack : public testing::Test {
 protected:
  /// Plays for so long; returns the largest change of the actuator's commands from one step to the next: equilibrium, preset.
  std::array<double, 2> play(double seconds) {
    std::array<double, 2> largest{};
    host::ActuatorReading last = read();
    for (const double end_s = world_.time_s() + seconds; world_.time_s() < end_s;) {
      gait_.apply(world_);
      world_.step();
      const host::ActuatorReading now = read();
      largest[0] = std::max(largest[0], std::abs(now.equilibrium_command_rad - last.equilibrium_command_rad));
      largest[1] = std::max(largest[1], std::abs(now.preset_command - last.preset_command));
      last = now;
    }
    return largest;
  }
  [[nodiscard]] host::ActuatorReading read() const { return world_.read(world_.actuator("joint_3")); }
  [[nodiscard]] double of_gait() const { return gait_.equilibrium(motion::group(gait_, "vertical"), 1, world_.time_s() - 1e-3); }
  void by_hand(std::optional<double> equilibrium, std::optional<double> preset) {
    world_.robot(0).command(world_.actuator("joint_3").index, equilibrium, preset);
    const ByHand before = gait_.by_hand("joint_3");
    gait_.leave("joint_3", {before.equilibrium || equilibrium, before.preset || preset});
  }

  World world_ = World::load(fs::path(VSA_SOURCE_DIR) / "models" / "worlds" / "snake_flat.sdf");
  Gait gait_ = Gait::load(kGaits / "sidewind.toml");
  // A gap of 2 rad closed in kGiveBack_s, and the gait's own A·ω, in a control period of 10 ms
  static constexpr double kMost = (2.0 / Gait::kGiveBack_s + 1.1 * 4.71) * 0.01;
};

TEST_F(GivenBack, AnActuatorGoesToTheGaitWithoutAJump) {
  play(2.5);
  by_hand(-0.9, 0.05);
  play(0.3);
  ASSERT_NEAR(read().equilibrium_command_rad, -0.9, 1e-12);
  ASSERT_GT(std::abs(of_gait() - read().equilibrium_command_rad), 2 * kMost) << "else a jump wouldn't show";
  gait_.leave("joint_3", {});
  const auto [equilibrium, preset] = play(Gait::kGiveBack_s + 0.1);
  EXPECT_LT(equilibrium, kMost);
  EXPECT_LT(preset, 0.02);
  EXPECT_TRUE(gait_.state().returning.empty());
  play(0.001);
  gait_.apply(world_);
  EXPECT_NEAR(read().preset_command, motion::group(gait_, "vertical").preset_rad, 1e-9);
}

TEST_F(GivenBack, TheGaitsOwnValuesAreReachedToTheBit) {
  World other = World::load(fs::path(VSA_SOURCE_DIR) / "models" / "worlds" / "snake_flat.sdf");
  Gait untouched = Gait::load(kGaits / "sidewind.toml");
  play(1.0);
  by_hand(0.2, std::nullopt);
  play(0.2);
  gait_.leave("joint_3", {});
  play(1.0);
  while (other.time_ns() < world_.time_ns()) {
    untouched.apply(other);
    other.step();
  }
  EXPECT_EQ(read().equilibrium_command_rad, other.read(other.actuator("joint_3")).equilibrium_command_rad);
}

TEST_F(GivenBack, OneOfTheTwoLeavesTheOtherToTheHand) {
  play(2.5);
  by_hand(-0.9, 0.05);
  play(0.2);
  gait_.leave("joint_3", {false, true});
  EXPECT_LT(play(0.2)[0], kMost);
  EXPECT_EQ(read().preset_command, 0.05);
  gait_.leave("joint_3", {});  // the preset joins while the angle is on its way
  const auto [equilibrium, preset] = play(1.0);
  EXPECT_LT(equilibrium, kMost);
  EXPECT_LT(preset, 0.02);
}

TEST_F(GivenBack, TakenAgainOnTheWayItIsTheHandsAtOnce) {
  play(2.5);
  by_hand(-0.9, std::nullopt);
  play(0.2);
  gait_.leave("joint_3", {});
  play(0.2);
  by_hand(0.3, std::nullopt);
  play(0.3);
  EXPECT_NEAR(read().equilibrium_command_rad, 0.3, 1e-12);
  EXPECT_TRUE(gait_.state().returning.empty());
}

TEST_F(GivenBack, WhileTheGaitIsHeldItWaitsForTheGait) {
  play(2.5);
  by_hand(-0.9, std::nullopt);
  play(0.2);
  gait_.leave("joint_3", {});
  play(0.2);
  gait_.hold(world_.time_s());
  const double held = read().equilibrium_command_rad;
  play(1.0);
  EXPECT_EQ(read().equilibrium_command_rad, held);
  gait_.resume(world_.time_s());
  EXPECT_LT(play(1.0)[0], kMost);
  EXPECT_TRUE(gait_.state().returning.empty());
}

}  // namespace
}  // namespace vsa::engine
