// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "actuators/actuators.hpp"
#include "characterize/characterize.hpp"
#include "command/command.hpp"
#include "commands.hpp"
#include "datasheet/datasheet.hpp"
#include "experiments/experiments.hpp"
#include "export/export.hpp"
#include "identify/identify.hpp"
#include "linearize/linearize.hpp"
#include "run/run.hpp"
#include "sweep/optimize.hpp"
#include "sweep/sweep.hpp"
#include "unit/emulate.hpp"
#include "unit/get.hpp"
#include "unit/ping.hpp"
#include "unit/set.hpp"
#include "validate/validate.hpp"

namespace vsa::app {

void setup_commands(CLI::App& app, int& exit_code) {
  setup_run(app, exit_code);
  setup_command(app, exit_code);
  setup_actuators(app, exit_code);
  setup_emulate(app, exit_code);
  setup_ping(app, exit_code);
  setup_get(app, exit_code);
  setup_set(app, exit_code);
  setup_characterize(app, exit_code);
  setup_linearize(app, exit_code);
  setup_identify(app, exit_code);
  setup_sweep(app, exit_code);
  setup_optimize(app, exit_code);
  setup_validate(app, exit_code);
  setup_datasheet(app, exit_code);
  setup_experiments(app, exit_code);
  setup_export(app, exit_code);
}

std::vector<std::string> commands_left_out() { return {}; }

}  // namespace vsa::app
