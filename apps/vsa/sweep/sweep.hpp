// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace vsa::app {

/// How long a part waits without news of the others, s: more than any one run takes.
inline constexpr double kWait_s = 6.0 * 3600;

struct SweepOptions {
  std::string command = "sweep";
  std::string plan;  ///< TOML
  std::string out;   ///< folder; empty: COMMAND_PLAN
  unsigned threads = 0;
  std::string part;  ///< "2/8"
  double wait_s = kWait_s;
  bool resume = false, retry_failed = false;
  bool check = false, merge = false;
  long long run = -1;  ///< only that one, to see it; −1: all
};

/// The options that every launcher has.
void add_sweep_options(CLI::App& sub, SweepOptions& options);
/// `vsa sweep PLAN.toml`. Sets the exit code when it was the subcommand.
void setup_sweep(CLI::App& app, int& exit_code);
/// Throws InputError, OutputError.
int run_sweep(const SweepOptions& options);

}  // namespace vsa::app
