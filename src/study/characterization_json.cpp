// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/page/json.hpp"
#include "vsa/page/sliding_keys.hpp"
#include "vsa/study/characterization.hpp"
#include "vsa/units.hpp"

namespace vsa::study {
namespace {

using page::Json;
using page::real;
using page::reals;

Json range(const Range& r) { return {r.least, r.most}; }

/// `unit` is what y is measured in.
Json step_json(const experiment::StepMeasures& m, const std::string& unit) {
  Json out;
  out["rise_10_90_s"] = real(m.rise_s);
  out["mean_speed_" + unit + "_per_s"] = real(m.mean_speed);
  out["peak_slope_" + unit + "_per_s"] = real(m.peak_slope);
  out["overshoot_pct"] = real(m.overshoot_pct);
  out["ringing_Hz"] = real(m.ringing_Hz);
  out["damping_ratio"] = real(m.damping_ratio);
  out["steady_error_" + unit] = real(m.steady_error);
  return out;
}

Json step_with_final(const experiment::StepMeasures& m, const std::string& unit) {
  Json out = step_json(m, unit);
  out["final_" + unit] = real(m.final_value);
  return out;
}

void put_preset(Json& out, const Characterization& c, double preset) {
  if (!c.preset_unit().empty()) out["preset_" + c.preset_unit()] = preset;
}

Json stiffness_json(const Characterization& c, const StiffnessResult& r) {
  Json out;
  put_preset(out, c, r.options.preset);
  out["file"] = csv_name(c, r);
  out["period_s"] = r.options.period_s;
  out["amplitude_rad"] = r.run.amplitude_rad;
  out["amplitude_given"] = r.options.amplitude_rad.has_value();
  out["cycles"] = r.options.cycles;
  out["lead_in_cycles"] = r.options.lead_in_cycles;
  out["sample_s"] = r.options.sample_s;
  out["load_peak_Nm"] = r.run.load_peak_Nm;
  out["measured_shaft_range_rad"] = range(r.shaft_rad);
  out["measured_load_range_Nm"] = range(r.load_Nm);
  out["measured_deflection_range_rad"] = range(r.deflection_rad);
  if (!c.preset_unit().empty()) out["attained_preset_range_" + c.preset_unit()] = range(r.preset);
  const experiment::Loop& l = r.loop;
  out["loop"] = {{"area_Nm_rad", real(l.area_Nm_rad)},
                 {"mean_width_rad", real(l.mean_width_rad)},
                 {"mean_abs_width_rad", real(l.mean_abs_width_rad)},
                 {"largest_width_rad", real(l.largest_width_rad)},
                 {"smallest_width_rad", real(l.smallest_width_rad)},
                 {"peak_rising_rad", real(l.peak_rising_rad)},
                 {"peak_falling_rad", real(l.peak_falling_rad)}};
  out["branches"] = {{"load_torque_Nm", r.branches.torque_Nm},
                     {"deflection_rising_rad", reals(r.branches.rising_rad)},
                     {"deflection_falling_rad", reals(r.branches.falling_rad)},
                     {"sd_rising_rad", reals(r.branches.sd_rising_rad)},
                     {"sd_falling_rad", reals(r.branches.sd_falling_rad)}};
  Json& curve = out["stiffness"] = Json::array();
  for (const experiment::StiffnessPoint& p : r.curve) {
    curve.push_back({{"load_torque_Nm", p.torque_Nm},
                     {"deflection_rad", p.deflection_rad},
                     {"stiffness_Nm_per_rad", p.stiffness_Nm_per_rad},
                     {"standard_error_Nm_per_rad", p.standard_error_Nm_per_rad}});
  }
  return out;
}

Json speed_json(const Characterization& c, const SpeedResult& r) {
  Json out;
  put_preset(out, c, r.options.preset);
  out["file"] = csv_name(c, r);
  out["step_rad"] = r.options.step_rad;
  out["hold_s"] = r.options.hold_s;
  out["sample_s"] = r.options.sample_s;
  out["mean"] = {{"shaft", step_json(r.mean.shaft, "rad")}, {"pulleys", step_json(r.mean.pulleys, "rad")}};
  Json& edges = out["edges"] = Json::array();
  for (const Edge& e : r.edges) {
    edges.push_back({{"command_s", e.command_s},
                     {"from_rad", e.from_rad},
                     {"to_rad", e.to_rad},
                     {"shaft", step_with_final(e.shaft, "rad")},
                     {"pulleys", step_with_final(e.pulleys, "rad")}});
  }
  return out;
}

Json preset_step_json(const Characterization& c, const PresetStepResult& r) {
  Json out;
  put_preset(out, c, r.options.preset);
  out["file"] = csv_name(r);
  out["loaded"] = r.options.loaded;
  out["from_preset_" + c.preset_unit()] = r.options.from;
  out["hold_s"] = r.options.hold_s;
  out["sample_s"] = r.options.sample_s;
  out["equilibrium_command_rad"] = r.run.amplitude_rad;
  out["load_peak_Nm"] = r.run.load_peak_Nm;
  out["measured_load_range_Nm"] = range(r.load_Nm);
  out["attained_preset_" + c.preset_unit()] = real(r.up.final_value);
  out["resting_preset_" + c.preset_unit()] = real(r.down.final_value);
  out["up"] = step_json(r.up, c.preset_unit());
  out["down"] = step_json(r.down, c.preset_unit());
  return out;
}

Json actuator_json(const Characterization& c) {
  Json out;
  out["type"] = c.actuator.name;
  out["title"] = c.actuator.title;
  out["law"] = c.actuator.law;
  Json& overrides = out["overrides"] = Json::object();
  std::vector<config::Override> given = c.specimen.overrides;
  if (c.linear()) given.pop_back();  // the benches' pinion, which nobody asked for
  for (const config::Override& o : given) overrides[o.key] = o.value;
  Json& values = out["parameters"] = Json::array();
  for (const config::Entry& e : c.actuator.entries) values.push_back({{"key", e.key}, {"value", e.value}, {"unit", e.unit}});
  return out;
}

double step_of(const Characterization& c) {
  if (!c.stiffness.empty()) return c.stiffness.front().run.step_s;
  return c.speed.empty() ? c.preset_step.front().run.step_s : c.speed.front().run.step_s;
}

}  // namespace

std::string to_json(const Characterization& c, const std::string& command) {
  Json out = page::results_head(command);
  out["actuator"] = actuator_json(c);
  out["engine_step_s"] = step_of(c);
  const auto told = [&](const Json& result) { return c.linear() ? page::sliding_keys(result) : result; };
  for (const StiffnessResult& r : c.stiffness) out["stiffness"].push_back(told(stiffness_json(c, r)));
  for (const SpeedResult& r : c.speed) out["speed"].push_back(told(speed_json(c, r)));
  for (const PresetStepResult& r : c.preset_step) out["preset_step"].push_back(told(preset_step_json(c, r)));
  return page::results_text(out);
}

}  // namespace vsa::study
