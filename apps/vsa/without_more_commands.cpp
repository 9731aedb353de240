// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "more_commands.hpp"

namespace vsa::app {

void setup_more_commands(CLI::App& /*app*/, int& /*exit_code*/) {}

std::vector<std::string> commands_left_out() { return {kMoreCommands.begin(), kMoreCommands.end()}; }

}  // namespace vsa::app
