// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "datasheet/page.hpp"

namespace vsa::app {
namespace {

using experiment::BenchSample;
using experiment::PresetColumn;
using report::Chart;
using report::Curve;

constexpr std::size_t kPoints = 500;  // of a run, in a chart of half a page's width

std::string name_of(const study::DataSheet& d, double preset) {
  return d.has_preset() ? fmt::format("{:.2g} {}", preset, d.preset_unit()) : "shaft";
}

Curve started(std::string name, int color, Curve::Style style = Curve::Style::line) {
  Curve out;
  out.name = std::move(name);
  out.color = color;
  out.style = style;
  return out;
}

/// One curve a preset; `add(curve, column)` fills it.
template <class Add>
void by_preset(const study::DataSheet& d, Chart& chart, Add add) {
  int color = 0;
  for (const PresetColumn& c : d.computed.columns) {
    // A chart's only curve is called as the chart is, and needs no legend.
    add(chart.curves.emplace_back(started(d.has_preset() ? name_of(d, c.preset) : chart.title, color++)), c);
  }
}

Chart torque_speed(const study::DataSheet& d) {
  Chart out{"Torque and speed", "speed [rad/s]", "torque [N·m]", {}, "", false};
  by_preset(d, out, [](Curve& curve, const PresetColumn& c) {
    for (const auto& p : c.boundary) {
      curve.x.push_back(p.speed_rad_per_s);
      curve.y.push_back(p.reach.torque_Nm);
    }
  });
  if (lopsided(d)) {
    int color = 0;
    for (const PresetColumn& c : d.computed.columns) {
      Curve& curve = out.curves.emplace_back(started(name_of(d, c.preset) + ", −q", color++, Curve::Style::dashed));
      for (const auto& p : c.back.boundary) {
        curve.x.push_back(p.speed_rad_per_s);
        curve.y.push_back(p.reach.torque_Nm);
      }
    }
  }
  out.caption = d.has_preset()
                    ? "Reachable under each line, at that attained preset; both motors at full voltage. From law and drive."
                    : "Reachable under the line, at full voltage. From law and drive.";
  return out;
}

Chart torque_deflection(const study::DataSheet& d) {
  Chart out{"Torque and deflection", "deflection [rad]", "load torque [N·m]", {}, "", false};
  by_preset(d, out, [](Curve& curve, const PresetColumn& c) {
    for (const auto& p : c.curve) {
      curve.x.push_back(p.deflection_rad);
      curve.y.push_back(p.load_Nm);
    }
  });
  out.caption = "The law with its pulleys held, up to the loads that the motors move.";
  return out;
}

Chart stiffness_load(const study::DataSheet& d) {
  Chart out{"Stiffness and load", "load torque [N·m]", "stiffness [N·m/rad]", {}, "", true};
  by_preset(d, out, [](Curve& curve, const PresetColumn& c) {
    double largest = 0;
    for (const auto& p : c.curve) largest = std::max(largest, p.stiffness_Nm_per_rad);
    for (const auto& p : c.curve) {
      if (p.load_Nm < 0 || !shown(p.stiffness_Nm_per_rad, largest)) continue;
      curve.x.push_back(p.load_Nm);
      curve.y.push_back(p.stiffness_Nm_per_rad);
    }
  });
  out.caption = lopsided(d) ? "From the law, at that attained preset, loads about +q; about −q it is another."
                            : "From the law, at that attained preset.";
  return out;
}

/// 1, 2 or 5 times a power of ten, at most `value`.
double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  return power * (value >= 5 * power ? 5 : value >= 2 * power ? 2 : 1);
}

Chart stiffness_preset(const study::DataSheet& d) {
  constexpr int kSteps = 60;
  Chart out{"Stiffness and preset", fmt::format("attained preset [{}]", d.preset_unit()), "stiffness [N·m/rad]", {}, "", true};
  const experiment::Workspace workspace(d.computed.type.unit);
  const double most = d.computed.columns[1].peak.torque_Nm;  // beyond it only the softest presets move anything
  const double load_step = round_down(most / 3);
  int color = 0;
  for (double load = 0; load < most && color < 5; load += load_step) {
    Curve& curve = out.curves.emplace_back(started(load == 0 ? "no load" : number(load) + " N·m", color++));
    for (int i = 0; i <= kSteps; ++i) {
      curve.x.push_back(d.computed.attainable_preset * i / kSteps);
      curve.y.push_back(workspace.stiffness_under(curve.x.back(), load));
    }
  }
  out.caption = "From the law, for loads that the motors move; the preset ends where they can't wind the springs further.";
  return out;
}

Curve sampled(const experiment::BenchRun& run, double BenchSample::*y, double until_s, Curve out) {
  const auto inside = static_cast<std::size_t>(
      std::count_if(run.samples.begin(), run.samples.end(), [&](const BenchSample& s) { return s.time_s <= until_s; }));
  const std::size_t stride = std::max<std::size_t>(1, inside / kPoints);
  for (std::size_t i = 0; i < inside; i += stride) {
    out.x.push_back(run.samples[i].time_s);
    out.y.push_back(run.samples[i].*y);
  }
  return out;
}

Chart step(const study::DataSheet& d) {
  constexpr double kUntil_s = 1.0;
  Chart out{"Step of the equilibrium", "time after the command [s]", "shaft [rad]", {}, "", false};
  int color = 0;
  for (const study::SpeedResult& r : d.simulated.speed) {
    out.curves.push_back(sampled(r.run, &BenchSample::shaft_rad, kUntil_s, started(name_of(d, r.options.preset), color++)));
  }
  Curve command = started("command", -1, Curve::Style::dotted);
  command.x = {0, kUntil_s};
  command.y.assign(2, d.simulated.speed.front().options.step_rad);
  out.curves.push_back(std::move(command));
  out.caption = d.has_preset() ? "Simulated without load, at these commanded presets." : "Simulated without load.";
  return out;
}

Chart preset_step(const study::DataSheet& d) {
  Chart out{
      "Step of the preset", "time after the command [s]", fmt::format("attained preset [{}]", d.preset_unit()), {}, "", false};
  int color = 0;
  for (const study::PresetStepResult& r : d.simulated.preset_step) {
    const std::string name = r.options.loaded ? number(r.run.load_peak_Nm) + " N·m" : "no load";
    out.curves.push_back(sampled(r.run, &BenchSample::preset, r.run.samples.back().time_s, started(name, color++)));
  }
  const auto& o = d.simulated.preset_step.front().options;
  Curve command = started("command", -1, Curve::Style::dotted);
  command.x = {0, o.hold_s, o.hold_s, 2 * o.hold_s};
  command.y = {o.preset, o.preset, o.from, o.from};
  out.curves.push_back(std::move(command));
  out.caption = "Simulated: to the preset and back.";
  return out;
}

}  // namespace

bool shown(double stiffness, double largest) { return stiffness > 1e-3 * largest; }

std::vector<report::Block> sheet_charts(const study::DataSheet& d) {
  if (!d.has_preset()) return {torque_speed(d), torque_deflection(d), step(d)};
  std::vector<report::Block> out{torque_speed(d), torque_deflection(d), stiffness_load(d), stiffness_preset(d), step(d)};
  if (!d.simulated.preset_step.empty()) out.push_back(preset_step(d));
  return out;
}

}  // namespace vsa::app
