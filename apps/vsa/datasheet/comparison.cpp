// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "datasheet/gallery.hpp"
#include "datasheet/page.hpp"

namespace vsa::app {
namespace {

using experiment::PresetColumn;
using report::Chart;

using Sheets = std::vector<study::DataSheet>;

constexpr double kLeastLoad = 0.01;  // of a curve's end: where a logarithmic axis begins

std::string both(const study::DataSheet& d, double soft, double stiff) {
  return d.has_preset() ? number(soft) + " / " + number(stiff) : number(soft);
}
template <class Field>
std::string both(const study::DataSheet& d, Field field) {
  return both(d, field(d.computed.columns.front()), field(d.computed.columns.back()));
}

std::string amount_held(const experiment::Holding& h) {
  return std::isfinite(h.power_W) ? number(h.power_W) + " / " + number(h.current_A) : "–";
}

/// A row a type, which leads to its sheet.
template <class Cells>
void add_rows(const Sheets& sheets, report::Table& out, Cells cells) {
  for (const study::DataSheet& d : sheets) {
    std::vector<std::string> row{d.computed.type.name + (d.simulated.linear() ? " (pinion)" : "")};
    for (std::string& cell : cells(d)) row.push_back(std::move(cell));
    out.rows.push_back(std::move(row));
    out.links.push_back(sheet_file(d));
  }
}

/// Six colours, each as a line, dashed and dotted.
report::Curve curve_of(const study::DataSheet& d, std::size_t i) {
  constexpr std::array kStyles{report::Curve::Style::line, report::Curve::Style::dashed, report::Curve::Style::dotted};
  return report::curve(d.computed.type.name, {}, {}, kStyles[i / 6 % kStyles.size()], static_cast<int>(i));
}

/// One curve a type; `fill(curve, sheet)`; what it leaves empty isn't there.
template <class Fill>
Chart chart_of(const Sheets& sheets, Chart chart, Fill fill) {
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    report::Curve curve = curve_of(sheets[i], i);
    fill(curve, sheets[i]);
    if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
  }
  return chart;
}

/// Equal axes for charts beside each other, by what is drawn of them.
void equalise(std::vector<Chart*> charts) {
  const auto range = [&](std::vector<double> report::Curve::*values, bool log) -> std::optional<std::array<double, 2>> {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Chart* chart : charts) {
      for (const report::Curve& c : chart->curves) {
        for (const double v : c.*values) {
          if (!std::isfinite(v) || (log && v <= 0)) continue;
          low = std::min(low, v);
          high = std::max(high, v);
        }
      }
    }
    if (!(high > low)) return std::nullopt;
    const double margin = log ? std::pow(high / low, 0.04) : 0.04 * (high - low);
    return log ? std::array{low / margin, high * margin} : std::array{low - margin, high + margin};
  };
  const auto x = range(&report::Curve::x, charts.front()->x_log), y = range(&report::Curve::y, charts.front()->y_log);
  for (Chart* chart : charts) {
    chart->x_range = x;
    chart->y_range = y;
  }
}

Chart stiffness_load(const Sheets& sheets, bool stiff) {
  Chart chart{stiff ? "Stiffness against load, stiffest" : "Stiffness against load, softest",
              "load [N·m]",
              "stiffness [N·m/rad]",
              {},
              "",
              true,
              true};
  chart = chart_of(sheets, std::move(chart), [&](report::Curve& curve, const study::DataSheet& d) {
    if (stiff && !d.has_preset()) return;
    const PresetColumn& c = stiff ? d.computed.columns.back() : d.computed.columns.front();
    double largest = 0;
    for (const experiment::LawPoint& p : c.curve) largest = std::max(largest, p.stiffness_Nm_per_rad);
    for (const experiment::LawPoint& p : c.curve) {
      if (p.load_Nm < kLeastLoad * c.curve.back().load_Nm || !shown(p.stiffness_Nm_per_rad, largest)) continue;
      curve.x.push_back(p.load_Nm);
      curve.y.push_back(p.stiffness_Nm_per_rad);
    }
  });
  chart.caption = stiff ? "At 90 % of the largest preset that the motors wind to; types with a preset." : "At preset 0.";
  return chart;
}

Chart torque_deflection(const Sheets& sheets, bool stiff) {
  Chart chart{
      stiff ? "Torque over deflection, stiffest" : "Torque over deflection, softest", "deflection [rad]", "load [N·m]", {}, ""};
  chart = chart_of(sheets, std::move(chart), [&](report::Curve& curve, const study::DataSheet& d) {
    if (stiff && !d.has_preset()) return;
    for (const experiment::LawPoint& p : (stiff ? d.computed.columns.back() : d.computed.columns.front()).curve) {
      curve.x.push_back(p.deflection_rad);
      curve.y.push_back(p.load_Nm);
    }
  });
  chart.caption = "The law with its inputs held, up to the loads that the motors move.";
  return chart;
}

Chart torque_speed(const Sheets& sheets) {
  Chart chart{"Torque and speed, softest", "speed [rad/s]", "torque [N·m]", {}, "At full voltage, from law and drive.", true};
  return chart_of(sheets, std::move(chart), [](report::Curve& curve, const study::DataSheet& d) {
    const PresetColumn& c = d.computed.columns.front();
    for (const auto& p : c.boundary) {
      if (p.reach.torque_Nm < kLeastLoad * c.peak.torque_Nm) continue;
      curve.x.push_back(p.speed_rad_per_s);
      curve.y.push_back(p.reach.torque_Nm);
    }
  });
}

Chart stiffness_preset(const Sheets& sheets) {
  Chart chart{"Stiffness at rest", "preset, of the largest that the motors wind to [1]", "stiffness [N·m/rad]", {}, "", true};
  chart.caption = "A law without stiffness at preset 0 begins beside it.";
  return chart_of(sheets, std::move(chart), [](report::Curve& curve, const study::DataSheet& d) {
    constexpr int kSteps = 60;
    if (!d.has_preset()) return;
    const experiment::Workspace workspace(d.computed.type.unit);
    for (int i = 0; i <= kSteps; ++i) {
      curve.x.push_back(static_cast<double>(i) / kSteps);
      curve.y.push_back(workspace.stiffness_at_rest(curve.x.back() * d.computed.attainable_preset));
    }
  });
}

std::string times(const study::PresetStepResult& r) { return number(r.up.rise_s) + " / " + number(r.down.rise_s); }

}  // namespace

report::Table strength_table(const Sheets& sheets) {
  report::Table out{
      "Torque, speed, energy",
      {"type", "rank", "law", "motors", "peak torque [N·m]", "deflection there [rad]", "speed [rad/s]", "output power [W]",
       "elastic energy [J]", "mass [kg]"},
      {},
      "Two numbers: at preset 0 / at 90 % of the largest that the motors wind to, of unequal springs in the weaker direction. Peak "
      "torque: begins to move it. Speed: "
      "without load, softest. Elastic energy: the most that the motors load. From law and drive; mass: as the type's file "
      "states it, – where no source does."};
  add_rows(sheets, out, [](const study::DataSheet& d) {
    const experiment::DataSheet& s = d.computed;
    const PresetColumn& soft = s.columns.front();
    return std::vector<std::string>{s.type.rank.empty() ? "–" : s.type.rank,
                                    s.type.law,
                                    std::to_string(s.type.unit.actuator.transmission->motor_count()),
                                    both(d, [](const PresetColumn& c) { return c.weaker().peak.torque_Nm; }),
                                    both(d, [](const PresetColumn& c) { return c.weaker().peak.deflection_rad; }),
                                    number(soft.weaker().no_load_speed_rad_per_s),
                                    number(soft.weaker().power.power_W),
                                    number(s.most_energy_J),
                                    s.type.mass_kg ? number(s.type.mass_kg->value) : "–"};
  });
  return out;
}

report::Table stiffness_range_table(const Sheets& sheets) {
  report::Table out{
      "Stiffness and its change",
      {"type", "largest preset", "at rest [N·m/rad]", "at half the peak torque [N·m/rad]", "stiffens / softens in [s]",
       "the same under load [s]", "load [N·m]"},
      {},
      "Largest preset: that the motors wind to. Stiffness from preset 0 to that, at half the peak torque to 90 % of it: "
      "from law and drive. Times: 10–90 % of the preset's way, simulated as vsa characterize does it; the load hangs on a "
      "lever that is held out."};
  add_rows(sheets, out, [](const study::DataSheet& d) {
    const experiment::DataSheet& s = d.computed;
    const auto [low, high] = stiffness_at_rest(d);
    const auto& steps = d.simulated.preset_step;
    const double soft = s.columns.front().weaker().stiffness_at_half_Nm_per_rad,
                 stiff = s.columns.back().weaker().stiffness_at_half_Nm_per_rad;
    const bool loaded = steps.size() > 1;
    return std::vector<std::string>{d.has_preset() ? number(s.attainable_preset) + " " + d.preset_unit() : "none",
                                    span_text(low, high),
                                    span_text(soft, stiff),
                                    steps.empty() ? "–" : times(steps[0]),
                                    loaded ? times(steps[1]) : "–",
                                    loaded ? number(steps[1].run.load_peak_Nm) : "–"};
  });
  return out;
}

report::Table holding_table(const Sheets& sheets) {
  report::Table out{
      "Power to hold, losses",
      {"type", "stiffest at rest [W / A]", "softest, half the peak torque [W / A]", "stiffest, half its torque [W / A]",
       "torque held without current [N·m]", "friction of a motor [N·m]", "of the shaft [N·m]", "of the springs [%]"},
      {},
      "Heat of the windings and sum of the motors' currents for what their friction doesn't hold. Stiffest: at 90 % of the "
      "largest preset. Torque held without current: at preset 0. Friction of the springs: of their tension. From law and "
      "drive; frictions as the type has them, a motor's behind its gears."};
  add_rows(sheets, out, [](const study::DataSheet& d) {
    const PresetColumn &soft = d.computed.columns.front(), &stiff = d.computed.columns.back();
    const actuator::ActuatorParams& a = d.computed.type.unit.actuator;
    return std::vector<std::string>{d.has_preset() ? amount_held(stiff.held_at_rest) : "–",
                                    amount_held(soft.weaker().held_at_half),
                                    d.has_preset() ? amount_held(stiff.weaker().held_at_half) : "–",
                                    number(soft.weaker().unpowered.torque_Nm),
                                    of_each(d.computed.line, [](const auto& l) { return number(l.friction_Nm); }),
                                    number(a.shaft_friction.coulomb_Nm),
                                    number(100 * a.tendon.friction)};
  });
  return out;
}

report::Report comparison_page(const Sheets& sheets, const std::string& command) {
  Chart soft = stiffness_load(sheets, false), stiff = stiffness_load(sheets, true);
  Chart soft_curve = torque_deflection(sheets, false), stiff_curve = torque_deflection(sheets, true);
  equalise({&soft, &stiff});
  equalise({&soft_curve, &stiff_curve});
  report::Report out;
  out.title = "Actuator types beside each other";
  out.subtitle = fmt::format("{} types; a name leads to its data sheet; linear actuators turn a pinion of 0.05 m", sheets.size());
  out.links = {{"Gallery", kGalleryFile}};
  out.sections = {{"Numbers", {strength_table(sheets), stiffness_range_table(sheets), holding_table(sheets)}},
                  {"Curves", {soft, stiff, soft_curve, stiff_curve, torque_speed(sheets), stiffness_preset(sheets)}}};
  out.footer =
      "Ranks: measured: recordings of the hardware; published: constants from public sources; symbolic: a law with numbers that "
      "something real could have.\n" +
      command + " · vsa " VSA_VERSION;
  return out;
}

}  // namespace vsa::app
