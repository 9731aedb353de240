// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linearize/page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "linearize/tables.hpp"
#include "vsa/report/sliding.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using linear::Response;
using report::Chart;
using report::Curve;
using report::Table;

/// A curve over the frequencies.
template <class Value>
Curve over_frequency(const study::Linearization& l, const char* name, int color, Value value) {
  Curve out = report::curve(name, {}, {}, Curve::Style::line, color);
  for (const Response& r : l.responses) {
    out.x.push_back(r.frequency_Hz);
    out.y.push_back(value(r));
  }
  return out;
}

bool linear_shaft(const study::Linearization& l) { return l.actuator.unit.actuator.linear(); }

std::vector<report::Chart> charts(const study::Linearization& l) {
  const auto magnitude = [](const Response& r) { return std::abs(r.impedance); };
  const double m = l.model.inertia_kgm2;
  Curve inertia = over_frequency(l, "inertia alone", -1, [m](const Response& r) { return 2 * kPi * r.frequency_Hz * m; });
  inertia.style = Curve::Style::dashed;
  return {bode("Impedance", "|Z| [N·m·s/rad]", true, {over_frequency(l, "unit and load", 0, magnitude), std::move(inertia)},
               "Torque at the shaft over its speed, with inertia and damping of what it turns."),
          bode("Phase of the impedance", "arg Z [°]", false,
               {over_frequency(l, "Phase of the impedance", 0, [](const Response& r) { return degrees(r.impedance); })},
               "−90°: a spring; 0°: a damper; 90°: an inertia."),
          bode("Stiffness at the shaft", "stiffness [N·m/rad]", false,
               {over_frequency(l, "Stiffness at the shaft", 1, [](const Response& r) { return r.stiffness_Nm_per_rad; })},
               "Of the actuator alone: the real part of torque over angle without the load's inertia and damping."),
          bode("Damping at the shaft", "damping [N·m·s/rad]", false,
               {over_frequency(l, "Damping at the shaft", 2, [](const Response& r) { return r.damping_Nms_per_rad; })},
               "Of the actuator alone: the real part of torque over speed, likewise.")};
}

Table point_table(const study::Linearization& l) {
  const linear::Model& m = l.model;
  const elastic::Transmission& law = *l.actuator.unit.actuator.transmission;
  const elastic::EquilibriumPreset attained = law.attained(m.rest.at.x);
  Table out{"Point", {"", "value", "unit"}, {}, ""};
  const auto row = [&out](std::string what, double value, const char* unit) {
    out.rows.push_back({std::move(what), digits(value), unit});
  };
  row("shaft", m.rest.at.q, "rad");
  row("equilibrium", attained.equilibrium, "rad");
  if (!law.preset_unit().empty()) row("preset", attained.preset, std::string(law.preset_unit()).c_str());
  row("load torque that holds it", m.rest.load_Nm, "N·m");
  row("inertia", m.inertia_kgm2, "kg·m²");
  row("damping of the load", m.damping_Nms_per_rad, "N·m·s/rad");
  for (int i = 0; i < law.motor_count(); ++i) row(fmt::format("motor {} voltage", i + 1), m.rest.motor_V[i], "V");
  row("stiffness, pulleys held", m.held_stiffness_Nm_per_rad, "N·m/rad");
  row("stiffness at rest", m.static_stiffness_Nm_per_rad, "N·m/rad");
  if (linear_shaft(l)) out = report::sliding(std::move(out));
  out.caption = "At rest the motors yield as the firmware lets them; frozen and without dry friction they hold nothing.";
  return out;
}

}  // namespace

report::Report linearization_report(const study::Linearization& l, const std::string& command) {
  report::Report out;
  out.title = l.actuator.title + ", linearised";
  out.subtitle = fmt::format("Firmware {}, dry friction {}", study::word(l.firmware), study::word(l.friction));
  report::Section point{"Point and poles", {}};
  for (const std::string& notice : l.model.notices) point.blocks.emplace_back(report::Text{notice});
  point.blocks.emplace_back(point_table(l));
  point.blocks.emplace_back(pole_table(l.poles, l.model.period_s, {}));
  std::vector<report::Block> response;
  for (Chart& chart : charts(l)) response.emplace_back(linear_shaft(l) ? report::sliding(std::move(chart)) : std::move(chart));
  out.sections = {std::move(point), {"Frequency response", std::move(response)}, {"Matrices", matrix_tables(l.model)}};
  out.footer = command + " · vsa " VSA_VERSION;
  return out;
}

std::string linearization_text(const study::Linearization& l) {
  return fmt::format("{}, firmware {}, dry friction {}\n", l.actuator.title, study::word(l.firmware), study::word(l.friction)) +
         table_lines(point_table(l)) + table_lines(pole_table(l.poles, l.model.period_s, {})) + '\n';
}

}  // namespace vsa::app
