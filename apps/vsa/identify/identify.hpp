// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identify/compare.hpp"

namespace vsa::app {

struct IdentifyOptions {
  std::vector<std::string> recordings;  ///< CSV files: samples, or branch means (…_branches.csv)
  std::string type;                     ///< the actuator's, where start values and bounds come from
  std::string parameters;               ///< "elastic.k1_Nm=elastic.k2_Nm,drive.dead_band"
  std::vector<std::string> set;         ///< "drive.friction_Nm=0.7": held at another value than the type's
  std::string out;                      ///< directory; empty: identify_TYPE
  std::string name = "identified";      ///< of the type that is written: NAME.toml
  double period_s = 38;                 ///< of the sweep, of all recordings
  std::optional<double> amplitude_rad;  ///< of the sweep; none: by the rule in experiment/bench.hpp
  double load_kg = 1;                   ///< on the bench's lever
  double cycles = 1.5;                  ///< simulated; the first half is left out
  int starts = 3;
  int seed = 1;  ///< of the global search and of the bootstrap
  bool no_global = false;
  int iterations = 20;
  int profile = 0;                  ///< points of each parameter's profile; 0: none
  int bootstrap = 0;                ///< draws
  std::string weights = "scatter";  ///< or "equal"
  bool no_cross_validation = false;
  std::optional<int>
      threads;       ///< fits at once in each process; 0: as many as the machine runs; none: 0, or as a comparison's file says
  std::string part;  ///< "2/8"
  double wait_s = kWait_s;
  bool resume = false, retry_failed = false;
  CompareOptions compare;  ///< its file is empty: nothing is compared
};

/// All options. The returned function ends their reading: it refuses what doesn't go together (InputError).
[[nodiscard]] std::function<void()> add_identify_options(CLI::App& sub, const std::shared_ptr<IdentifyOptions>& options);
/// `vsa identify RECORDING.csv… --type NAME --parameters …`, and `vsa identify --compare FILE` (compare.hpp). Sets the exit code
/// when it was the subcommand.
void setup_identify(CLI::App& app, int& exit_code);
/// Writes its files only when all is done; no type's file, and exit code 1, where the data don't determine every parameter.
int run_identify(const IdentifyOptions& options);

}  // namespace vsa::app
