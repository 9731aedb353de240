// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Scenarios in C++: what a file says is what is played, and again after a reset. `vsa run` with one: tests/apps/scenario_test.cpp.
#include "vsa/scenario/player.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include "vsa/scenario/toml.hpp"

namespace {

using vsa::scenario::Player;
using vsa::scenario::Scenario;

constexpr const char* kText = R"(
[scenario]
world = "snake_flat"
seed = 3
faults = ["joint_2 lost_byte=0.1", "joint_4 lost_byte=0.1 seed=9"]
[set]
"drive.friction_Nm" = 0.5
[motion]
file = "sidewind"
frequency_rad_per_s = 4.0
[[command]]
time_s = 0.02
actuator = "joint_1"
equilibrium_rad = 0.25
)";

Scenario read(const std::string& text) {
  const toml::table root = toml::parse(text);
  vsa::Problems problems;
  vsa::config::TomlSection top(&root, "here.toml", "", problems);
  vsa::config::TomlSection run(top.table("scenario"), "here.toml", "scenario.", problems);
  Scenario out = vsa::scenario::read(top, run, "here.toml", problems);
  problems.throw_if_any();
  return out;
}

double command_of(const vsa::engine::World& world, const char* actuator) { return world.read(actuator).equilibrium_command_rad; }

TEST(Scenario, EachPartReachesTheWorld) {
  const Scenario s = read(kText);
  EXPECT_EQ(vsa::scenario::seeded_faults(s),
            (std::vector<std::string>{"joint_2 lost_byte=0.1 seed=3", "joint_4 lost_byte=0.1 seed=9"}));
  vsa::engine::World world = vsa::scenario::load_world(s);
  EXPECT_EQ(world.robot(0).config().actuators[0].unit.actuator.side[0].gearbox.friction.coulomb_Nm, 0.5);
  EXPECT_EQ(vsa::scenario::travelling_model(world), "qbmove_snake");
  Player player(s, world);
  ASSERT_NE(player.gait(), nullptr);
  EXPECT_EQ(player.gait()->params().frequency_rad_per_s, 4.0);
  EXPECT_DOUBLE_EQ(vsa::scenario::travel_window_s(player.gait()), 2 * 3.14159265358979323846 / 4);
  EXPECT_EQ(vsa::scenario::travel_window_s(nullptr), 1.3);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Scenario, MadeInCppIsCheckedAsAFileIs) {
  const auto problems = [](const Scenario& s) {
    vsa::Problems found;
    vsa::scenario::validate(s, "", found);
    return found.list();
  };
  const Scenario whole = read(kText);
  EXPECT_TRUE(problems(whole).empty());
  const auto refused = [&](const char* key, auto&& change) {
    Scenario s = whole;
    change(s);
    const auto found = problems(s);
    ASSERT_EQ(found.size(), 1U) << key;
    EXPECT_EQ(found[0].key, key);
    EXPECT_THROW((void)vsa::scenario::load_world(s), vsa::InputError) << key;
  };
  refused("duration_s", [](Scenario& s) { s.duration_s = kNan; });
  refused("step_s", [](Scenario& s) { s.step_s = 2; });
  refused("seed", [](Scenario& s) { s.seed = std::uint64_t{1} << 60; });
  refused("concave", [](Scenario& s) { s.concave = "fill"; });
  refused("impossible_inertia", [](Scenario& s) { s.impossible_inertia = "raise"; });
  refused("command.time_s", [](Scenario& s) { s.commands[0].time_s = kNan; });
  refused("command.equilibrium_rad", [](Scenario& s) { s.commands[0].equilibrium_rad = kNan; });
  refused("command.preset_rad", [](Scenario& s) { s.commands[0].preset_rad = kNan; });
  refused("command.equilibrium_rad", [](Scenario& s) { s.commands[0].equilibrium_rad.reset(); });
  refused("command.time_s", [](Scenario& s) {
    s.commands.push_back(s.commands[0]);
    s.commands[1].time_s = 0.01;
  });
}

TEST(Scenario, WhatIsWrittenIsReadAgain) {
  const Scenario s = read(kText);
  const Scenario again = read(vsa::scenario::text(s, 2.5));
  EXPECT_EQ(again.duration_s, 2.5);
  EXPECT_EQ(again.seed, 3U);
  EXPECT_EQ(again.faults, s.faults);
  EXPECT_EQ(again.set, s.set);
  EXPECT_EQ(again.gait, s.gait);
  ASSERT_EQ(again.commands.size(), 1U);
  EXPECT_EQ(again.commands[0].equilibrium_rad, 0.25);
  EXPECT_EQ(vsa::scenario::load_motion(again)->params().frequency_rad_per_s, 4.0);
}

/// Two models of one make, "a" and "b", each with an actuator "j".
std::string two_robots() {
  std::string text = "<?xml version=\"1.0\"?><sdf version=\"1.9\"><world name=\"w\">";
  for (const char* name : {"a", "b"}) {
    text +=
        std::string("<model name=\"") + name +
        "\"><link name=\"l\"><inertial><mass>0.3</mass><inertia><ixx>1e-3</ixx><iyy>1e-3</iyy>" +
        "<izz>1e-3</izz></inertia></inertial></link><joint name=\"j\" type=\"revolute\"><parent>world</parent><child>l</child>" +
        "<axis><xyz>0 1 0</xyz></axis></joint><plugin name=\"vsa::Robot\" filename=\"x\"><actuator><joint>j</joint>" +
        "<type>qbmove_maker_pro_6_1</type></actuator></plugin></model>";
  }
  return text + "</world></sdf>";
}

TEST(Faults, OfSeveralRobotsAreEachTheirOwn) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("vsa_two_robots_" + std::to_string(getpid()) + ".sdf");
  std::ofstream(file) << two_robots();
  Scenario s;
  s.world = file.string();
  const auto ticks = [&](const std::vector<std::string>& faults) {
    vsa::engine::World world = vsa::scenario::load_world(s);
    vsa::scenario::break_robots(world, faults);
    std::array<double, 2> off{};
    for (int i = 0; i < 20; ++i) {
      world.step();
      for (std::size_t r = 0; r < 2; ++r) off[r] += world.read(r == 0 ? "a/j" : "b/j").measured[2].value * (i + 1.0);
    }
    return off;
  };
  const auto both = ticks({"all noise_rad=0.05 seed=7"});
  EXPECT_NE(both[0], both[1]) << "robots with the same luck";
  const auto first = ticks({"a/j noise_rad=0.05 seed=7"});
  EXPECT_EQ(first[0], both[0]);
  EXPECT_NE(first[0], first[1]);
  EXPECT_EQ(ticks({"b/j noise_rad=0.05 seed=8"})[1], both[1]);
  for (const auto& [fault, told] : {std::pair{"j off", "--fault = j: several models have it (allowed: all, a/j, b/j)"},
                                    std::pair{"c off", "--fault = c: no such actuator (allowed: all, a/j, b/j)"}}) {
    try {
      (void)ticks({fault});
      ADD_FAILURE() << fault;
    } catch (const vsa::InputError& error) {
      EXPECT_EQ(std::string(error.what()), told);
    }
  }
  std::filesystem::remove(file);
}

TEST(Player, ACommandTakesItsActuatorFromTheGaitUntilTheReset) {
  const Scenario s = read(kText);
  vsa::engine::World world = vsa::scenario::load_world(s);
  Player player(s, world);
  const auto play = [&] {
    std::vector<double> told;
    for (int i = 0; i < 100; ++i) {
      player.apply(world);
      world.step();
      told.push_back(command_of(world, "joint_1"));
      told.push_back(command_of(world, "joint_2"));
    }
    return told;
  };
  const std::vector<double> first = play();
  EXPECT_NEAR(first[198], 0.25, 1e-3);  // as the unit counts
  EXPECT_NE(first[10], first[198]);
  EXPECT_NE(first[60], first[199]);  // the gait goes on with the others
  world.reset();
  player.reset();
  EXPECT_EQ(play(), first);
}

}  // namespace
