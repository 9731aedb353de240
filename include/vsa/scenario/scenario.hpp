// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What shapes a run's numbers, as one value: world, actuators' parameters, faults, motion, and commands in simulated time. As a file
// (TOML): docs/reference/scenario-files.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"

namespace vsa::scenario {

inline constexpr double kShortest_s = 1e-9,   ///< of durations
    kLongest_s = 1e8;                         ///< three years: beyond that nanoseconds would overflow soon
inline constexpr double kLargestSeed = 1e15;  ///< a seed is a whole number up to that

/// One command of a scenario.
struct Command {
  double time_s = 0;                      ///< simulated; given before the first step that begins then or later
  std::string actuator;                   ///< by name, or "model/name" where several models have it
  std::optional<double> equilibrium_rad,  ///< none: keeps what it has
      preset_rad;                         ///< in the law's unit; none: keeps what it has
};

/// What shapes a run's numbers: world, parameters, faults, motion, and commands in simulated time. As a file:
/// docs/reference/scenario-files.md.
struct Scenario {
  std::string scenario;                       ///< the file that said so; empty: none did
  std::string world;                          ///< a file, or a built-in world's name
  std::optional<double> duration_s;           ///< none: the caller's own
  std::optional<double> step_s;               ///< none: what the world says
  std::optional<std::uint64_t> seed;          ///< of faults that draw and name none themselves; the next one's is 1000 more
  std::string concave = "refuse";             ///< collision meshes that aren't convex: refuse, hull, decompose
  std::string impossible_inertia = "refuse";  ///< inertias that no body can have: refuse, lower
  std::string type;                           ///< put on every actuator; empty: what the world says
  std::vector<std::string> set;               ///< override its parameters: "drive.friction_Nm=0.7"
  std::vector<std::string> faults;            ///< "joint_6 unplugged=1", vsa/config/faults_text.hpp
  std::string gait;                           ///< a file, or a built-in gait's name; empty: none
  std::string motion;                         ///< TOML: what a scenario replaces in it, or all of it
  std::vector<Command> commands;              ///< in order of time
};

/// Adds what no run could have, by the keys of a file. Names of files, types and gaits are looked up where they are used.
void validate(const Scenario& scenario, std::string_view where, Problems& problems);

/// The world with its step, its types and its actuators. Throws InputError with every problem, as the next ones do.
[[nodiscard]] engine::World load_world(const Scenario& scenario);
/// The gait or motion of a run, with the scenario's changes; none: it has none.
[[nodiscard]] std::optional<motion::Gait> load_motion(const Scenario& scenario);
/// Its faults, with the scenario's seed in every text that has none.
[[nodiscard]] std::vector<std::string> seeded_faults(const Scenario& scenario);
/// Each text goes to the robots that have its actuator.
void break_robots(engine::World& world, const std::vector<std::string>& faults);

/// The first robot's model, if a body of it flies free: the way of one that is bolted down says nothing. Empty: none.
[[nodiscard]] std::string travelling_model(const engine::World& world);
/// What a distance is averaged over: the gait's period, or what is close to Table II's. Null: no gait.
[[nodiscard]] double travel_window_s(const motion::Gait* gait);

}  // namespace vsa::scenario
