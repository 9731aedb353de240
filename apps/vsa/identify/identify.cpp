// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "identify/identify.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <iostream>
#include <memory>

#include "identify/compare.hpp"
#include "identify/output.hpp"
#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/output_files.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/bench_model.hpp"

namespace vsa::app {
namespace {

constexpr int kDigits = 5;  // of the estimates: more than any interval is narrow

constexpr const char* kNotes =
    R"(Fits the simulated load test (world bench_load, full dynamics, read by the unit's encoders) to recordings by least
squares over both branches. A parameter is a key of the actuator type, see vsa actuators NAME; tied keys get one value.
Recordings: load_torque_Nm,deflection_rad[,time_s|sample], the commanded preset in the name (…_preset_0.6903rad….csv);
or branch means (…_branches.csv). Period and amplitude of the sweep are common to all.

Writes report.html, results.json and identified.toml, an actuator type for vsa. Where the data don't determine a parameter it
says which, writes no preset and ends with 1.

--compare FILE fits each hypothesis of a TOML file to the recordings that it names, and with each of them left out, and
writes comparison.md, comparison.json and every fit into --out; begun again it goes on. docs/howto/identify.md tells the
file's keys.

Examples:
  vsa identify data/qbmove_maker_pro/*_samples.csv --type qbmove_maker_pro \
    --parameters elastic.k1_Nm=elastic.k2_Nm,drive.dead_band,shaft.friction_Nm,sensor.encoder_zero_rad
  vsa identify --compare data/qbmove_maker_pro/hypotheses.toml)";

identify::Task read_task(const IdentifyOptions& o, const config::ActuatorType& type) {
  Problems problems;
  identify::Task task;
  const auto collect = [&](const auto& step) {
    try {
      step();
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  };
  collect([&] { task.parameters = identify::parse_parameters(o.parameters, type); });
  for (const std::string& file : o.recordings) {
    collect([&] {
      task.observations.push_back(identify::read_observation(file, type));
      identify::Observation& last = task.observations.back();
      if (o.weights == "scatter") last.weight = identify::scatter_weight(last.data);
    });
  }
  problems.throw_if_any();
  return task;
}

void check_numbers(const IdentifyOptions& o) {
  Problems problems;
  const auto require = [&](double value, const char* flag, double least, double most, const char* unit) {
    if (value >= least && value <= most) return;
    problems.add({"", flag, fmt::format("{}", value), "out of range", fmt::format("{} … {} {}", least, most, unit)});
  };
  require(o.period_s, "--period-s", 1, 3600, "s");
  if (o.amplitude_rad) require(*o.amplitude_rad, "--amplitude-rad", 0.01, 3, "rad");
  require(o.cycles, "--cycles", 1.5, 100, "cycles");
  require(o.starts, "--starts", 1, 100, "starts");
  require(o.seed, "--seed", 0, 1e9, "");
  require(o.iterations, "--iterations", 1, 1000, "iterations");
  require(o.profile, "--profile", 0, 101, "points");
  if (o.name.empty() ||
      o.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") != std::string::npos) {
    problems.add({"", "--name", o.name, "isn't a type's name", "letters, digits, _ and -"});
  }
  problems.throw_if_any();
}

/// What has no default, where there is no file of hypotheses that says it.
void check_given(const IdentifyOptions& o) {
  Problems problems;
  if (o.recordings.empty()) problems.add({"", "RECORDING", "", "is missing", "CSV files, or --compare FILE"});
  if (o.type.empty()) problems.add({"", "--type", "", "is missing", "an actuator type, see vsa actuators"});
  if (o.parameters.empty()) problems.add({"", "--parameters", "", "is missing", "keys, see vsa actuators NAME"});
  problems.throw_if_any();
}

/// A file of hypotheses says all but where to write and how many fits at once.
void refuse_mixed(const CLI::App& sub, bool comparing) {
  Problems problems;
  for (const CLI::Option* option : sub.get_options()) {
    const std::string name = option->get_name();
    const bool either = name == "--help" || name == "--out" || name == "--compare";
    if (option->count() == 0 || either || (name == "--jobs") == comparing) continue;
    problems.add({"", name, "", comparing ? "isn't for --compare: its file says it" : "is for --compare only",
                  comparing ? "--out, --jobs" : "--compare FILE --jobs N"});
  }
  problems.throw_if_any();
}

std::string command_of(const IdentifyOptions& o) {
  const IdentifyOptions usual;
  std::string out = "vsa identify " + config::join(o.recordings, " ") + " --type " + o.type + " --parameters " + o.parameters;
  for (const auto& s : o.set) out += " --set " + s;
  if (o.name != usual.name) out += " --name " + o.name;
  if (o.period_s != usual.period_s) out += fmt::format(" --period-s {}", o.period_s);
  if (o.amplitude_rad) out += fmt::format(" --amplitude-rad {}", *o.amplitude_rad);
  if (o.cycles != usual.cycles) out += fmt::format(" --cycles {}", o.cycles);
  if (o.starts != usual.starts) out += fmt::format(" --starts {}", o.starts);
  if (o.seed != usual.seed) out += fmt::format(" --seed {}", o.seed);
  if (o.no_global) out += " --no-global";
  if (o.iterations != usual.iterations) out += fmt::format(" --iterations {}", o.iterations);
  if (o.profile != usual.profile) out += fmt::format(" --profile {}", o.profile);
  if (o.weights != usual.weights) out += " --weights " + o.weights;
  if (o.no_cross_validation) out += " --no-cross-validation";
  return out;
}

void add_profiles(Identification& r, const identify::Residuals& residuals, int points, const identify::FitOptions& fit) {
  for (std::size_t k = 0; k < r.fit.values.size(); ++k) {
    const double se = r.uncertainty.standard_error[k];
    const identify::Parameter& p = r.task.parameters[k];
    const double half = std::isfinite(se) ? 3 * se : 0.1 * (p.max - p.min);
    r.profiles.push_back(identify::profile(residuals, r.fit, k, r.fit.values[k] - half, r.fit.values[k] + half, points, fit));
  }
}

void identify_all(Identification& r, const IdentifyOptions& o, Console& console) {
  const identify::Residuals residuals(r.task, 0);
  r.points = residuals.points();
  identify::FitOptions fit;
  fit.starts = o.starts;
  fit.iterations = o.iterations;
  fit.global = !o.no_global;
  fit.seed = static_cast<unsigned>(o.seed);
  fit.progress = [&](const std::string& text) { console.line(text); };
  std::vector<double> start;
  for (const identify::Parameter& p : r.task.parameters) start.push_back(p.start);
  r.task.prepare(start);
  r.residuals_before = residuals.at(start);
  r.misfits_before = identify::misfits(residuals, r.residuals_before);
  r.fit = identify::fit(residuals, fit);
  for (std::size_t k = 0; k < r.fit.values.size(); ++k) {
    const identify::Parameter& p = r.task.parameters[k];
    r.fit.values[k] = std::clamp(identify::rounded(r.fit.values[k], kDigits), p.min, p.max);
  }
  identify::evaluate_at(r.fit, residuals, fit.interval_effect_rad);
  r.misfits = identify::misfits(residuals, r.fit.residuals);
  r.uncertainty = identify::uncertainty(residuals, r.fit);
  if (!o.no_cross_validation) r.left_out = identify::leave_one_preset_out(r.task, r.fit, fit, 0);
  if (o.profile > 0) add_profiles(r, residuals, o.profile, fit);
  r.evaluations = residuals.evaluations();
}

/// Waits for the work on another thread, so that a signal can end it. False: it did.
bool wait_for(std::future<void>& work, experiment::Watch& watch) {
  while (work.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    if (interrupted() != 0) watch.stop = true;
  }
  try {
    work.get();
  } catch (const experiment::Stopped&) {
    return false;
  }
  return true;
}

}  // namespace

int run_identify(const IdentifyOptions& o) {
  check_given(o);
  check_numbers(o);
  (void)report::page_template();  // told before the work, not after it
  Identification r;
  experiment::Specimen specimen;
  specimen.type = o.type;
  specimen.overrides = config::parse_overrides(o.set, "--set");
  r.type = specimen.library.load(o.type, specimen.overrides);
  r.command = command_of(o);
  r.name = o.name;
  r.period_s = o.period_s;
  r.task = read_task(o, r.type);
  const std::filesystem::path out = o.out.empty() ? "identify_" + o.type : o.out;
  experiment::Watch watch;
  identify::SweepOptions sweep;
  sweep.period_s = o.period_s;
  sweep.amplitude_rad = o.amplitude_rad;
  sweep.cycles = o.cycles;
  identify::use_bench(r.task, specimen, sweep, &watch);
  make_directory(out, "--out");
  catch_interrupts();
  Console console;
  auto work = std::async(std::launch::async, [&] { identify_all(r, o, console); });
  if (!wait_for(work, watch)) {
    console.line("stopped: nothing was written");
    return kSignalled + interrupted();
  }
  const bool determined = !r.uncertainty.deficient();
  const std::string type = determined ? identified_type(r, specimen.library) : "";
  write_whole(out / "results.json", results_json(r));
  if (determined) write_whole(out / (r.name + ".toml"), type);
  report::write_report(identification_report(r), out / "report.html");
  for (const std::string& w : warnings(r)) console.line("warning: " + w);
  std::cout << identification_text(r) << "written: " << (out / "report.html").string() << ", results.json";
  std::cout << (determined ? ", " + r.name + ".toml\n" : "; no preset, as the data don't determine it\n");
  return std::cout.flush() && determined ? kDone : kFailed;
}

void setup_identify(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<IdentifyOptions>();
  CLI::App* sub = app.add_subcommand("identify", "Find parameters of an actuator type from load-test recordings");
  sub->add_option("RECORDING", o->recordings, "CSV files");
  sub->add_option("--type", o->type, "Actuator type: start values, bounds and all that isn't identified");
  sub->add_option("--parameters", o->parameters, "Keys to identify, comma-separated; key=key gives both one value");
  sub->add_option("--set", o->set, "Hold a parameter at another value, or start there if it is identified: key=value")
      ->allow_extra_args(false);
  sub->add_option("--out", o->out, "Directory for the files; default: identify_TYPE, compare_FILE");
  sub->add_option("--name", o->name, "Name of the type that is written")->capture_default_str();
  sub->add_option("--period-s", o->period_s, "Period of the sweep")->check(number_given())->capture_default_str();
  sub->add_option("--amplitude-rad", o->amplitude_rad,
                  "Amplitude of the sweep; default: the shaft reaches 94° at preset 0, 81° at 0.6903 rad")
      ->check(number_given());
  sub->add_option("--cycles", o->cycles, "Cycles to simulate; the first half is left out")
      ->check(number_given())
      ->capture_default_str();
  sub->add_option("--starts", o->starts, "Local solutions: from the type's values, and from the places that a global search finds")
      ->check(number_given())
      ->capture_default_str();
  sub->add_option("--seed", o->seed, "Of the global search")->check(number_given())->capture_default_str();
  sub->add_flag("--no-global", o->no_global, "Take the other starts about the type's values instead");
  sub->add_option("--iterations", o->iterations, "Most iterations of each")->check(number_given())->capture_default_str();
  sub->add_option("--profile", o->profile, "Points of each parameter's profile; 0: none")
      ->check(number_given())
      ->capture_default_str();
  sub->add_option("--weights", o->weights, "scatter: a recording counts by its own repeatability; equal: each radian alike")
      ->check(CLI::IsMember({"scatter", "equal"}))
      ->capture_default_str();
  sub->add_flag("--no-cross-validation", o->no_cross_validation, "Don't fit again without each preset in turn");
  auto c = std::make_shared<CompareOptions>();
  CLI::Option* compare = sub->add_option("--compare", c->file, "Compare the hypotheses of this TOML file instead");
  sub->add_option("--jobs", c->jobs, "With --compare: fits side by side, 0 as many as the machine runs; default: as the file says")
      ->check(number_given());
  sub->footer(kNotes);
  sub->callback([o, c, sub, compare, &exit_code] {
    refuse_mixed(*sub, compare->count() > 0);
    c->out = o->out;
    exit_code = compare->count() > 0 ? run_compare(*c) : run_identify(*o);
  });
}

}  // namespace vsa::app
