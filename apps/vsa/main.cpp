// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Exit codes: 0 done, 1 failed, 2 bad usage or bad input; 128 + n where signal n cut short a run that had a duration.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "actuators.hpp"
#include "characterize.hpp"
#include "command.hpp"
#include "datasheet.hpp"
#include "doctor.hpp"
#include "emulate.hpp"
#include "exit_codes.hpp"
#include "get.hpp"
#include "identify.hpp"
#include "interrupt.hpp"
#include "ping.hpp"
#include "run.hpp"
#include "set.hpp"
#include "validate.hpp"
#include "vsa/errors.hpp"

namespace {

constexpr const char* kExamples = R"(Examples:
  vsa run snake_flat --gait sidewind --duration-s 20 --record out
  vsa run models/worlds/snake_flat.sdf --realtime
  vsa command 20 35
  vsa actuators qbmove_maker_pro
  vsa characterize qbmove_maker_pro
  vsa datasheet qbmove_maker_pro
  vsa emulate qbmove_maker_pro --units 12
  vsa ping qbmove_maker_pro
  vsa doctor snake_flat

Exit codes: 0 done, 1 failed, 2 bad usage or bad input, 130 or 143 a run with a duration that a signal cut short.)";

/// An unset shell variable in quotes. CLI11 takes it for an absent value; a user wants to know.
void refuse_empty(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (*argv[i] != '\0') continue;
    const std::string before = i > 1 ? argv[i - 1] : "the first argument";
    throw vsa::InputError({"", before, "\"\"", "an empty argument", "a name, a path or a number"});
  }
}

int run_application(int argc, char** argv) {
  vsa::app::survive_broken_pipes();
  refuse_empty(argc, argv);
  CLI::App app{"vsa: simulates robots built of variable stiffness actuators", "vsa"};
  app.set_version_flag("--version", "vsa " VSA_VERSION);
  app.require_subcommand(1);
  app.footer(kExamples);
  int exit_code = vsa::app::kDone;
  vsa::app::setup_run(app, exit_code);
  vsa::app::setup_command(app, exit_code);
  vsa::app::setup_actuators(app, exit_code);
  vsa::app::setup_emulate(app, exit_code);
  vsa::app::setup_ping(app, exit_code);
  vsa::app::setup_get(app, exit_code);
  vsa::app::setup_set(app, exit_code);
  vsa::app::setup_characterize(app, exit_code);
  vsa::app::setup_identify(app, exit_code);
  vsa::app::setup_validate(app, exit_code);
  vsa::app::setup_datasheet(app, exit_code);
  vsa::app::setup_doctor(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? vsa::app::kDone : vsa::app::kBadInput;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_application(argc, argv);
  } catch (const vsa::InputError& error) {
    for (const auto& problem : error.problems()) std::cerr << "vsa: " << problem.text() << '\n';
    return vsa::app::kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "vsa: " << error.what() << '\n';
    return vsa::app::kFailed;
  }
}
