// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "more_commands.hpp"

#include "characterize/characterize.hpp"
#include "datasheet/datasheet.hpp"
#include "experiments/experiments.hpp"
#include "export/export.hpp"
#include "identify/identify.hpp"
#include "linearize/linearize.hpp"
#include "sweep/optimize.hpp"
#include "sweep/sweep.hpp"
#include "validate/validate.hpp"

namespace vsa::app {

void setup_more_commands(CLI::App& app, int& exit_code) {
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
