// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "run/session.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/faults_help.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/pace.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/processors_awake.hpp"

namespace vsa::app {
namespace {

constexpr double kLongest_s = 1e8;  // three years; beyond that nanoseconds would overflow soon

constexpr const char* kNotes = R"(WORLD is a file or the name of a built-in world, FILE a file or the name of a built-in gait.
Without --duration-s the world runs until Ctrl-C, which is then the normal end (exit code 0). A run with a duration
that Ctrl-C cuts short exits with 130. Either way the record is complete up to the last step.

Examples:
  vsa run snake_flat --gait sidewind --duration-s 20 --record out
  vsa run snake_rubble --realtime
  vsa run snake_flat --gait sidewind --view
  vsa run snake_flat --gait sidewind --duration-s 20 --fault "joint_6 unplugged=1"

)";

void check(const RunOptions& options) {
  if (options.paused && options.no_topics && !options.view) {
    throw InputError({"", "--paused", "", "with --no-topics nobody could let it run", "--view, or topics"});
  }
  if (options.duration_s && !(*options.duration_s > 0 && *options.duration_s <= kLongest_s)) {
    throw InputError({"", "--duration-s", fmt::format("{}", *options.duration_s), "out of range", "above 0 to 1e8 s"});
  }
}

void print(const std::vector<record::Statistic>& summary) {
  for (const auto& line : summary) std::cout << fmt::format("{:<20}{}\n", line.label, line.value);
  std::cout.flush();
  if (!std::cout) throw std::runtime_error("can't write the summary to standard output");
}

int exit_code_of(int signal, const RunOptions& options) { return signal != 0 && options.duration_s ? kSignalled + signal : kDone; }

}  // namespace

int run_run(const RunOptions& options) {
  check(options);
  std::optional<serial::ProcessorsAwake> awake;
  if (options.low_latency) awake.emplace();
  Console console;
  RunSession session(options, console);
  catch_interrupts();
  int signal = 0;
  try {
    signal = session.run();
  } catch (const std::exception& error) {
    // A blow-up or a full disk: keep and tell what there is so far, then let main report the error itself.
    console.wipe();
    try {
      print(session.finish(error.what()));
    } catch (const std::exception& second) {
      console.line(second.what());
    }
    throw;
  }
  print(session.finish(signal != 0 && options.duration_s ? "The run was interrupted." : ""));
  return exit_code_of(signal, options);
}

void setup_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* sub = app.add_subcommand("run", "Run a world");
  sub->add_option("WORLD", options->world, "SDF file, or a built-in world's name")->required();
  sub->add_option("--duration-s", options->duration_s, "Simulated seconds to run; default: until Ctrl-C")->check(number_given());
  CLI::Option* realtime =
      sub->add_flag("--realtime", options->realtime, "Not faster than the wall clock; default: as fast as possible");
  sub->add_flag("--low-latency", options->low_latency, kLowLatencyHelp)->needs(realtime);
  sub->add_option("--speed", options->speed, "Simulated by wall time, 0.01 to 100, or max; default: max, with --view 1")
      ->excludes(realtime);
  CLI::Option* view = sub->add_flag("--view", options->view, "Serve a page on this machine's loopback to watch and touch the run");
  sub->add_option("--view-port", options->view_port, "Its port; default: any free one, printed")
      ->check(CLI::Range(0, 65535))
      ->needs(view);
  sub->add_option("--view-records", options->view_records, "Where the page's record button writes; default: this directory")
      ->needs(view);
  sub->add_option("--preset", options->preset, "Put this actuator preset on every actuator of the world");
  sub->add_option("--set", options->set, "Override a parameter of every actuator: key=value");
  sub->add_option("--fault", options->faults, "Break something from the start: \"ACTUATOR FAULT …\" or \"all FAULT …\"");
  sub->add_option("--concave", options->concave,
                  "Concave collision meshes: refuse (default), hull (fill), decompose (convex parts)")
      ->check(CLI::IsMember({"refuse", "hull", "decompose"}));
  sub->add_option("--gait", options->gait, "Play this gait in simulated time");
  sub->add_option("--record", options->record, "Write CSV files, run.mcap and a replay page into this directory");
  sub->add_flag("--no-topics", options->no_topics, "Run without the transport");
  sub->add_flag("--paused", options->paused, "Start paused; the page or /world/W/control lets it run");
  sub->footer(kNotes + std::string(kFaultsHelp));
  sub->callback([options, &exit_code] { exit_code = run_run(*options); });
}

}  // namespace vsa::app
