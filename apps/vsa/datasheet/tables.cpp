// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "datasheet/page.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using experiment::OneWay;
using experiment::PresetColumn;

constexpr const char* kDrive = "drive";
constexpr const char* kBoth = "law, drive";
constexpr const char* kSimulation = "simulation";
constexpr const char* kType = "type";
constexpr const char* kDevice = "electronics";

std::string range(double low, double high) { return low == -high ? "±" + number(high) : number(low) + " … " + number(high); }
std::string pair(double a, double b) { return number(a) + " / " + number(b); }

/// Speed at which the actuator still moves a load, along the boundary at its softest; NaN: it doesn't.
double speed_under(const OneWay& c, double load_Nm) {
  for (std::size_t i = 1; i < c.boundary.size(); ++i) {
    const auto &a = c.boundary[i - 1], &b = c.boundary[i];
    if (!(a.reach.torque_Nm >= load_Nm && b.reach.torque_Nm <= load_Nm)) continue;
    const double part = (a.reach.torque_Nm - load_Nm) / (a.reach.torque_Nm - b.reach.torque_Nm);
    return a.speed_rad_per_s + part * (b.speed_rad_per_s - a.speed_rad_per_s);
  }
  return std::nan("");
}

void add_preset_steps(const study::DataSheet& d, report::Table& out) {
  const std::string unit = d.preset_unit();
  for (const study::PresetStepResult& r : d.simulated.preset_step) {
    const std::string load = r.options.loaded ? fmt::format("{} N·m", number(r.run.load_peak_Nm)) : "no load";
    out.rows.push_back(
        {"stiffness variation time 10–90 %, " + load + ", up / down", pair(r.up.rise_s, r.down.rise_s), "s", kSimulation});
  }
  for (const study::PresetStepResult& r : d.simulated.preset_step) {
    const std::string load = r.options.loaded ? fmt::format("{} N·m", number(r.run.load_peak_Nm)) : "no load";
    out.rows.push_back(
        {fmt::format("preset attained of {} / left of {}, {}", number(r.options.preset), number(r.options.from), load),
         pair(r.up.final_value, r.down.final_value), unit, kSimulation});
  }
}

void add_speeds(const study::DataSheet& d, report::Table& out) {
  const auto& speeds = d.simulated.speed;
  const auto row = [&](const std::string& what, const std::string& unit, double experiment::StepMeasures::*field) {
    const double soft = speeds.front().mean.shaft.*field, stiff = speeds.back().mean.shaft.*field;
    const bool one = speeds.size() == 1;
    const std::string at = one ? "" : fmt::format(", preset 0 / {}", number(speeds.back().options.preset));
    out.rows.push_back({what + at, one ? number(soft) : pair(soft, stiff), unit, kSimulation});
  };
  const std::string step = fmt::format("{} rad step", number(speeds.front().options.step_rad));
  row(step + ", mean speed 10–90 %", "rad/s", &experiment::StepMeasures::mean_speed);
  row(step + ", overshoot", "%", &experiment::StepMeasures::overshoot_pct);
}

/// A number of each direction.
std::string of_ways(const PresetColumn& c, double (*value)(const OneWay&)) {
  return ways(c, [&](const OneWay& w) { return number(value(w)); });
}
constexpr auto kPeak = [](const OneWay& w) { return w.peak.torque_Nm; };
constexpr auto kUnpowered = [](const OneWay& w) { return w.unpowered.torque_Nm; };
constexpr auto kSpeed = [](const OneWay& w) { return w.no_load_speed_rad_per_s; };
constexpr auto kLag = [](const OneWay& w) { return w.peak.deflection_rad; };

/// Where the two directions differ, what the sheet's marks mean.
std::string marks(const study::DataSheet& d) { return lopsided(d) ? "(+q), (−q): driven that way. " : ""; }

/// What a sheet with presets has in a table of its own.
void add_columns(const PresetColumn& c, report::Table& out) {
  out.rows.push_back({"peak torque", of_ways(c, kPeak), "N·m", kBoth});
  out.rows.push_back({"torque held without current", of_ways(c, kUnpowered), "N·m", kBoth});
  out.rows.push_back({"no-load speed", of_ways(c, kSpeed), "rad/s", kDrive});
  out.rows.push_back({"deflection at peak torque", of_ways(c, kLag), "rad", kBoth});
  const auto held = [](const OneWay& w) { return pair(w.held_at_half.power_W, w.held_at_half.current_A); };
  out.rows.push_back({"power / current to hold half the peak torque", ways(c, held), "W / A", kBoth});
}

}  // namespace

std::vector<report::Figure> key_figures(const study::DataSheet& d) {
  const experiment::DataSheet& s = d.computed;
  const PresetColumn& soft = s.columns.front();
  const auto rpm = [](const OneWay& w) { return fmt::format("{:.0f}", w.no_load_speed_rad_per_s * 30 / kPi); };
  const auto best = [](const OneWay& w) {
    return fmt::format("{} N·m, {} rad/s", number(w.power.torque_Nm), number(w.power.speed_rad_per_s));
  };
  std::vector<report::Figure> out{
      {"Peak torque", of_ways(soft, kPeak) + " N·m",
       "moves it; holds " + of_ways(soft, [](const OneWay& w) { return w.holding.torque_Nm; })},
      {"No-load speed", of_ways(soft, kSpeed) + " rad/s", d.simulated.linear() ? "" : ways(soft, rpm) + " rpm"},
      {"Peak output power", of_ways(soft, [](const OneWay& w) { return w.power.power_W; }) + " W", ways(soft, best)},
  };
  if (d.has_preset()) {
    out.push_back({"Stiffness at rest", range(soft.stiffness_at_rest_Nm_per_rad, s.stiffest_Nm_per_rad),
                   fmt::format("N·m/rad, preset 0 … {} {}", number(s.attainable_preset), d.preset_unit())});
  } else {
    out.push_back({"Stiffness", number(soft.stiffness_at_rest_Nm_per_rad) + " N·m/rad", "no stiffness preset"});
  }
  out.push_back({"Elastic energy", number(s.most_energy_J) + " J", "largest that the motors load"});
  const auto& steps = d.simulated.preset_step;
  if (steps.size() == 2) {
    out.push_back({"Stiffness variation", number(steps[0].up.rise_s) + " s",
                   fmt::format("{} s at {} N·m", number(steps[1].up.rise_s), number(steps[1].run.load_peak_Nm))});
  }
  return out;
}

report::Table mechanical_table(const study::DataSheet& d) {
  const experiment::DataSheet& s = d.computed;
  const PresetColumn& c = s.columns.front();
  report::Table out{"Mechanics", {"quantity", "value", "unit", "from"}, {}, ""};
  auto& rows = out.rows;
  if (!d.has_preset()) add_columns(c, out);  // else they stand in the table of presets
  rows.push_back({"torque that full voltage holds", of_ways(c, [](const OneWay& w) { return w.holding.torque_Nm; }), "N·m", kBoth});
  if (const auto load = d.nominal_load_Nm()) {
    rows.push_back({fmt::format("speed at {} N·m", number(*load)),
                    ways(c, [&](const OneWay& w) { return number(speed_under(w, *load)); }), "rad/s", kBoth});
  }
  const auto released = [&](const OneWay& w) { return number(w.peak.energy_J - c.energy_at_rest_J); };
  rows.push_back({"elastic energy, released at the shaft", ways(c, released), "J", kBoth});
  add_speeds(d, out);
  add_preset_steps(d, out);
  rows.push_back({"friction of the shaft", number(s.type.unit.actuator.shaft_friction.coulomb_Nm), "N·m", kType});
  if (s.type.mass_kg) rows.push_back({"mass", number(s.type.mass_kg->value), "kg", kType});
  out.caption = marks(d) + (d.has_preset() ? "At preset 0 where nothing else is said." : "");
  return out;
}

report::Table electrical_table(const study::DataSheet& d) {
  const experiment::DataSheet& s = d.computed;
  const device::UnitConfig& u = s.type.unit;
  const int motors = u.actuator.transmission->motor_count();
  const std::array<int, 3> bits{u.actuator.side[0].encoder.bits, u.actuator.side[u.actuator.sides() - 1].encoder.bits,
                                u.actuator.shaft_encoder.bits};
  report::Table out{"Electronics, control, limits", {"quantity", "value", "unit", "from"}, {}, ""};
  auto& rows = out.rows;
  rows.push_back({"supply", number(u.actuator.supply_V), "V", kType});
  rows.push_back({"full voltage at a motor", of_each(s.line, [](const auto& l) { return number(l.voltage_V); }), "V",
                  u.supply_limited() ? "firmware" : kDrive});
  const std::string stalled = of_each(s.line, [](const auto& l) { return number(l.stall_current_A); });
  rows.push_back({"motors / current of each when stalled", fmt::format("{} / {}", motors, stalled), "A", kDrive});
  rows.push_back(
      {"friction of a motor with gears", of_each(s.line, [](const auto& l) { return number(l.friction_Nm); }), "N·m", kType});
  if (u.servo) {
    rows.push_back({"controller", std::string(control::name_of(u.servo->kind)), "", kType});
    rows.push_back({"encoders", of_each(bits, [](int b) { return number(b); }), "bit", kType});
    if (u.references_limited())
      rows.push_back({"travel of the motors", "±" + number(u.servo->reference_max_rad * 180 / kPi), "°", kType});
    return out;
  }
  rows.push_back({"position loop", number(1e6 / static_cast<double>(firmware::kTickNs)), "kHz", "firmware"});
  rows.push_back({"error that moves a motor / gives full voltage",
                  of_each(s.errors, [](const auto& e) { return pair(e.moves_rad * 180 / kPi, e.full_rad * 180 / kPi); }), "°",
                  kDrive});
  rows.push_back({"encoders", of_each(bits, [](int b) { return number(b); }), "bit", kType});
  rows.push_back(
      {"resolution measured / reported",
       pair(360.0 / std::pow(2.0, *std::min_element(bits.begin(), bits.end())), 360.0 / (65536 >> u.memory.resolution[0])), "°",
       "firmware"});
  rows.push_back({"current sense, a count", number(25771.0 / 8192.0), "mA", kDevice});
  if (u.memory.limits_on != 0) {
    rows.push_back({"travel of the motors",
                    range(u.reference_range_raw(0)[0] * 360 / kRawPerTurn, u.reference_range_raw(0)[1] * 360 / kRawPerTurn), "°",
                    "firmware"});
  }
  if (d.has_preset()) {
    rows.push_back(
        {"preset accepted / that the motors wind to", pair(u.preset_max, s.attainable_preset), d.preset_unit(), "preset; drive"});
  }
  return out;
}

report::Table preset_table(const study::DataSheet& d) {
  const auto& columns = d.computed.columns;
  report::Table out{"By stiffness preset", {fmt::format("attained preset [{}]", d.preset_unit())}, {}, marks(d)};
  const auto row = [&](const char* what, auto value) {
    std::vector<std::string> cells{what};
    for (const PresetColumn& c : columns) cells.push_back(number(value(c)));
    out.rows.push_back(std::move(cells));
  };
  const auto both = [&](const char* what, double (*value)(const OneWay&)) {
    std::vector<std::string> cells{what};
    for (const PresetColumn& c : columns) cells.push_back(of_ways(c, value));
    out.rows.push_back(std::move(cells));
  };
  for (const PresetColumn& c : columns) out.head.push_back(number(c.preset));
  row("stiffness at rest [N·m/rad]", [](const PresetColumn& c) { return c.stiffness_at_rest_Nm_per_rad; });
  both("peak torque [N·m]", kPeak);
  both("deflection at peak torque [rad]", kLag);
  both("stiffness at peak torque [N·m/rad]", [](const OneWay& w) { return w.peak.stiffness_Nm_per_rad; });
  both("stiffness at half of it [N·m/rad]", [](const OneWay& w) { return w.stiffness_at_half_Nm_per_rad; });
  both("torque held without current [N·m]", kUnpowered);
  row("power to hold it at rest [W]", [](const PresetColumn& c) { return c.held_at_rest.power_W; });
  both("power to hold half the peak torque [W]", [](const OneWay& w) { return w.held_at_half.power_W; });
  both("no-load speed [rad/s]", kSpeed);
  both("peak output power [W]", [](const OneWay& w) { return w.power.power_W; });
  row("elastic energy without load [J]", [](const PresetColumn& c) { return c.energy_at_rest_J; });
  return out;
}

}  // namespace vsa::app
