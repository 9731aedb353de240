// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "actuators/actuators.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "actuators/laws.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/table.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/inverse.hpp"
#include "vsa/elastic/transmission.hpp"

namespace vsa::app {
namespace {

constexpr std::size_t kReadableWidth = 100;  // of running text on a terminal that is wider

/// σ of the unloaded actuator at a stiffness preset: where its shaft rests.
double stiffness_of(const elastic::Transmission& law, double preset) {
  const auto x = law.references({0.0, preset});
  return law.evaluate({elastic::rest_under(law, x).value_or(law.attained(x).equilibrium), x}).curvature.qq;
}

std::string stiffness_text(const device::UnitConfig& unit) {
  const elastic::Transmission& law = *unit.actuator.transmission;
  const double soft = stiffness_of(law, 0.0);
  if (law.preset_unit().empty()) return fmt::format("{:.3g} {}", soft, unit.actuator.linear() ? "N/m" : "N·m/rad");
  const double stiff = stiffness_of(law, unit.preset_max);
  return fmt::format("{:.3g} … {:.3g} {}", soft, stiff, unit.actuator.linear() ? "N/m" : "N·m/rad");
}

std::string preset_text(const device::UnitConfig& unit) {
  const std::string_view preset_unit = unit.actuator.transmission->preset_unit();
  return preset_unit.empty() ? "none" : fmt::format("up to {} {}", unit.preset_max, preset_unit);
}

int list(const config::TypeLibrary& library) {
  Problems problems;
  std::vector<std::vector<std::string>> rows{{"type", "rank", "law", "stiffness preset", "stiffness at rest", "title"}};
  for (const std::string& name : library.names()) {
    try {
      const config::ActuatorType p = library.load(name);
      rows.push_back({p.name, p.rank.empty() ? "–" : p.rank, p.law, preset_text(p.unit), stiffness_text(p.unit), p.title});
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  if (library.names().empty()) {
    std::string places;
    for (const auto& d : library.directories()) places += (places.empty() ? "" : ", ") + d.string();
    problems.add({"", "actuators", "", "no actuator types found in " + places, "set VSA_ACTUATOR_PATH or VSA_DATA_DIR"});
  }
  if (rows.size() > 1) std::cout << table_text(rows, terminal_width());
  std::cout.flush();
  problems.throw_if_any();
  return kDone;
}

std::string rank_text(const config::ActuatorType& type) {
  const std::string_view what = type.rank == "measured"    ? "recordings of the hardware, and how well it predicts them"
                                : type.rank == "published" ? "constants from public sources"
                                : type.rank == "symbolic"  ? "a law with numbers that something real could have"
                                                           : "its file doesn't say on what its numbers stand";
  return fmt::format("rank: {}, {}{}", type.rank.empty() ? "none" : type.rank, what,
                     type.base.empty() ? "" : "; what isn't its own is of " + type.base);
}

std::string evidence_text(const std::optional<config::Evidence>& evidence) {
  if (!evidence) return "nothing that the type names";
  return (evidence->calibrated_on.empty() ? "nothing" : config::join(evidence->calibrated_on)) + ": " + evidence->source;
}

/// A repair is a departure from the device, which a user asks for: while it is off there is nothing to tell.
bool repair_off(const config::Entry& e) {
  return e.kind == config::Kind::toggle && e.number == 0 && e.key.rfind("firmware.repair_", 0) == 0;
}

int show(const config::ActuatorType& type, bool all) {
  const std::size_t width = terminal_width();
  const std::size_t text_width = width == 0 ? 0 : std::min(width, kReadableWidth);
  std::cout << type.title << '\n';
  for (const std::string& line : wrap(type.description, text_width)) std::cout << line << '\n';
  std::cout << rank_text(type) << '\n';
  std::cout << fmt::format(
      "file: {}\nelastic law: {}, {} at rest, {}\n", type.file.string(), type.law, stiffness_text(type.unit),
      type.unit.actuator.transmission->preset_unit().empty() ? "no stiffness preset" : "preset " + preset_text(type.unit));
  if (type.controller != "qbmove") std::cout << fmt::format("controller: {}\n", type.controller);
  for (const std::string& remark : type.remarks)
    for (const std::string& line : wrap(remark, text_width)) std::cout << line << '\n';
  if (type.mass_kg) {
    for (const std::string& line : wrap(fmt::format("mass: {:g} kg, {}", type.mass_kg->value, type.mass_kg->source), text_width))
      std::cout << line << '\n';
  }
  for (const std::string& line : wrap("calibrated on " + evidence_text(type.evidence), text_width)) std::cout << line << '\n';
  std::cout << '\n';
  std::vector<std::vector<std::string>> rows{{"parameter", "value", "unit", "bounds", "source"}};
  std::size_t left_out = 0;
  for (const config::Entry& e : type.entries) {
    if (!all && repair_off(e)) {
      ++left_out;
    } else {
      rows.push_back({e.key, e.value, e.unit, e.bounds, e.source});
    }
  }
  std::cout << table_text(rows, width);
  if (left_out > 0) std::cout << fmt::format("and {} switches firmware.repair_…, all off (--all)\n", left_out);
  return kDone;
}

}  // namespace

void setup_actuators(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ActuatorsOptions>();
  CLI::App* sub = app.add_subcommand("actuators", "list the actuator types, or print one with units, bounds and sources");
  sub->add_option("TYPE", options->name, "type to print");
  sub->add_flag("--all", options->all, "With the repairs of the firmware that are off");
  CLI::Option* laws = sub->add_flag("--laws", options->laws, "The elastic laws that types may name, with their keys, instead");
  sub->add_option("--markdown", options->markdown, "Write these tables between their two marker lines of this file")
      ->type_name("FILE")
      ->needs(laws);
  laws->excludes("TYPE")->excludes("--all");
  sub->callback([options, &exit_code] { exit_code = run_actuators(*options); });
}

int run_actuators(const ActuatorsOptions& options) {
  if (options.laws) return run_laws(options.markdown);
  const config::TypeLibrary library;
  return options.name.empty() ? list(library) : show(library.load(options.name), options.all);
}

}  // namespace vsa::app
