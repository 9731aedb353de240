// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "study/linear_shaft.hpp"
#include "study/preset_steps.hpp"
#include "vsa/errors.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::study {
namespace {

// The paper's, of which 0.75 counts as 100 %.
const std::vector<double> kStiffnessPresets{0, 0.4602, 0.6903};
const std::vector<double> kSpeedPresets{0, 0.1125, 0.30, 0.75};
constexpr double kFull = 0.75;

/// All smaller in proportion where the unit's limit is below the largest.
std::vector<double> fitted(std::vector<double> presets, double limit) {
  const double factor = std::min(1.0, limit / presets.back());
  for (double& p : presets) p *= factor;
  return presets;
}

class Planner {
 public:
  explicit Planner(const CharacterizationOptions& options) : options_(options) {
    plan_.specimen = options.specimen;
    plan_.actuator = plan_.specimen.library.load(plan_.specimen.type, plan_.specimen.overrides);
    mount(plan_);
    has_preset_ = !plan_.preset_unit().empty();
  }

  Characterization plan() {
    check_presets();
    check_sweep();
    if (wants(Experiment::preset_step) && !has_preset_ && !options_.experiments.empty()) {
      add("--experiment", word(Experiment::preset_step), plan_.specimen.type + " has no stiffness preset to step",
          "stiffness, speed");
    }
    problems_.throw_if_any();
    plan_.fit = fit_bench(plan_.specimen, plan_.actuator, options_.load_kg);  // of 1 kg
    check_carried();
    problems_.throw_if_any();
    if (wants(Experiment::stiffness)) add_stiffness();
    if (wants(Experiment::speed)) add_speed();
    if (wants(Experiment::preset_step) && has_preset_) add_preset_step();
    if (plan_.stiffness.empty() && plan_.speed.empty() && plan_.preset_step.empty())
      add("--experiment", word(Experiment::preset_step), "the motors of " + plan_.specimen.type + " wind its springs to no preset",
          "stiffness, speed");
    problems_.throw_if_any();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] bool wants(Experiment name) const {
    const auto& e = options_.experiments;
    return e.empty() || std::find(e.begin(), e.end(), name) != e.end();
  }

  void add(std::string key, std::string value, std::string message, std::string allowed) {
    problems_.add({"", std::move(key), std::move(value), std::move(message), std::move(allowed)});
  }

  void check_presets() {
    const double limit = plan_.actuator.unit.preset_max;
    if (!has_preset_ && !options_.preset.empty()) {
      add("--preset-rad", fmt::format("{}", fmt::join(options_.preset, " ")), plan_.specimen.type + " has no stiffness preset",
          "leave it out");
      return;
    }
    std::set<std::string> names;
    for (const double p : options_.preset) {
      if (!(p >= 0 && p <= limit)) {
        add("--preset-rad", fmt::format("{}", p), "beyond what " + plan_.specimen.type + " accepts",
            fmt::format("0 … {} {}", limit, plan_.preset_unit()));
      } else if (!names.insert(fmt::format("{:.4f}", p)).second) {
        add("--preset-rad", fmt::format("{}", p), "is there twice; files are named by four decimals", "different presets");
      }
    }
    const auto& given = options_.preset;
    if (wants(Experiment::preset_step) && !given.empty() && *std::max_element(given.begin(), given.end()) == 0 &&
        !options_.experiments.empty()) {
      add("--preset-rad", "0", "a preset-step from 0 to 0 is none", "a preset above 0");
    }
  }

  void check_sweep() {
    const auto lone = [&](bool given, const char* flag) {
      if (given && !wants(Experiment::stiffness))
        add(flag, "", "belongs to the stiffness experiment, which isn't run", "--experiment stiffness");
    };
    lone(options_.period_s.has_value(), "--period-s");
    lone(options_.amplitude_rad.has_value(), "--amplitude-rad");
    lone(options_.cycles.has_value(), "--cycles");
    if (options_.load_kg && !wants(Experiment::stiffness) && !wants(Experiment::preset_step))
      add("--load-kg", fmt::format("{}", *options_.load_kg), "the speed experiment has no load",
          "--experiment stiffness, preset-step");
    const auto require = [&](const auto& value, const char* flag, double least, double most, const char* unit) {
      if (value && !(*value >= least && *value <= most)) {
        add(flag, fmt::format("{}", *value), "out of range", fmt::format("{} … {} {}", least, most, unit));
      }
    };
    require(options_.period_s, "--period-s", 1, 3600, "s");
    require(options_.amplitude_rad, "--amplitude-rad", 0.01, 3, "rad");
    require(options_.cycles, "--cycles", 1, 1000, "cycles");
    require(options_.load_kg, "--load-kg", 1e-3, 1e3, "kg");
  }

  /// A sweep finds its amplitude by what the law carries.
  void check_carried() {
    if (!wants(Experiment::stiffness) || options_.amplitude_rad) return;
    if (options_.load_kg) check_load();
    for (const double p : options_.preset) {
      if (p >= plan_.fit.softest) continue;
      add("--preset-rad", fmt::format("{}", p), "the joint is too soft there for the load bench",
          fmt::format("{:.3g} {} or more; or --amplitude-rad", plan_.fit.softest, plan_.preset_unit()));
    }
  }

  void check_load() {
    const double load_Nm = *options_.load_kg * experiment::bench_load_peak_Nm(plan_.specimen);  // of 1 kg
    for (const double p : presets(kStiffnessPresets, true)) {
      try {
        const double angle = experiment::sweep_target_rad(p, plan_.preset_unit());
        (void)experiment::law_deflection(*plan_.actuator.unit.actuator.transmission, p, load_Nm * std::sin(angle));
      } catch (const InputError& error) {
        const Problem& law = error.problems().front();
        add("--load-kg", fmt::format("{}", *options_.load_kg), law.message, law.allowed);
        return;
      }
    }
  }

  /// The given ones, else the usual ones as the actuator can have them. `on_bench`: that carry the load.
  [[nodiscard]] std::vector<double> presets(const std::vector<double>& usual, bool on_bench) const {
    if (!has_preset_) return {0.0};
    if (!options_.preset.empty()) return options_.preset;
    if (plan_.fit.papers_law) return fitted(usual, plan_.actuator.unit.preset_max);
    std::vector<double> out;
    for (const double p : usual) {
      const double share = p / kFull, here = on_bench ? carried_preset(plan_.fit, share) : share * plan_.fit.full;
      if (out.empty() || here > out.back() + 1e-4 * plan_.actuator.unit.preset_max) out.push_back(here);
    }
    return out;
  }

  void add_stiffness() {
    for (const double p : presets(kStiffnessPresets, true)) {
      experiment::StiffnessOptions o;
      o.preset = p;
      o.period_s = options_.period_s.value_or(o.period_s);
      o.amplitude_rad = options_.amplitude_rad;
      o.cycles = options_.cycles.value_or(static_cast<int>(o.cycles));
      o.load_share = plan_.fit.load_share;
      plan_.stiffness.emplace_back().options = o;
    }
  }

  void add_speed() {
    for (const double p : presets(kSpeedPresets, false)) plan_.speed.emplace_back().options.preset = p;
  }

  void add_preset_step() {
    const std::vector<double> all = presets({kFull}, false);
    plan_preset_steps(plan_, *std::max_element(all.begin(), all.end()));
  }

  const CharacterizationOptions& options_;
  Characterization plan_;
  Problems problems_;
  bool has_preset_ = true;
};

}  // namespace

const char* word(Experiment experiment) {
  switch (experiment) {
    case Experiment::stiffness:
      return "stiffness";
    case Experiment::speed:
      return "speed";
    case Experiment::preset_step:
      return "preset-step";
  }
  return "";
}

void plan_preset_steps(Characterization& plan, double preset) {
  const BenchFit& fit = plan.fit;
  if (preset == 0) return;
  plan.preset_step.emplace_back().options.preset = preset;
  const double loaded = fit.papers_law ? preset : std::min(preset, fit.stiffest);
  if (!fit.carries || !(loaded > fit.softest)) return;
  experiment::PresetStepOptions& o = plan.preset_step.emplace_back().options;
  o.preset = loaded;
  o.from = fit.softest;
  o.loaded = true;
  o.load_share = fit.load_share;
}

Characterization plan_characterization(const CharacterizationOptions& options) { return Planner(options).plan(); }

}  // namespace vsa::study
