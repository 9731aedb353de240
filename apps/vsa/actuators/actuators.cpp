// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "actuators/actuators.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "terminal/exit_codes.hpp"
#include "terminal/table.hpp"
#include "vsa/config/preset.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/transmission.hpp"

namespace vsa::app {
namespace {

constexpr std::size_t kReadableWidth = 100;  // of running text on a terminal that is wider

/// σ of the unloaded actuator at a preset: at the equilibrium where its shaft rests.
double stiffness_at_rest(const elastic::Transmission& law, double preset) {
  const auto x = law.references({0.0, preset});
  return law.evaluate({law.attained(x).equilibrium, x}).curvature.qq;
}

std::string stiffness_text(const device::UnitConfig& unit) {
  const elastic::Transmission& law = *unit.actuator.transmission;
  const double soft = stiffness_at_rest(law, 0.0);
  if (law.preset_unit().empty()) return fmt::format("{:.3g} N·m/rad", soft);
  const double stiff = stiffness_at_rest(law, unit.preset_max);
  return fmt::format("{:.3g} … {:.3g} N·m/rad", soft, stiff);
}

std::string preset_text(const device::UnitConfig& unit) {
  const std::string_view preset_unit = unit.actuator.transmission->preset_unit();
  return preset_unit.empty() ? "none" : fmt::format("up to {} {}", unit.preset_max, preset_unit);
}

int list(const config::PresetLibrary& library) {
  Problems problems;
  std::vector<std::vector<std::string>> rows{{"preset", "law", "stiffness preset", "stiffness at rest", "title"}};
  for (const std::string& name : library.names()) {
    try {
      const config::Preset p = library.load(name);
      rows.push_back({p.name, p.law, preset_text(p.unit), stiffness_text(p.unit), p.title});
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  if (library.names().empty()) {
    std::string places;
    for (const auto& d : library.directories()) places += (places.empty() ? "" : ", ") + d.string();
    problems.add({"", "presets", "", "no presets found in " + places, "set VSA_PRESET_PATH or VSA_DATA_DIR"});
  }
  if (rows.size() > 1) std::cout << table_text(rows, terminal_width());
  const bool written = static_cast<bool>(std::cout.flush());
  problems.throw_if_any();
  return written ? kDone : kFailed;
}

std::string evidence_text(const std::optional<config::Evidence>& evidence) {
  if (!evidence) return "not told";
  return (evidence->calibrated_on.empty() ? "nothing" : config::join(evidence->calibrated_on)) + ": " + evidence->source;
}

int show(const config::Preset& preset) {
  const std::size_t width = terminal_width();
  const std::size_t text_width = width == 0 ? 0 : std::min(width, kReadableWidth);
  std::cout << preset.title << '\n';
  for (const std::string& line : wrap(preset.description, text_width)) std::cout << line << '\n';
  std::cout << fmt::format("file: {}\nelastic law: {}, {} at rest, preset {}\n", preset.file.string(), preset.law,
                           stiffness_text(preset.unit), preset_text(preset.unit));
  for (const std::string& line : wrap("calibrated on " + evidence_text(preset.evidence), text_width)) std::cout << line << '\n';
  std::cout << '\n';
  std::vector<std::vector<std::string>> rows{{"parameter", "value", "unit", "bounds", "source"}};
  for (const config::Entry& e : preset.entries) rows.push_back({e.key, e.value, e.unit, e.bounds, e.source});
  std::cout << table_text(rows, width);
  return std::cout.flush() ? kDone : kFailed;
}

}  // namespace

void setup_actuators(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ActuatorsOptions>();
  CLI::App* sub = app.add_subcommand("actuators", "list the actuator presets, or print one with units, bounds and sources");
  sub->add_option("PRESET", options->name, "preset to print");
  sub->callback([options, &exit_code] { exit_code = run_actuators(*options); });
}

int run_actuators(const ActuatorsOptions& options) {
  const config::PresetLibrary library;
  return options.name.empty() ? list(library) : show(library.load(options.name));
}

}  // namespace vsa::app
