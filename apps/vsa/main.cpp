// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Exit codes: 0 done, 1 failed, 2 bad usage or bad input; 128 + n where signal n cut short a run that had a duration.
#include <CLI/CLI.hpp>
#include <array>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "actuators/actuators.hpp"
#include "command/command.hpp"
#include "doctor/doctor.hpp"
#include "more_commands.hpp"
#include "run/run.hpp"
#include "terminal/completion.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/man_page.hpp"
#include "terminal/old_spellings.hpp"
#include "terminal/unknown_word.hpp"
#include "unit/emulate.hpp"
#include "unit/get.hpp"
#include "unit/ping.hpp"
#include "unit/set.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/topics/transport.hpp"

namespace {

constexpr const char* kExamples = R"(Examples:
  vsa run snake_flat --gait sidewind --duration-s 20 --record out
  vsa run my_arm.urdf --realtime
  vsa command 20 35
  vsa actuators qbmove_maker_pro
  vsa characterize qbmove_maker_pro
  vsa datasheet qbmove_maker_pro
  vsa linearize qbmove_maker_pro_6_1 --preset-rad 0.3
  vsa emulate qbmove_maker_pro --units 12
  vsa ping qbmove_maker_pro
  vsa doctor snake_flat

Exit codes: 0 done, 1 failed, 2 bad usage or bad input, 129, 130 or 143 a run with a duration that a signal cut short.)";

/// An unset shell variable in quotes. CLI11 takes it for an absent value; a user wants to know.
void refuse_empty(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (*argv[i] != '\0') continue;
    const std::string before = i > 1 ? argv[i - 1] : "the first argument";
    throw vsa::InputError({"", before, "\"\"", "an empty argument", "a name, a path or a number"});
  }
}

void set_up(CLI::App& app, int& exit_code) {
  app.set_version_flag("--version", "vsa " VSA_VERSION);
  app.require_subcommand(1);
  const std::vector<std::string> left_out = vsa::app::commands_left_out();
  app.footer((left_out.empty() ? "" : "Not in this build, `make` adds them: " + vsa::config::join(left_out) + "\n\n") + kExamples);
  vsa::app::setup_run(app, exit_code);
  vsa::app::setup_command(app, exit_code);
  vsa::app::setup_actuators(app, exit_code);
  vsa::app::setup_emulate(app, exit_code);
  vsa::app::setup_ping(app, exit_code);
  vsa::app::setup_get(app, exit_code);
  vsa::app::setup_set(app, exit_code);
  vsa::app::setup_more_commands(app, exit_code);
  vsa::app::setup_doctor(app, exit_code);
}

/// What shells and the build ask of the command, as its first argument; not for people and so not in the help.
bool tell_about(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return false;
  if (arguments[0] == "--man") {
    std::cout << vsa::app::man_page(app, VSA_VERSION);
  } else if (arguments[0] == "--complete") {
    for (const auto& word : vsa::app::complete(app, {arguments.begin() + 1, arguments.end()})) std::cout << word << '\n';
  } else {
    return false;
  }
  vsa::app::see_all_written();
  return true;
}

/// What the command's flags were called: understood for one more release.
std::vector<std::string> with_names_of_now(const CLI::App& app, std::vector<std::string> arguments) {
  const auto commands =
      app.get_subcommands([&](const CLI::App* c) { return !arguments.empty() && c->get_name() == arguments.front(); });
  if (commands.empty()) return arguments;
  constexpr std::array<std::array<std::string_view, 2>, 2> kOldAndNow{{{"--preset", "--type"}, {"--jobs", "--threads"}}};
  for (std::string& a : arguments) {
    for (const auto& [old, now] : kOldAndNow) {
      if (a != old && !a.starts_with(std::string(old) + '=')) continue;
      if (commands.front()->get_option_no_throw(std::string(now)) == nullptr) continue;
      a.replace(0, old.size(), now);
      std::cerr << "vsa: " << vsa::config::renamed_text(old, now) << '\n';
    }
  }
  return arguments;
}

/// "help" and "help run", as "--help" and "run --help".
void understand_help(std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front() != "help") return;
  arguments.erase(arguments.begin());
  arguments.insert(arguments.begin() + (arguments.empty() ? 0 : 1), "--help");
}

int run_application(int argc, char** argv) {
  vsa::app::fill_closed_standard_files();
  vsa::app::survive_broken_pipes();
  CLI::App app{"vsa: simulates robots built of variable stiffness actuators", "vsa"};
  int exit_code = vsa::app::kDone;
  set_up(app, exit_code);
  std::vector<std::string> arguments = with_names_of_now(app, {argv + (argc > 0 ? 1 : 0), argv + argc});
  understand_help(arguments);
  if (tell_about(app, arguments)) return vsa::app::kDone;
  vsa::app::tell_old_spellings("vsa");
  refuse_empty(argc, argv);
  vsa::app::refuse_unknown_command(app, arguments, vsa::app::commands_left_out());
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ExtrasError& error) {
    vsa::app::refuse_unexpected(app);
    app.exit(error);
    return vsa::app::kBadInput;
  } catch (const CLI::ConversionError& error) {
    vsa::app::refuse_unreadable(app, error);
    app.exit(error);
    return vsa::app::kBadInput;
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) != 0) return vsa::app::kBadInput;
    vsa::app::see_all_written();
    return vsa::app::kDone;
  }
  vsa::app::see_all_written();
  return exit_code;
}

int exit_code_of(int argc, char** argv) {
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

}  // namespace

int main(int argc, char** argv) { vsa::topics::leave(exit_code_of(argc, argv)); }
