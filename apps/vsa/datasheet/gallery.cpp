// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "datasheet/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "datasheet/page.hpp"

namespace vsa::app {
namespace {

using experiment::PresetColumn;

std::string span(double low, double high) {
  const std::string a = number(low), b = number(high);
  return a == b ? a : a + " … " + b;
}

/// Of the sheet's presets, the last one that the motors reach.
const PresetColumn& stiffest(const study::DataSheet& d) { return d.computed.columns.back(); }

std::string variation_time(const study::DataSheet& d) {
  const auto& steps = d.simulated.preset_step;
  return steps.empty() ? "–" : number(steps[0].up.rise_s);
}

}  // namespace

double holding_power_W(const device::UnitConfig& unit, double preset) {
  const elastic::Transmission& law = *unit.actuator.transmission;
  const auto x = law.references({0, preset});
  const elastic::Response r = law.evaluate({law.attained(x).equilibrium, x});
  double power = 0;
  for (std::size_t i = 0; i < unit.actuator.sides(); ++i) {
    const actuator::SideParams& side = unit.actuator.side[i];
    const drive::MotorParams motor = drive::at_pulley(side.motor, side.gearbox.ratio);
    const double friction = drive::at_pulley(side.gearbox.friction, side.gearbox.ratio).coulomb_Nm;
    const double beyond = std::max(0.0, std::abs(r.load[i]) - friction);
    power += std::pow(beyond / motor.torque_constant_Nm_per_A, 2) * motor.resistance_Ohm;
  }
  return power;
}

report::Table comparison_table(const std::vector<study::DataSheet>& sheets) {
  report::Table out{
      "Actuators beside each other",
      {"type", "rank", "law", "at rest [N·m/rad]", "torque [N·m]", "speed [rad/s]", "energy [J]", "stiffens in [s]", "held by [W]"},
      {},
      "At rest: stiffness from preset 0 to the largest that the motors wind to. Torque: begins to move it, at preset 0 / "
      "at the sheet's last. Speed: without load. Energy: the most that the motors load. Stiffens in: 10–90 % of the preset's "
      "way up without load, simulated. Held by: heat of the motors at the sheet's last preset without load, beyond what "
      "their friction holds."};
  for (const study::DataSheet& d : sheets) {
    const experiment::DataSheet& s = d.computed;
    const PresetColumn &soft = s.columns.front(), &stiff = stiffest(d);
    out.rows.push_back(
        {s.type.name, s.type.rank.empty() ? "–" : s.type.rank, s.type.law,
         span(soft.stiffness_at_rest_Nm_per_rad, d.has_preset() ? s.stiffest_Nm_per_rad : soft.stiffness_at_rest_Nm_per_rad),
         d.has_preset() ? number(soft.peak.torque_Nm) + " / " + number(stiff.peak.torque_Nm) : number(soft.peak.torque_Nm),
         number(soft.no_load_speed_rad_per_s), number(s.most_energy_J), variation_time(d),
         d.has_preset() ? number(holding_power_W(s.type.unit, stiff.preset)) : "–"});
  }
  return out;
}

report::Report comparison_page(const std::vector<study::DataSheet>& sheets, const std::string& command) {
  report::Chart stiffness, soft_curves, stiff_curves;
  stiffness.title = "Stiffness at rest";
  stiffness.x_label = "preset, of the largest that the motors reach [1]";
  stiffness.y_label = "stiffness [N·m/rad]";
  stiffness.y_log = true;
  soft_curves.title = "Torque over deflection, softest";
  stiff_curves.title = "Torque over deflection, stiffest";
  for (report::Chart* c : {&soft_curves, &stiff_curves}) {
    c->x_label = "deflection [rad]";
    c->y_label = "load [N·m]";
  }
  // Six colours, three times.
  const auto styled = [](std::string name, std::vector<double> x, std::vector<double> y, int i) {
    constexpr std::array kStyles{report::Curve::Style::line, report::Curve::Style::dashed, report::Curve::Style::markers};
    return report::curve(std::move(name), std::move(x), std::move(y), kStyles[static_cast<std::size_t>(i / 6) % kStyles.size()], i);
  };
  const auto curve_of = [&](const PresetColumn& column, const std::string& name, int color) {
    std::vector<double> x, y;
    for (const experiment::LawPoint& p : column.curve) {
      x.push_back(p.deflection_rad);
      y.push_back(p.load_Nm);
    }
    return styled(name, x, y, color);
  };
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const experiment::DataSheet& s = sheets[i].computed;
    const int color = static_cast<int>(i);
    soft_curves.curves.push_back(curve_of(s.columns.front(), s.type.name, color));
    if (!sheets[i].has_preset()) continue;
    stiff_curves.curves.push_back(curve_of(s.columns.back(), s.type.name, color));
    std::vector<double> x, y;
    for (const PresetColumn& c : s.columns) {
      x.push_back(c.preset / std::max(s.attainable_preset, 1e-9));
      y.push_back(c.stiffness_at_rest_Nm_per_rad);
    }
    stiffness.curves.push_back(styled(s.type.name, x, y, color));
  }
  report::Report out;
  out.title = "A family of actuators";
  out.subtitle = fmt::format("{} types; each has a data sheet of its name beside this page", sheets.size());
  out.sections = {{"", {comparison_table(sheets)}}, {"Curves", {stiffness, soft_curves, stiff_curves}}};
  out.footer =
      "Ranks: measured: recordings of the hardware; published: constants from public sources; symbolic: a law with numbers that "
      "something real could have.\n" +
      command + " · vsa " VSA_VERSION;
  return out;
}

}  // namespace vsa::app
