// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "characterize/output.hpp"
#include "vsa/report/sliding.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using experiment::BenchRun;
using experiment::BenchSample;
using report::Chart;
using report::Curve;
using Field = double BenchSample::*;

std::string curve_name(const study::Characterization& c, double preset) {
  return c.preset_unit().empty() ? c.actuator.name : fmt::format("preset {:.4g} {}", preset, c.preset_unit());
}

/// Samples from `from_s` to `to_s`, every so many that about `most` stay. Time counts from `from_s`.
Curve sampled(const BenchRun& run, Field x, Field y, double from_s, double to_s, std::size_t most) {
  Curve out;
  const double slack_s = 0.5 * run.step_s;
  const auto inside = [&](const BenchSample& s) { return s.time_s >= from_s - slack_s && s.time_s <= to_s + slack_s; };
  const auto count = static_cast<std::size_t>(std::count_if(run.samples.begin(), run.samples.end(), inside));
  const std::size_t stride = std::max<std::size_t>(1, count / most);
  std::size_t k = 0;
  for (const BenchSample& s : run.samples) {
    if (!inside(s) || k++ % stride != 0) continue;
    out.x.push_back(x == &BenchSample::time_s ? s.time_s - from_s : s.*x);
    out.y.push_back(s.*y);
  }
  return out;
}

Curve named(Curve curve, const std::string& name, int color, Curve::Style style) {
  curve.name = curve.group = name;
  curve.color = color;
  curve.style = style;
  return curve;
}

constexpr std::size_t kLoopPoints = 2000, kStepPoints = 2000;
constexpr double kStepShown_s = 1.0;  // of the speed experiment: the rise and the ringing

Chart loop_chart(const study::Characterization& c) {
  Chart out;
  out.title = "Torque–deflection loops";
  out.x_label = "deflection [rad]";
  out.y_label = "load torque [N·m]";
  int color = 0;
  for (const study::StiffnessResult& r : c.stiffness) {
    const double end = r.run.samples.back().time_s;
    out.curves.push_back(named(sampled(r.run, &BenchSample::measured_deflection_rad, &BenchSample::measured_load_Nm,
                                       end - r.options.period_s, end, kLoopPoints),
                               curve_name(c, r.options.preset), color++, Curve::Style::line));
  }
  out.caption = "The last cycle, as the unit's encoders read it. The load is the external torque about +q.";
  return out;
}

Chart stiffness_chart(const study::Characterization& c) {
  Chart out;
  out.title = "Stiffness against deflection";
  out.x_label = "deflection [rad]";
  out.y_label = "stiffness [N·m/rad]";
  out.y_log = true;
  int color = 0;
  for (const study::StiffnessResult& r : c.stiffness) {
    Curve curve;
    for (const experiment::StiffnessPoint& p : r.curve) {
      curve.x.push_back(p.deflection_rad);
      curve.y.push_back(p.stiffness_Nm_per_rad);
      curve.error.push_back(p.standard_error_Nm_per_rad);
    }
    out.curves.push_back(named(std::move(curve), curve_name(c, r.options.preset), color++, Curve::Style::markers));
  }
  out.caption =
      fmt::format("Slope of a cubic fitted to each branch in windows of {:g} N·m, mean of both branches; bars: one standard error.",
                  0.4 * c.stiffness.front().options.load_share * c.load_scale);
  return out;
}

Chart width_chart(const study::Characterization& c) {
  Chart out;
  out.title = "Hysteresis";
  out.x_label = "load torque [N·m]";
  out.y_label = "falling − rising deflection [rad]";
  int color = 0;
  for (const study::StiffnessResult& r : c.stiffness) {
    Curve curve;
    curve.x = r.branches.torque_Nm;
    for (std::size_t i = 0; i < curve.x.size(); ++i) curve.y.push_back(r.branches.falling_rad[i] - r.branches.rising_rad[i]);
    out.curves.push_back(named(std::move(curve), curve_name(c, r.options.preset), color++, Curve::Style::line));
  }
  out.caption = "The loop's width; the area under it is the loop's. Positive where energy is lost.";
  return out;
}

Chart step_chart(const study::Characterization& c) {
  Chart out;
  out.title = "Step of the equilibrium";
  out.x_label = "time after the command [s]";
  out.y_label = "angle [rad]";
  int color = 0;
  const auto first = [](const study::SpeedResult& r, Field y) {
    return sampled(r.run, &BenchSample::time_s, y, 0, std::min(kStepShown_s, r.options.hold_s), kStepPoints);
  };
  for (const study::SpeedResult& r : c.speed) {
    const std::string name = curve_name(c, r.options.preset);
    out.curves.push_back(named(first(r, &BenchSample::shaft_rad), name, color, Curve::Style::line));
    Curve pulleys = named(first(r, &BenchSample::equilibrium_rad), name + ", pulleys", color++, Curve::Style::dotted);
    pulleys.group = name;
    out.curves.push_back(std::move(pulleys));
  }
  const experiment::SpeedOptions& o = c.speed.front().options;
  Curve command;
  command.x = {0, std::min(kStepShown_s, o.hold_s)};
  command.y = {o.step_rad, o.step_rad};
  out.curves.push_back(named(std::move(command), "command", color, Curve::Style::dashed));
  out.caption = "First edge of the square wave, no load. Lines: the shaft; dotted: the mean of the pulleys.";
  return out;
}

Chart preset_chart(const study::Characterization& c) {
  Chart out;
  out.title = "Attained preset";
  out.x_label = "time after the command [s]";
  out.y_label = "preset [" + c.preset_unit() + "]";
  int color = 0;
  for (const study::PresetStepResult& r : c.preset_step) {
    out.curves.push_back(named(sampled(r.run, &BenchSample::time_s, &BenchSample::preset, 0, 2 * r.options.hold_s, kStepPoints),
                               r.options.loaded ? "with the lever" : "no load", color++, Curve::Style::line));
  }
  const BenchRun& run = c.preset_step.front().run;
  out.curves.push_back(
      named(sampled(run, &BenchSample::time_s, &BenchSample::preset_command, 0, run.samples.back().time_s, run.samples.size()),
            "command", color, Curve::Style::dashed));
  out.caption = "A step to the preset and back.";
  return out;
}

Chart sag_chart(const study::Characterization& c) {
  Chart out;
  out.title = "The shaft meanwhile";
  out.x_label = "time after the command [s]";
  out.y_label = "shaft − its commanded equilibrium [rad]";
  int color = 0;
  for (const study::PresetStepResult& r : c.preset_step) {
    Curve curve = sampled(r.run, &BenchSample::time_s, &BenchSample::shaft_rad, 0, 2 * r.options.hold_s, kStepPoints);
    for (double& y : curve.y) y -= r.run.amplitude_rad;
    out.curves.push_back(named(std::move(curve), r.options.loaded ? "with the lever" : "no load", color++, Curve::Style::line));
  }
  out.caption = "How far the load makes the shaft sag as the actuator stiffens and softens.";
  return out;
}

std::string sweep_text(const study::Characterization& c) {
  const experiment::StiffnessOptions& o = c.stiffness.front().options;
  return fmt::format(
      "A mass on a lever loads the shaft with at most {:.4f} N·m while the equilibrium sweeps sinusoidally with a period of {:g} "
      "s; {:g} cycles "
      "are measured after the first. {}",
      c.stiffness.front().run.load_peak_Nm, o.period_s, o.cycles,
      o.amplitude_rad
          ? "The amplitude was given."
          : "The amplitude is such that the shaft reaches the angle that a qbmove maker pro reached in its recordings.");
}

std::string overrides_text(const study::Characterization& c) {
  std::string out;
  std::vector<config::Override> given = c.specimen.overrides;
  if (c.linear()) given.pop_back();  // the bench's pinion, of which fit_notes() tell
  for (const config::Override& o : given) out += (out.empty() ? " with " : ", ") + o.key + " = " + o.value;
  return out;
}

}  // namespace

report::Report characterization_report(const study::Characterization& c, const std::string& command) {
  report::Report out;
  out.title = c.actuator.title;
  out.subtitle = "Characterised as the paper's section IV does it, in simulation: " + c.actuator.name + overrides_text(c);
  const auto told = [&](Chart chart) { return c.linear() ? report::sliding(std::move(chart)) : chart; };
  report::Section notes{"", {}};
  for (const std::string& note : fit_notes(c)) notes.blocks.emplace_back(report::Text{note});
  if (!notes.blocks.empty()) out.sections.push_back(std::move(notes));
  if (!c.stiffness.empty()) {
    out.sections.push_back({"Stiffness",
                            {report::Text{c.linear() ? sliding(sweep_text(c)) : sweep_text(c)}, told(loop_chart(c)),
                             told(stiffness_chart(c)), told(width_chart(c)), stiffness_table(c)}});
  }
  if (!c.speed.empty()) {
    out.sections.push_back({"Speed", {told(step_chart(c)), speed_table(c)}});
  }
  if (!c.preset_step.empty()) {
    out.sections.push_back({"Stiffness variation", {preset_chart(c), told(sag_chart(c)), preset_step_table(c)}});
  }
  if (c.preset_unit().empty()) {
    out.sections.push_back({"Stiffness variation", {report::Text{"This actuator has no stiffness preset."}}});
  }
  out.footer = command + " · vsa " VSA_VERSION;
  return out;
}

}  // namespace vsa::app
