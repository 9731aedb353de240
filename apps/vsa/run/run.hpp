// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

struct RunOptions {
  std::string world;  ///< a file, or a built-in world's name
  std::optional<double> duration_s;
  bool realtime = false;
  bool view = false;
  int view_port = 0;               ///< 0: any free one
  std::string view_records = ".";  ///< where the page's record button writes
  std::string speed;               ///< "2", "max"; empty: 1 with realtime or view, else max
  bool low_latency = false;
  bool paused = false;
  bool no_topics = false;
  std::string concave = "refuse";   ///< collision meshes that aren't convex: refuse, hull, decompose
  std::string preset;               ///< put on every actuator; empty: what the world says
  std::vector<std::string> set;     ///< override its parameters: "drive.friction_Nm=0.7"
  std::vector<std::string> faults;  ///< "joint_6 unplugged=1", vsa/config/faults_text.hpp
  std::string gait;                 ///< a file, or a built-in gait's name; empty: none
  std::string record;               ///< directory; empty: none
};

/// `vsa run WORLD.sdf`. Sets the exit code when it was the subcommand.
void setup_run(CLI::App& app, int& exit_code);
int run_run(const RunOptions& options);

}  // namespace vsa::app
