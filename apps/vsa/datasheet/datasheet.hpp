// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace vsa::app {

struct DatasheetOptions {
  std::string preset;            ///< the actuator's
  std::vector<std::string> set;  ///< "drive.friction_Nm=0.7"
  std::string out;               ///< file; empty: datasheet_PRESET.html
};

/// `vsa datasheet PRESET`. Sets the exit code when it was the subcommand.
void setup_datasheet(CLI::App& app, int& exit_code);
/// Writes its file only when all runs are done. Throws InputError, engine::SimulationError, record::RecordError.
int run_datasheet(const DatasheetOptions& options);

}  // namespace vsa::app
