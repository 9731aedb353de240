// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The commands of this build, VSA_COMMANDS: all_commands.cpp or first_commands.cpp.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace vsa::app {

/// Adds the commands, but for the doctor.
void setup_commands(CLI::App& app, int& exit_code);
/// Names of those that this build is without.
[[nodiscard]] std::vector<std::string> commands_left_out();

}  // namespace vsa::app
