// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <functional>
#include <vector>

#include "sweep/generations.hpp"

namespace vsa::app {

/// Makes these runs, and their outcomes are in the log. False: a signal came.
using MakeRuns = std::function<bool(const sweep::Plan& plan, const Todo& runs)>;

/// `vsa optimize PLAN.toml`. Sets the exit code when it was the subcommand.
void setup_optimize(CLI::App& app, int& exit_code);
int run_optimize(const SweepOptions& options);

/// Throws InputError where there is nothing to search, or the plan isn't right.
void check_search(const sweep::Plan& plan, const SweepOptions& options);
/// Claims the folder. Throws InputError: it has results and nobody said --resume.
[[nodiscard]] Generations generations_of(const sweep::Plan& plan, const SweepOptions& options, Console& console);
/// The search itself, whoever makes the runs. The exit code.
int search(const sweep::Plan& plan, const SweepOptions& options, Generations& generations, Console& console, const MakeRuns& make);

}  // namespace vsa::app
