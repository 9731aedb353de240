// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/linear_shaft.hpp"
#include "vsa/errors.hpp"
#include "vsa/experiment/datasheet.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/page/json.hpp"

namespace vsa::study {
namespace {

using page::Json;
using page::real;

constexpr double kAcceleration_rad_per_s2 = 200;
constexpr double kArm_m = 0.5, kGravity_m_per_s2 = 9.81;

TaskResults planned(config::ActuatorType type, const TaskOptions& options) {
  TaskResults out;
  const experiment::Workspace workspace(type.unit);
  const double attainable = workspace.attainable_preset();
  for (const double share : experiment::kPresetShares) {
    if (share == 0 || attainable > 0) out.presets.push_back(share * attainable);
  }
  for (const double p : out.presets) out.torque_Nm = std::fmax(out.torque_Nm, workspace.moves_Nm(p));
  out.no_load_speed_rad_per_s = std::min(workspace.no_load_speed(0), workspace.no_load_speed(0, -1));
  const bool moves = out.torque_Nm > 0;
  out.inertia_kgm2 = moves ? options.inertia_kgm2.value_or(out.torque_Nm / kAcceleration_rad_per_s2) : kNaN;
  out.load_Nm = moves ? options.load_Nm.value_or(out.torque_Nm / 2) : kNaN;
  out.actuator = std::move(type);
  return out;
}

void check(const TaskOptions& o, Problems& problems) {
  const auto require = [&](const char* flag, double value, double least, double most, const char* unit) {
    if (!(value >= least && value <= most))
      problems.add({"", flag, fmt::format("{}", value), "out of range", fmt::format("{} … {} {}", least, most, unit)});
  };
  if (o.inertia_kgm2) require("--inertia-kgm2", *o.inertia_kgm2, 1e-6, 1e3, "kg·m²");
  if (o.load_Nm) require("--load-Nm", *o.load_Nm, 1e-6, 1e5, "N·m");
  require("--step-s", o.step_s, 1e-5, 1e-3, "s");
  if (const double most = kMostBlow_Nm * o.step_s / kBlow_rad_per_s; problems.empty() && o.inertia_kgm2 && *o.inertia_kgm2 > most)
    problems.add({"", "--inertia-kgm2", fmt::format("{}", *o.inertia_kgm2),
                  fmt::format("is too much for a blow of one step of {} s", o.step_s), fmt::format("1e-06 … {:.4g} kg·m²", most)});
  for (auto it = o.types.begin(); it != o.types.end(); ++it)
    if (std::find(o.types.begin(), it, *it) != it) problems.add({"", "--types", *it, "is named twice", "each type once"});
}

/// Of the results that count, the best; `worse(a, b)`: b is better.
template <class Result, class Counts, class Worse>
std::optional<Result> best_of(const std::vector<Result>& all, Counts counts, Worse worse) {
  std::optional<Result> best;
  for (const Result& r : all) {
    if (counts(r) && (!best || worse(*best, r))) best = r;
  }
  return best;
}

Json best_json(const TaskResults& r) {
  const auto far = r.farthest();
  const auto soon = r.soonest();
  const auto cheap = r.cheapest();
  return {{"throw_distance_m", real(far ? far->distance_m() : kNaN)},
          {"settled_s", real(soon ? soon->settled_s : kNaN)},
          {"hold_energy_J", real(cheap ? cheap->energy_J : kNaN)}};
}

Json type_json(const TaskResults& r) {
  const std::string unit = r.preset_unit();
  const auto at = [&](double preset) { return unit.empty() ? Json::object() : Json{{"preset_" + unit, real(preset)}}; };
  Json out{{"type", r.actuator.name},
           {"rank", r.actuator.rank},
           {"law", r.actuator.law},
           {"torque_Nm", real(r.torque_Nm)},
           {"inertia_kgm2", real(r.inertia_kgm2)},
           {"load_Nm", real(r.load_Nm)},
           {"no_load_speed_rad_per_s", real(r.no_load_speed_rad_per_s)},
           {"best", best_json(r)}};
  for (const char* task : {"throw", "settle", "hold"}) out[task] = Json::array();
  const auto add = [&](const char* task, double preset, const Json& values) {
    Json line = at(preset);
    line.update(values);
    out[task].push_back(std::move(line));
  };
  for (const ThrowResult& t : r.throws) {
    add("throw", t.preset,
        {{"swing_back_s", t.swing_back_s}, {"link_rad_per_s", real(t.link_rad_per_s)}, {"distance_m", real(t.distance_m())}});
  }
  for (const SettleResult& s : r.settles) add("settle", s.preset, {{"settled_s", real(s.settled_s)}, {"way_rad", real(s.way_rad)}});
  for (const HoldResult& h : r.holds) add("hold", h.preset, {{"energy_J", real(h.energy_J)}, {"sag_rad", real(h.sag_rad)}});
  return out;
}

}  // namespace

double ThrowResult::distance_m() const { return std::pow(kArm_m * link_rad_per_s, 2) / kGravity_m_per_s2; }

std::optional<ThrowResult> TaskResults::farthest() const {
  return best_of(
      throws, [](const ThrowResult& r) { return r.link_rad_per_s > 0; },
      [](const auto& a, const auto& b) { return a.link_rad_per_s < b.link_rad_per_s; });
}

std::optional<SettleResult> TaskResults::soonest() const {
  return best_of(
      settles, [](const SettleResult& r) { return std::isfinite(r.settled_s); },
      [](const auto& a, const auto& b) { return a.settled_s > b.settled_s; });
}

std::optional<HoldResult> TaskResults::cheapest() const {
  return best_of(
      holds, [](const HoldResult& r) { return std::isfinite(r.energy_J); },
      [](const auto& a, const auto& b) { return a.energy_J > b.energy_J; });
}

Tasks plan_tasks(const TaskOptions& options) {
  Problems problems;
  check(options, problems);
  Tasks out;
  out.step_s = options.step_s;
  for (const std::string& name : options.types.empty() ? options.library.names() : options.types) {
    try {
      config::ActuatorType type = options.library.load(name, options.overrides);
      if (type.unit.actuator.linear()) {
        std::vector<config::Override> mounted = options.overrides;
        mounted.push_back({"shaft.pinion_m", fmt::format("{}", kBenchPinion_m)});
        type = options.library.load(name, mounted);
      }
      out.each.push_back(planned(std::move(type), options));
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  if (out.each.empty() && problems.empty())
    problems.add({"", "--types", "", "no actuator types found", "set VSA_ACTUATOR_PATH or VSA_DATA_DIR"});
  problems.throw_if_any();
  return out;
}

std::string to_json(const Tasks& tasks, const std::string& command) {
  Json out = page::results_head(command);
  out["step_s"] = tasks.step_s;
  out["types"] = Json::array();
  for (const TaskResults& r : tasks.each) out["types"].push_back(type_json(r));
  return page::results_text(out);
}

}  // namespace vsa::study
