// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "datasheet/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "terminal/table.hpp"
#include "vsa/report/sliding.hpp"

namespace vsa::app {
namespace {

std::string overridden(const study::DataSheet& d) {
  std::string out;
  std::vector<config::Override> given = d.simulated.specimen.overrides;
  if (d.simulated.linear()) given.pop_back();  // the bench's pinion
  for (const config::Override& o : given) out += (out.empty() ? " with " : ", ") + o.key + " = " + o.value;
  return out;
}

/// "linear_beyond_rad" → "linear beyond": the unit stands beside the value.
std::string symbol(std::string key) {
  for (const std::string_view suffix : {"_Nm_per_rad3", "_Nm_per_rad2", "_Nm_per_rad", "_m_per_rad2", "_m_per_rad", "_N_per_m3",
                                        "_N_per_m", "_per_rad", "_Nm", "_rad", "_m"}) {
    if (key.size() <= suffix.size() || key.compare(key.size() - suffix.size(), suffix.size(), suffix) != 0) continue;
    key.resize(key.size() - suffix.size());
    break;
  }
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

/// The law's equation where we know it; its parameters always.
std::string law_text(const config::ActuatorType& type) {
  std::string out = "Elastic law " + type.law;
  for (const elastic::Law* law : elastic::laws())
    if (law->name == type.law) out += fmt::format(" ({}): {}", law->title, law->equation);
  std::string with;
  for (const config::Entry& e : type.entries) {
    if (e.key.rfind("elastic.", 0) != 0 || e.unit.empty()) continue;
    with +=
        fmt::format("{}{} = {}{}", with.empty() ? "; " : ", ", symbol(e.key.substr(8)), e.value, e.unit == "1" ? "" : " " + e.unit);
  }
  return out + with + ".";
}

/// What is told of the shaft, as the actuator has it.
template <class T>
T told(const study::DataSheet& d, T words) {
  return d.simulated.linear() ? report::sliding(std::move(words)) : words;
}

std::string how_text(const study::DataSheet& d) {
  const std::string pinion = d.simulated.linear() ? fmt::format(", where it turns a pinion of {:g} m", study::kBenchPinion_m) : "";
  return fmt::format(
      "law: from the spring's equation; drive: from the motors' parameters at {} V; simulation: from runs on the benches, as vsa "
      "characterize does them{}. Steady values at full voltage: no parameter tells what the motors may give for long, nor size.",
      number(d.computed.type.unit.actuator.supply_V), pinion);
}

}  // namespace

std::string number(double value) {
  constexpr double kRounding = 1e-12;  // what is left of a stiffness where the law gives way
  if (!std::isfinite(value)) return "–";
  const double digits = std::abs(value) >= 1000 ? std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2) : 0;
  if (digits > 0 && std::abs(value) < 1e6) return fmt::format("{:.0f}", std::round(value / digits) * digits);
  return fmt::format("{:.3g}", std::abs(value) < kRounding ? 0.0 : value);
}

bool lopsided(const study::DataSheet& d) {
  const auto differ = [](const experiment::PresetColumn& c) {
    return number(c.peak.torque_Nm) != number(c.back.peak.torque_Nm) ||
           number(c.no_load_speed_rad_per_s) != number(c.back.no_load_speed_rad_per_s);
  };
  return std::any_of(d.computed.columns.begin(), d.computed.columns.end(), differ);
}

report::Report data_sheet_report(const study::DataSheet& d, const std::string& command) {
  const config::ActuatorType& p = d.computed.type;
  report::Report out;
  out.title = p.title;
  out.subtitle = "Data sheet of the simulated actuator " + p.name + (p.rank.empty() ? "" : ", " + p.rank) + overridden(d);
  out.one_page = true;
  std::string about = p.description.empty() ? "" : p.description + " ";
  report::Section head{"", {report::Text{about + law_text(p)}, report::Figures{told(d, key_figures(d))}}};
  report::Section curves{"", sheet_charts(d)};
  for (report::Block& block : curves.blocks)
    if (auto* chart = std::get_if<report::Chart>(&block)) *chart = told(d, std::move(*chart));
  report::Section tables{"", {}};
  if (d.has_preset()) tables.blocks.push_back(told(d, preset_table(d)));
  report::Section operating{"", {told(d, mechanical_table(d)), electrical_table(d)}};
  out.sections = {std::move(head), std::move(curves)};
  if (!tables.blocks.empty()) out.sections.push_back(std::move(tables));
  out.sections.push_back(std::move(operating));
  out.footer = how_text(d) + "\n" + command + " · vsa " VSA_VERSION;
  return out;
}

std::string data_sheet_text(const study::DataSheet& d) {
  std::string out = d.computed.type.title + "\n\n";
  std::vector<report::Table> tables{told(d, mechanical_table(d)), electrical_table(d)};
  if (d.has_preset()) tables.insert(tables.begin(), told(d, preset_table(d)));
  for (const report::Table& t : tables) {
    std::vector<std::vector<std::string>> rows{t.head};
    rows.insert(rows.end(), t.rows.begin(), t.rows.end());
    out += t.title + "\n" + table_text(rows, terminal_width()) + "\n";
  }
  return out;
}

}  // namespace vsa::app
