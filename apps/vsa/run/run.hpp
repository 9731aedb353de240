// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

inline constexpr double kShortest_s = 1e-9, kLongest_s = 1e8;  // three years; beyond that nanoseconds would overflow soon
inline constexpr double kSlowest = 0.01, kFastest = 100;       // simulated by wall time
inline constexpr double kLargestSeed = 1e15;
inline constexpr double kSlowestRecord_Hz = 1e-3, kFastestRecord_Hz = 1e6;

struct RunOptions {
  std::string world;     ///< a file, or a built-in world's name
  std::string scenario;  ///< the file that said so; empty: the command line did
  std::optional<double> duration_s;
  std::optional<double> step_s;       ///< none: what the world says
  std::optional<std::uint64_t> seed;  ///< of faults that draw and name none themselves; the next one's is 1000 more
  bool realtime = false;
  bool view = false;
  int view_port = 0;               ///< 0: any free one
  std::string view_records = ".";  ///< where the page's record button writes
  std::string speed;               ///< "2", "max"; empty: 1 with realtime or view, else max
  bool low_latency = false;
  bool paused = false;
  bool no_topics = false;
  std::string concave = "refuse";   ///< collision meshes that aren't convex: refuse, hull, decompose
  std::string type;                 ///< put on every actuator; empty: what the world says
  std::vector<std::string> set;     ///< override its parameters: "drive.friction_Nm=0.7"
  std::vector<std::string> faults;  ///< "joint_6 unplugged=1", vsa/config/faults_text.hpp
  std::string gait;                 ///< a file, or a built-in gait's name; empty: none
  std::string motion;               ///< TOML: what a scenario replaces in it, or all of it
  std::string record;               ///< directory; empty: none
  double record_rate_Hz = 100, page_rate_Hz = 50;

  struct Command {
    double time_s = 0;  ///< simulated; given before the first step that begins then or later
    std::string actuator;
    std::optional<double> equilibrium_rad, preset_rad;
  };
  std::vector<Command> commands;  ///< in order of time
};

/// `vsa run WORLD.sdf` and `vsa run SCENARIO.toml`. Sets the exit code when it was the subcommand.
void setup_run(CLI::App& app, int& exit_code);
int run_run(const RunOptions& options);

}  // namespace vsa::app
