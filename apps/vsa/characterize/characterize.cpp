// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "characterize/characterize.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <set>

#include "characterize/output.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/output_files.hpp"
#include "terminal/settings.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

constexpr const char* kStiffness = "stiffness";
constexpr const char* kSpeed = "speed";
constexpr const char* kPresetStep = "preset-step";

constexpr const char* kNotes = R"(Experiments, on the worlds bench_load and bench_free (the paper, section IV):
  stiffness    slow sinusoidal sweep of the equilibrium with 1 kg on a 0.15 m lever: torque-deflection loop, stiffness
  speed        square wave of the equilibrium, 1.57 rad, no load: rise time, speed, overshoot, ringing
  preset-step  the preset from 0 to its largest value and back, without load and with the lever held out

Writes report.html, results.json and a CSV file for each run. An actuator without a stiffness preset has no
--preset-rad and no preset-step.

Examples:
  vsa characterize qbmove_maker_pro
  vsa characterize qbmove_maker_pro --experiment stiffness --preset-rad 0 0.2 0.4 --period-s 76 --out slow
  vsa characterize qbmove_maker_pro --set drive.supply_V=24)";

const std::vector<double> kStiffnessPresets{0, 0.4602, 0.6903};
const std::vector<double> kSpeedPresets{0, 0.1125, 0.30, 0.75};
constexpr double kStepPreset = 0.75;

/// The paper's presets; all smaller in proportion where the unit's limit is below the largest.
std::vector<double> fitted(std::vector<double> presets, double limit) {
  const double factor = std::min(1.0, limit / presets.back());
  for (double& p : presets) p *= factor;
  return presets;
}

class Planner {
 public:
  explicit Planner(const CharacterizeOptions& options) : options_(options) {
    plan_.specimen.preset = options.preset;
    plan_.specimen.overrides = parse_settings(options.set, "--set");
    plan_.actuator = plan_.specimen.library.load(options.preset, plan_.specimen.overrides);
    has_preset_ = !plan_.preset_unit().empty();
  }

  Characterization plan() {
    check_presets();
    check_sweep();
    if (wants(kPresetStep) && !has_preset_ && !options_.experiments.empty()) {
      add("--experiment", kPresetStep, options_.preset + " has no stiffness preset to step", "stiffness, speed");
    }
    problems_.throw_if_any();
    if (wants(kStiffness)) add_stiffness();
    if (wants(kSpeed)) add_speed();
    if (wants(kPresetStep) && has_preset_) add_preset_step();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] bool wants(const char* name) const {
    const auto& e = options_.experiments;
    return e.empty() || std::find(e.begin(), e.end(), name) != e.end();
  }

  void add(std::string key, std::string value, std::string message, std::string allowed) {
    problems_.add({"", std::move(key), std::move(value), std::move(message), std::move(allowed)});
  }

  void check_presets() {
    const double limit = plan_.actuator.unit.preset_max;
    if (!has_preset_ && !options_.preset_rad.empty()) {
      add("--preset-rad", fmt::format("{}", fmt::join(options_.preset_rad, " ")), options_.preset + " has no stiffness preset",
          "leave it out");
      return;
    }
    std::set<std::string> names;
    for (const double p : options_.preset_rad) {
      if (!(p >= 0 && p <= limit)) {
        add("--preset-rad", fmt::format("{}", p), "beyond what " + options_.preset + " accepts", fmt::format("0 … {} rad", limit));
      } else if (!names.insert(fmt::format("{:.4f}", p)).second) {
        add("--preset-rad", fmt::format("{}", p), "is there twice; files are named by four decimals", "different presets");
      }
    }
    const auto& given = options_.preset_rad;
    if (wants(kPresetStep) && !given.empty() && *std::max_element(given.begin(), given.end()) == 0 &&
        !options_.experiments.empty()) {
      add("--preset-rad", "0", "a preset-step from 0 to 0 is none", "a preset above 0");
    }
  }

  void check_sweep() {
    const auto lone = [&](bool given, const char* flag) {
      if (given && !wants(kStiffness))
        add(flag, "", "belongs to the stiffness experiment, which isn't run", "--experiment stiffness");
    };
    lone(options_.period_s.has_value(), "--period-s");
    lone(options_.amplitude_rad.has_value(), "--amplitude-rad");
    lone(options_.cycles.has_value(), "--cycles");
    const auto require = [&](const auto& value, const char* flag, double least, double most, const char* unit) {
      if (value && !(*value >= least && *value <= most)) {
        add(flag, fmt::format("{}", *value), "out of range", fmt::format("{} … {} {}", least, most, unit));
      }
    };
    require(options_.period_s, "--period-s", 1, 3600, "s");
    require(options_.amplitude_rad, "--amplitude-rad", 0.01, 3, "rad");
    require(options_.cycles, "--cycles", 1, 1000, "cycles");
  }

  [[nodiscard]] std::vector<double> presets(const std::vector<double>& usual) const {
    if (!has_preset_) return {0.0};
    return options_.preset_rad.empty() ? fitted(usual, plan_.actuator.unit.preset_max) : options_.preset_rad;
  }

  void add_stiffness() {
    for (const double p : presets(kStiffnessPresets)) {
      experiment::StiffnessOptions o;
      o.preset = p;
      o.period_s = options_.period_s.value_or(o.period_s);
      o.amplitude_rad = options_.amplitude_rad;
      o.cycles = options_.cycles.value_or(static_cast<int>(o.cycles));
      plan_.stiffness.emplace_back().options = o;
    }
  }

  void add_speed() {
    for (const double p : presets(kSpeedPresets)) plan_.speed.emplace_back().options.preset = p;
  }

  void add_preset_step() {
    const std::vector<double> all = presets({kStepPreset});
    const double largest = *std::max_element(all.begin(), all.end());
    if (largest == 0) return;
    for (const bool loaded : {false, true}) {
      experiment::PresetStepOptions& o = plan_.preset_step.emplace_back().options;
      o.preset = largest;
      o.loaded = loaded;
    }
  }

  const CharacterizeOptions& options_;
  Characterization plan_;
  Problems problems_;
  bool has_preset_ = true;
};

/// The command again, with what was given.
std::string command_of(const CharacterizeOptions& o) {
  std::string out = "vsa characterize " + o.preset;
  for (const auto& e : o.experiments) out += " --experiment " + e;
  if (!o.preset_rad.empty()) out += fmt::format(" --preset-rad {}", fmt::join(o.preset_rad, " "));
  if (o.period_s) out += fmt::format(" --period-s {}", *o.period_s);
  if (o.amplitude_rad) out += fmt::format(" --amplitude-rad {}", *o.amplitude_rad);
  if (o.cycles) out += fmt::format(" --cycles {}", *o.cycles);
  for (const auto& s : o.set) out += " --set " + s;
  return out;
}

template <class Results>
void tell_notices(const Results& results, const std::string& unit, Console& console) {
  for (const auto& r : results) {
    for (const std::string& n : r.run.notices) {
      console.line(unit.empty() ? "warning: " + n : fmt::format("warning: preset {} {}: {}", r.options.preset, unit, n));
    }
  }
}

}  // namespace

int run_characterize(const CharacterizeOptions& options) {
  Console console;
  Characterization plan = Planner(options).plan();
  catch_interrupts();
  const auto result = run_plan(std::move(plan), console);
  if (!result) {
    console.line("stopped: nothing was written");
    return kSignalled + interrupted();
  }
  tell_notices(result->stiffness, result->preset_unit(), console);
  tell_notices(result->speed, result->preset_unit(), console);
  tell_notices(result->preset_step, result->preset_unit(), console);
  const std::filesystem::path out = options.out.empty() ? "characterize_" + options.preset : options.out;
  make_directory(out, "--out");
  const auto files = write_characterization(*result, command_of(options), out);
  std::cout << characterization_text(*result) << "written: " << (out / files.front()).string();
  std::cout << fmt::format(" and {} more files in {}\n", files.size() - 1, out.string());
  return std::cout.flush() ? kDone : kFailed;
}

void setup_characterize(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CharacterizeOptions>();
  CLI::App* sub = app.add_subcommand("characterize", "Measure an actuator preset as the paper measured its hardware");
  sub->add_option("PRESET", options->preset, "Actuator preset, see vsa actuators")->required();
  sub->add_option("--experiment", options->experiments, "Which to run; default: all")
      ->check(CLI::IsMember({kStiffness, kSpeed, kPresetStep}));
  sub->add_option("--preset-rad", options->preset_rad,
                  "Stiffness presets; default: 0 0.4602 0.6903 for stiffness, 0 0.1125 0.3 0.75 for speed, 0.75 for preset-step; "
                  "preset-step takes the largest")
      ->check(number_given());
  sub->add_option("--period-s", options->period_s, "Period of the stiffness sweep; default 38")->check(number_given());
  sub->add_option("--amplitude-rad", options->amplitude_rad,
                  "Amplitude of the stiffness sweep; default: the shaft reaches 94° at preset 0, 81° at 0.6903 rad")
      ->check(number_given());
  sub->add_option("--cycles", options->cycles, "Cycles of the stiffness sweep after the first, which is left out; default 4")
      ->check(number_given());
  sub->add_option("--set", options->set, "Override a parameter: key=value");
  sub->add_option("--out", options->out, "Directory for the files; default: characterize_PRESET");
  sub->footer(kNotes);
  sub->callback([options, &exit_code] { exit_code = run_characterize(*options); });
}

}  // namespace vsa::app
