// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

struct ExperimentsOptions {
  std::vector<std::string> types;      ///< empty: all
  std::optional<double> inertia_kgm2;  ///< of every link; none: by each type's torque
  std::optional<double> load_Nm;       ///< to hold; none: by each type's torque
  std::optional<double> step_s;
  std::vector<std::string> set;
  std::string out;  ///< directory; empty: experiments
};

/// `vsa experiments`. Sets the exit code when it was the subcommand.
void setup_experiments(CLI::App& app, int& exit_code);
/// Writes report.html and results.json when all runs are done. Throws InputError, std::runtime_error.
int run_experiments(const ExperimentsOptions& options);

}  // namespace vsa::app
