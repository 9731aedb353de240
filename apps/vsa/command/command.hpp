// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace vsa::app {

struct CommandOptions {
  double equilibrium_deg = 0;
  double preset_deg = 0;
  std::string model;  ///< empty: the only one that runs
  std::string joint;  ///< an actuator's name; empty: all of the model's
  double timeout_s = 5;
};

/// `vsa command EQUILIBRIUM_DEG PRESET_DEG`. Sets the exit code when it was the subcommand.
void setup_command(CLI::App& app, int& exit_code);
int run_command(const CommandOptions& options);

}  // namespace vsa::app
