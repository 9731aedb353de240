// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

struct LinearizeOptions {
  std::string target;                     ///< an actuator type, or a world
  std::optional<double> at_rad;           ///< the shaft's angle; none: where the load puts it
  std::optional<double> load_Nm;          ///< at the shaft; none: 0
  std::optional<double> preset_rad;       ///< attained; a type: else 0, a world: else as it begins
  std::optional<double> equilibrium_rad;  ///< attained; none: 0
  std::optional<double> inertia_kgm2;
  std::optional<double> damping_Nms_per_rad;  ///< none: 0
  std::string firmware = "averaged", friction = "sliding";
  std::vector<std::string> set;  ///< "drive.supply_V=24"
  std::string out;               ///< directory; empty: linearize_TARGET
  // Of a world, "elbow=0.3":
  std::vector<std::string> at;          ///< where joints stand
  std::vector<std::string> presets;     ///< of single actuators
  std::vector<std::string> equilibria;  ///< likewise
  std::string type;                     ///< put on every actuator; empty: what the world says
};

/// `vsa linearize TYPE|WORLD`. Sets the exit code when it was the subcommand.
void setup_linearize(CLI::App& app, int& exit_code);
/// Throws InputError, std::runtime_error (files).
int run_linearize(const LinearizeOptions& options);

}  // namespace vsa::app
