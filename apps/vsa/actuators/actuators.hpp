// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace vsa::app {

struct ActuatorsOptions {
  std::string name;      ///< empty: list all
  bool all = false;      ///< repairs that are off, too
  bool laws = false;     ///< the elastic laws instead of types
  std::string markdown;  ///< where to write their tables; empty: nowhere
};

/// `vsa actuators [NAME | --laws]`. Sets the exit code when it was the subcommand.
void setup_actuators(CLI::App& app, int& exit_code);
/// Throws InputError for an unknown or broken type; in a listing, after the others are printed.
int run_actuators(const ActuatorsOptions& options);

}  // namespace vsa::app
