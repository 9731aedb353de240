// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Commands that a build for a first run (VSA_COMMANDS=first) is without, and with them the rooms that compile longest: those that
// measure, describe, search and export.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <string>
#include <vector>

namespace vsa::app {

inline constexpr std::array kMoreCommands{"characterize", "linearize", "identify",    "sweep", "optimize",
                                          "validate",     "datasheet", "experiments", "export"};

/// Adds them to `app`; in a build for a first run, which has without_more_commands.cpp instead of more_commands.cpp, nothing.
void setup_more_commands(CLI::App& app, int& exit_code);
/// Those that this build is without.
[[nodiscard]] std::vector<std::string> commands_left_out();

}  // namespace vsa::app
