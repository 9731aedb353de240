// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "characterize/characterize.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "characterize/output.hpp"
#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/follow.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/output_files.hpp"
#include "terminal/step.hpp"
#include "vsa/config/text.hpp"
#include "vsa/files.hpp"

namespace vsa::app {
namespace {

constexpr const char* kCharacterizeNotes = R"(Experiments, on the worlds bench_load and bench_free (the paper, section IV):
  stiffness    slow sinusoidal sweep of the equilibrium with 1 kg on a 0.15 m lever: torque-deflection loop, stiffness
  speed        square wave of the equilibrium, 1.57 rad, no load: rise time, speed, overshoot, ringing
  preset-step  the preset from 0 to its largest value and back, without load and with the lever held out

A joint that can't carry the lever at preset 0 begins at the first preset that does; where none does, or the
lever is nothing to it, the mass is another. Both are told.

Writes report.html, results.json and a CSV file for each run. An actuator without a stiffness preset has no
--preset-rad and no preset-step.

Examples:
  vsa characterize qbmove_maker_pro
  vsa characterize qbmove_maker_pro --experiment stiffness --preset-rad 0 0.2 0.4 --period-s 76 --out slow
  vsa characterize qbmove_maker_pro --set drive.supply_V=24)";

study::CharacterizationOptions study_of(const CharacterizeOptions& o) {
  study::CharacterizationOptions out;
  out.specimen.type = o.type;
  out.specimen.overrides = config::parse_overrides(o.set, "--set");
  out.specimen.step_s = o.step_s;
  for (const auto e : {study::Experiment::stiffness, study::Experiment::speed, study::Experiment::preset_step}) {
    if (std::find(o.experiments.begin(), o.experiments.end(), study::word(e)) != o.experiments.end()) out.experiments.push_back(e);
  }
  out.preset = o.preset_rad;
  out.period_s = o.period_s;
  out.amplitude_rad = o.amplitude_rad;
  out.cycles = o.cycles;
  out.load_kg = o.load_kg;
  return out;
}

/// The command again, with what was given.
std::string command_of(const CharacterizeOptions& o) {
  std::string out = "vsa characterize " + shell_word(o.type);
  for (const auto& e : o.experiments) out += " --experiment " + e;
  if (!o.preset_rad.empty()) out += fmt::format(" --preset-rad {}", fmt::join(o.preset_rad, " "));
  if (o.period_s) out += fmt::format(" --period-s {}", *o.period_s);
  if (o.amplitude_rad) out += fmt::format(" --amplitude-rad {}", *o.amplitude_rad);
  if (o.cycles) out += fmt::format(" --cycles {}", *o.cycles);
  if (o.load_kg) out += fmt::format(" --load-kg {}", *o.load_kg);
  if (o.step_s) out += fmt::format(" --step-s {}", *o.step_s);
  for (const auto& s : o.set) out += " --set " + shell_word(s);
  return out;
}

template <class Results>
void tell_notices(const Results& results, const std::string& unit, Console& console) {
  for (const auto& r : results) {
    for (const std::string& n : r.run.notices) {
      console.line(unit.empty() ? "warning: " + n : fmt::format("warning: preset {:.4g} {}: {}", r.options.preset, unit, n));
    }
  }
}

/// What another type, or other presets, left there has other names, and nobody overwrites it.
void tell_of_others(const std::filesystem::path& directory, const std::vector<std::string>& ours, Console& console) {
  constexpr std::array<std::string_view, 3> kOurs{"stiffness", "speed", "preset_step"};
  std::vector<std::string> others;
  std::error_code none;
  for (std::filesystem::directory_iterator at(directory, none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    const auto kind =
        std::find_if(kOurs.begin(), kOurs.end(), [&](std::string_view k) { return name.compare(0, k.size(), k) == 0; });
    const bool a_run =
        at->path().extension() == ".csv" && kind != kOurs.end() && (name[kind->size()] == '_' || name[kind->size()] == '.');
    if (a_run && std::find(ours.begin(), ours.end(), name) == ours.end()) others.push_back(name);
  }
  std::sort(others.begin(), others.end());
  if (!others.empty()) console.line("warning: " + directory.string() + " keeps an earlier run's " + config::join(others));
}

}  // namespace

int run_characterize(const CharacterizeOptions& options) {
  check_step(options.step_s);
  Console console;
  study::Characterization plan = study::plan_characterization(study_of(options));
  (void)report::page_template();  // told before the work, not after it
  catch_interrupts();
  const auto result = study::run(std::move(plan), follow(console));
  console.wipe();
  if (!result) {
    console.line("stopped: nothing was written");
    return kSignalled + interrupted();
  }
  tell_notices(result->stiffness, result->preset_unit(), console);
  tell_notices(result->speed, result->preset_unit(), console);
  tell_notices(result->preset_step, result->preset_unit(), console);
  const std::filesystem::path out = options.out.empty() ? "characterize_" + options.type : options.out;
  make_directory(out, "--out");
  const auto files = write_characterization(*result, command_of(options), out);
  tell_of_others(out, files, console);
  std::cout << characterization_text(*result) << "written: " << (out / files.front()).string();
  std::cout << fmt::format(" and {} more files in {}\n", files.size() - 1, out.string());
  return kDone;
}

void setup_characterize(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CharacterizeOptions>();
  CLI::App* sub = app.add_subcommand("characterize", "Measure an actuator type as the paper measured its hardware");
  sub->add_option("TYPE", options->type, "Actuator type, see vsa actuators")->required();
  sub->add_option("--experiment", options->experiments, "Which to run; default: all")
      ->check(CLI::IsMember({"stiffness", "speed", "preset-step"}));
  sub->add_option(
         "--preset-rad", options->preset_rad,
         "Stiffness presets, in the type's own unit; default: 0 0.4602 0.6903 for stiffness, 0 0.1125 0.3 0.75 for speed, 0.75 for "
         "preset-step, or such shares of what its motors wind to; preset-step takes the largest")
      ->check(number_given());
  sub->add_option("--period-s", options->period_s, "Period of the stiffness sweep; default 38")->check(number_given());
  sub->add_option("--amplitude-rad", options->amplitude_rad,
                  "Amplitude of the stiffness sweep; default: the shaft reaches 94° at preset 0, 81° at 0.6903 rad")
      ->check(number_given());
  sub->add_option("--cycles", options->cycles, "Cycles of the stiffness sweep after the first, which is left out; default 4")
      ->check(number_given());
  sub->add_option("--load-kg", options->load_kg, "Mass on the load bench's lever; default: 1, or what the joint carries")
      ->check(number_given());
  sub->add_option("--step-s", options->step_s, "Simulated seconds per step; default 0.001, the benches' own")
      ->check(number_given());
  sub->add_option("--set", options->set, "Override a parameter: key=value")->allow_extra_args(false);
  sub->add_option("--out", options->out, "Directory for the files; default: characterize_TYPE");
  sub->footer(kCharacterizeNotes);
  sub->callback([options, &exit_code] { exit_code = run_characterize(*options); });
}

}  // namespace vsa::app
