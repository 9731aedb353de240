// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

struct DatasheetOptions {
  std::string type;              ///< the actuator's; empty with `all`
  bool all = false;              ///< of every type, with a gallery and a page that compares them
  std::optional<double> step_s;  ///< of the simulated rows; none: the benches' own
  std::vector<std::string> set;  ///< "drive.friction_Nm=0.7"
  std::string out;               ///< file, with `all` a directory; empty: datasheet_TYPE.html, datasheets
};

/// `vsa datasheet TYPE`, `vsa datasheet --all`. Sets the exit code when it was the subcommand.
void setup_datasheet(CLI::App& app, int& exit_code);
/// Writes its file only when all runs are done. Throws InputError, engine::SimulationError, record::RecordError.
int run_datasheet(const DatasheetOptions& options);

}  // namespace vsa::app
