// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "vsa/errors.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::study {
namespace {

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
  explicit Planner(const CharacterizationOptions& options) : options_(options) {
    plan_.specimen = options.specimen;
    plan_.actuator = plan_.specimen.library.load(plan_.specimen.type, plan_.specimen.overrides);
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
    if (wants(Experiment::stiffness)) add_stiffness();
    if (wants(Experiment::speed)) add_speed();
    if (wants(Experiment::preset_step) && has_preset_) add_preset_step();
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
            fmt::format("0 … {} rad", limit));
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
    return options_.preset.empty() ? fitted(usual, plan_.actuator.unit.preset_max) : options_.preset;
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

Characterization plan_characterization(const CharacterizationOptions& options) { return Planner(options).plan(); }

}  // namespace vsa::study
