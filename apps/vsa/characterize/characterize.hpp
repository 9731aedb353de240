// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

struct CharacterizeOptions {
  std::string type;                      ///< the actuator's
  std::vector<std::string> experiments;  ///< "stiffness", "speed", "preset-step"; empty: all that the actuator has
  std::vector<double> preset_rad;        ///< empty: the paper's
  std::optional<double> period_s;        ///< of the stiffness sweep
  std::optional<double> amplitude_rad;   ///< of the stiffness sweep; none: by the rule in experiment/bench.hpp
  std::optional<double> load_kg;
  std::optional<int> cycles;     ///< of the stiffness sweep, after the first
  std::optional<double> step_s;  ///< of the simulation; none: the benches' own
  std::vector<std::string> set;  ///< "drive.friction_Nm=0.7"
  std::string out;               ///< directory; empty: characterize_TYPE
};

/// `vsa characterize TYPE`. Sets the exit code when it was the subcommand.
void setup_characterize(CLI::App& app, int& exit_code);
/// Writes its files only when all runs are done. Throws InputError, engine::SimulationError, std::runtime_error (files).
int run_characterize(const CharacterizeOptions& options);

}  // namespace vsa::app
