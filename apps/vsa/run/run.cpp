// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>

#include "run/scenario.hpp"
#include "run/session.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/faults_help.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/pace.hpp"
#include "terminal/step.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/processors_awake.hpp"
#include "vsa/topics/transport.hpp"

namespace vsa::app {
namespace {

constexpr const char* kRunNotes =
    R"(WORLD is a file or the name of a built-in world, FILE a file or the name of a built-in gait. WORLD may also be a
scenario (NAME.toml), which says all this in a file; relative paths in it are relative to it. Flags override what it says; of
--set and --fault both hold, and the flags' are the last said. A recorded run writes DIR/scenario.toml, which repeats it.
Without --duration-s the world runs until Ctrl-C, which is then the normal end (exit code 0). A run with a duration
that Ctrl-C cuts short exits with 130. Either way the record is complete up to the last step.

Examples:
  vsa run snake_flat --gait sidewind --duration-s 20 --record out
  vsa run snake_rubble --realtime
  vsa run snake_flat --gait sidewind --view
  vsa run snake_flat --gait sidewind --duration-s 20 --fault "joint_6 unplugged=1"
  vsa run out/scenario.toml --record again

)";

void check(const RunOptions& options) {
  const auto alone = [](bool given, const char* flag, const char* key, const char* needs) {
    if (given) throw InputError({"", fmt::format("{} ({})", flag, key), "", "is of no use alone", needs});
  };
  alone(options.view_port && !options.view, "--view-port", "view_port", "with --view");
  alone(!options.view_records.empty() && !options.view, "--view-records", "view_records", "with --view");
  const bool paced = options.speed.empty() ? options.realtime || options.view : options.speed != "max";
  alone(options.low_latency && !paced, "--low-latency", "low_latency", "with --realtime, --view or a --speed");
  if (options.paused && !options.view && !options.no_topics) {
    if (const std::string why_none = topics::why_no_topics(); !why_none.empty())
      throw InputError({"", "--paused", "", why_none, "--view, by which it can be let run"});
  }
  if (options.paused && options.no_topics && !options.view) {
    throw InputError({"", "--paused", "", "with --no-topics nobody could let it run", "--view, or topics"});
  }
  if (options.duration_s && !(*options.duration_s > 0 && *options.duration_s <= scenario::kLongest_s)) {
    throw InputError({"", "--duration-s", fmt::format("{}", *options.duration_s), "out of range", "above 0 to 1e8 s"});
  }
  check_step(options.step_s);
  std::error_code differs;
  if (!options.record.empty() && !options.scenario.empty() &&
      std::filesystem::equivalent(std::filesystem::path(options.record) / kScenario, options.scenario, differs)) {
    throw InputError(
        {"", "--record", options.record, "holds the scenario itself, which a record would write over", "another directory"});
  }
}

void print(const std::vector<record::Statistic>& summary) {
  for (const auto& line : summary) std::cout << fmt::format("{:<19} {}\n", line.label, line.value);
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
  catch_interrupts();  // before the session opens ports, whose links and locks it takes away at its end
  RunSession session(options, console);
  int signal = 0;
  try {
    signal = session.run();
  } catch (const std::exception& error) {
    // A blow-up or a full disk: keep and tell what there is so far, then let main report the error itself.
    console.wipe();
    try {
      print(session.finish(error.what()));
      for (const std::string& failure : session.failures()) console.line(failure);
    } catch (const std::exception& second) {
      console.line(second.what());
    }
    throw;
  }
  print(session.finish(signal != 0 && options.duration_s ? "The run was interrupted." : ""));
  for (const std::string& failure : session.failures()) console.line("error: " + failure);
  return session.failures().empty() ? exit_code_of(signal, options) : kFailed;
}

namespace {

/// The flags: where they write to and, for those that were given, how they are laid over a scenario.
class Flags {
 public:
  explicit Flags(CLI::App& sub) : sub_(sub) {}
  RunOptions options;

  /// Of: RunOptions or the scenario that it is.
  template <class T, class Of>
  CLI::Option* value(const char* name, T Of::*to, const std::string& help) {
    return kept(sub_.add_option(name, options.*to, help), [this, to](RunOptions& over) { over.*to = options.*to; });
  }
  CLI::Option* flag(const char* name, bool RunOptions::*to, const std::string& help) {
    return kept(sub_.add_flag(name, options.*to, help), [this, to](RunOptions& over) { over.*to = options.*to; });
  }
  CLI::Option* list(const char* name, std::vector<std::string> scenario::Scenario::*to, const std::string& help) {
    return kept(sub_.add_option(name, options.*to, help)->allow_extra_args(false),
                [this, to](RunOptions& over) { (over.*to).insert((over.*to).end(), (options.*to).begin(), (options.*to).end()); });
  }

  /// All that was said. Throws InputError for a scenario that can't be read.
  [[nodiscard]] RunOptions said() const {
    if (!is_scenario(options.world)) return options;
    RunOptions out = read_scenario(options.world);
    if (!options.gait.empty()) out.motion.clear();
    if (options.realtime) out.speed.clear();
    for (const auto& [option, lay] : kept_) {
      if (option->count() > 0) lay(out);
    }
    return out;
  }

 private:
  CLI::Option* kept(CLI::Option* option, std::function<void(RunOptions&)> lay) {
    kept_.emplace_back(option, std::move(lay));
    return option;
  }

  CLI::App& sub_;
  std::vector<std::pair<CLI::Option*, std::function<void(RunOptions&)>>> kept_;
};

void add_view(Flags& flags) {
  flags.flag("--view", &RunOptions::view, "Serve a page on this machine's loopback to watch and touch the run");
  flags.value("--view-port", &RunOptions::view_port, "Its port; default: any free one, printed")->check(between(0, 65535));
  flags.value("--view-records", &RunOptions::view_records, "Where the page's record button writes; default: this directory");
}

void add_world(Flags& flags) {
  flags.value("--type", &RunOptions::type, "Put this actuator type on every actuator of the world");
  flags.list("--set", &RunOptions::set, "Override a parameter of every actuator: key=value");
  flags.list("--fault", &RunOptions::faults, "Break something from the start: \"ACTUATOR FAULT …\" or \"all FAULT …\"");
  flags
      .value("--seed", &RunOptions::seed,
             "Of faults that draw by chance without a seed of their own: the first one's; each further one's is 1000 more")
      ->check(between(0, scenario::kLargestSeed));
  flags
      .value("--concave", &RunOptions::concave, "Concave collision meshes: refuse (default), hull (fill), decompose (convex parts)")
      ->check(CLI::IsMember({"refuse", "hull", "decompose"}));
  flags
      .value("--impossible-inertia", &RunOptions::impossible_inertia,
             "Inertias that no body can have: refuse (default), lower (the largest moment, to the sum of the others)")
      ->check(CLI::IsMember({"refuse", "lower"}));
}

}  // namespace

void setup_run(CLI::App& app, int& exit_code) {
  CLI::App* sub = app.add_subcommand("run", "Run a world");
  auto flags = std::make_shared<Flags>(*sub);
  sub->add_option("WORLD", flags->options.world, "SDF, URDF or MJCF file, a built-in world's name, or a scenario: a TOML file")
      ->required();
  flags->value("--duration-s", &RunOptions::duration_s, "Simulated seconds to run; default: until Ctrl-C")->check(number_given());
  flags->value("--step-s", &RunOptions::step_s, "Simulated seconds per step; default: what the world says")->check(number_given());
  CLI::Option* realtime =
      flags->flag("--realtime", &RunOptions::realtime, "Not faster than the wall clock; default: as fast as possible");
  flags->flag("--low-latency", &RunOptions::low_latency, kLowLatencyHelp);
  flags->value("--speed", &RunOptions::speed, "Simulated by wall time, 0.01 to 100, or max; default: max, with --view 1")
      ->excludes(realtime);
  add_view(*flags);
  add_world(*flags);
  flags->value("--gait", &RunOptions::gait, "Play this gait in simulated time");
  flags->value("--record", &RunOptions::record, "Write CSV files, run.mcap, a replay page and scenario.toml into this directory");
  flags->flag("--no-topics", &RunOptions::no_topics, "Run without the transport");
  flags->flag("--paused", &RunOptions::paused, "Start paused; the page or /world/W/control lets it run");
  sub->footer(kRunNotes + std::string(kFaultsHelp));
  sub->callback([flags, &exit_code] { exit_code = run_run(flags->said()); });
}

}  // namespace vsa::app
