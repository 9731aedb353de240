// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "actuators/actuators.hpp"
#include "command/command.hpp"
#include "commands.hpp"
#include "run/run.hpp"
#include "unit/emulate.hpp"
#include "unit/get.hpp"
#include "unit/ping.hpp"
#include "unit/set.hpp"

namespace vsa::app {

void setup_commands(CLI::App& app, int& exit_code) {
  setup_run(app, exit_code);
  setup_command(app, exit_code);
  setup_actuators(app, exit_code);
  setup_emulate(app, exit_code);
  setup_ping(app, exit_code);
  setup_get(app, exit_code);
  setup_set(app, exit_code);
}

std::vector<std::string> commands_left_out() {
  return {"characterize", "linearize", "identify", "sweep", "optimize", "validate", "datasheet", "experiments", "export"};
}

}  // namespace vsa::app
