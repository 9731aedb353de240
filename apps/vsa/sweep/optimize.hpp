// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <functional>
#include <vector>

#include "sweep/steps.hpp"

namespace vsa::app {

/// Makes these runs, and their outcomes are in the log. False: a signal came.
using MakeRuns = std::function<bool(const sweep::Plan& plan, const Todo& runs)>;

/// `vsa optimize PLAN.toml`. Sets the exit code when it was the subcommand.
void setup_optimize(CLI::App& app, int& exit_code);
int run_optimize(const SweepOptions& options);

/// The search itself, whoever makes the runs: reads the logs of a generation, asks for what isn't there, waits for what others make.
/// The exit code.
int search(const sweep::Plan& plan, const SweepOptions& options, Console& console, const MakeRuns& make);
/// Claims the folder. Throws InputError: it has results and nobody said --resume.
void begin_search(const sweep::Plan& plan, const SweepOptions& options);

}  // namespace vsa::app
