// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::identify {
namespace {

const config::Entry* find(const config::ActuatorType& type, const std::string& key) {
  const auto it = std::find_if(type.entries.begin(), type.entries.end(), [&](const config::Entry& e) { return e.key == key; });
  return it == type.entries.end() ? nullptr : &*it;
}

constexpr const char* kFitting = "keys with a unit and bounds, see vsa actuators ";

std::vector<std::string> keys_of(const config::ActuatorType& type) {
  std::vector<std::string> keys;
  for (const config::Entry& e : type.entries)
    if (e.kind == config::Kind::number) keys.push_back(e.key);
  return keys;
}

/// Adds one key of the type to a parameter: the first gives start and unit.
void add_key(Parameter& parameter, const std::string& key, const config::ActuatorType& type, Problems& problems) {
  const config::Entry* entry = find(type, key);
  if (entry == nullptr) {
    problems.add({"--parameters", key, "", "type " + type.name + " has no such key" + config::did_you_mean(key, keys_of(type)),
                  kFitting + type.name});
    return;
  }
  // Words, switches and whole numbers have no derivative.
  if (entry->kind != config::Kind::number) {
    problems.add({"--parameters", key, entry->value, "isn't a real number, so it can't be identified", kFitting + type.name});
    return;
  }
  if (parameter.keys.empty()) {
    parameter.unit = entry->unit;
    parameter.start = entry->number;
    parameter.min = entry->min;
    parameter.max = entry->max;
  } else if (parameter.unit != entry->unit) {
    problems.add({"--parameters", key, entry->unit, "tied to a key of another unit", parameter.unit});
  }
  parameter.min = std::max(parameter.min, entry->min);
  parameter.max = std::min(parameter.max, entry->max);
  parameter.keys.push_back(key);
}

}  // namespace

double Parameter::coordinate(double value) const { return logarithmic() ? std::log(value) : value; }

double Parameter::value_at(double coordinate) const {
  const double near = 1e-12 * span(), low = this->coordinate(min), high = this->coordinate(max);
  if (coordinate <= low + near) return min;
  if (coordinate >= high - near) return max;
  return std::clamp(logarithmic() ? std::exp(coordinate) : coordinate, min, max);
}

std::vector<Parameter> parse_parameters(const std::string& text, const config::ActuatorType& type) {
  Problems problems;
  std::vector<Parameter> out;
  std::vector<std::string> seen;
  for (const std::string& part : config::split(text, ',')) {
    Parameter parameter;
    parameter.name = std::string(config::trim(part));
    for (const std::string& piece : config::split(part, '=')) {
      const std::string key(config::trim(piece));
      if (key.empty()) {
        problems.add({"--parameters", "", text, "a key is missing", "group.key,group.key=group.key,…"});
      } else if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
        problems.add({"--parameters", key, "", "named twice", "once"});
      } else {
        add_key(parameter, key, type, problems);
      }
      seen.push_back(key);
    }
    if (!parameter.keys.empty() && !(parameter.start >= parameter.min && parameter.start <= parameter.max)) {
      problems.add({"--parameters", parameter.name, config::number_text(parameter.start), "outside its bounds",
                    config::range_text(parameter.min, parameter.max)});
    } else if (!parameter.keys.empty() && !(parameter.min < parameter.max)) {
      problems.add({"--parameters", parameter.name, "", "its bounds leave one value", "bounds with room between them"});
    }
    out.push_back(std::move(parameter));
  }
  problems.throw_if_any();
  return out;
}

std::vector<config::Override> overrides(const std::vector<Parameter>& parameters, const std::vector<double>& values,
                                        const std::vector<config::Override>& also) {
  std::vector<config::Override> out;
  for (const config::Override& o : also) {
    const auto named = [&](const Parameter& p) { return std::find(p.keys.begin(), p.keys.end(), o.key) != p.keys.end(); };
    if (std::none_of(parameters.begin(), parameters.end(), named)) out.push_back(o);
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    for (const std::string& key : parameters[k].keys) out.push_back({key, config::number_text(values[k])});
  }
  return out;
}

namespace {

/// On the grid that the bench's load fills, as vsa characterize has it.
Observation of_samples(const std::string& path, double preset, double load_share) {
  constexpr double kLimit_Nm = 10;  // of what 1 kg gives
  experiment::BranchOptions grid;
  grid.grid_Nm *= load_share;
  grid.max_Nm *= load_share;
  const experiment::LoadRecording samples = experiment::read_load_recording(path, kLimit_Nm * std::max(1.0, load_share));
  Observation out{path, preset, experiment::branches(samples, grid), 1.0};
  const auto beyond = [&](double torque) { return std::abs(torque) > grid.max_Nm + grid.grid_Nm / 2; };
  const auto n = std::count_if(samples.torque_Nm.begin(), samples.torque_Nm.end(), beyond);
  out.beyond = static_cast<double>(n) / static_cast<double>(samples.torque_Nm.size());
  return out;
}

}  // namespace

Observation read_observation(const std::filesystem::path& file, const config::ActuatorType& type) {
  return read_observation(file, type, 1.0);
}

Observation read_observation(const std::filesystem::path& file, const config::ActuatorType& type, double load_share) {
  const std::string path = file.string();
  const auto ends = [&](std::string_view with) {
    return path.size() >= with.size() && path.compare(path.size() - with.size(), with.size(), with) == 0;
  };
  const bool points = ends("_points.csv");
  const std::string unit(type.unit.actuator.transmission->preset_unit());
  const bool linear = type.unit.actuator.linear();
  if (linear && !points)
    throw InputError({path, "file name", "", type.name + " is a linear actuator, of which places at rest are read",
                      "a file NAME_points.csv with load_force_N,deflection_m"});
  if (points && unit.empty()) return {path, 0, experiment::read_points(file, linear), 1.0, true};
  const experiment::NamedPreset named = experiment::preset_of_name(file);
  if (named.unit != unit) {
    throw InputError({path, "file name", named.unit, "the preset isn't in the unit of " + type.name,
                      unit.empty() ? "an actuator with a preset" : unit});
  }
  if (points) return {path, named.value, experiment::read_points(file, linear), 1.0, true};
  if (ends("_branches.csv")) return {path, named.value, experiment::read_branches(file), 1.0};
  return of_samples(path, named.value, load_share);
}

namespace {

std::string measurement_of(const std::string& file) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(file, error);
  std::string out = error ? file : whole.string();
  for (const std::string_view end : {"_branches.csv", "_samples.csv", ".csv"}) {
    if (out.size() < end.size() || out.compare(out.size() - end.size(), end.size(), end) != 0) continue;
    out.resize(out.size() - end.size());
    break;
  }
  return out;
}

bool equal(const std::vector<double>& a, const std::vector<double>& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

}  // namespace

void check_each_once(const std::vector<Observation>& recordings, Problems& problems) {
  for (auto it = recordings.begin(); it != recordings.end(); ++it) {
    const auto again = [&](const Observation& before) {
      const experiment::Branches &a = before.data, &b = it->data;
      return measurement_of(before.name) == measurement_of(it->name) ||
             (before.preset == it->preset && equal(a.torque_Nm, b.torque_Nm) && equal(a.rising_rad, b.rising_rad) &&
              equal(a.falling_rad, b.falling_rad));
    };
    if (const auto first = std::find_if(recordings.begin(), it, again); first != it)
      problems.add({it->name, "", "", "is the measurement of " + first->name + " again", "each measurement once"});
  }
}

namespace {

/// None: no point has a scatter.
std::optional<double> scatter(const experiment::Branches& data) {
  double sum = 0, n = 0;
  for (const auto* scatter : {&data.sd_rising_rad, &data.sd_falling_rad}) {
    for (double s : *scatter) {
      if (!std::isfinite(s)) continue;
      sum += s * s;
      n += 1;
    }
  }
  return n > 0 ? std::optional(std::sqrt(sum / n)) : std::nullopt;
}

}  // namespace

double scatter_weight(const experiment::Branches& data) {
  constexpr double kLeastScatter_rad = 2e-4;  // no recording of a 12-bit encoder is known better
  return 1.0 / std::max(kLeastScatter_rad, scatter(data).value_or(0.0));
}

void weigh_by_scatter(std::span<Observation> observations) {
  double squares = 0, known = 0;
  for (Observation& o : observations) {
    o.weight = scatter_weight(o.data);
    if (!scatter(o.data)) continue;
    squares += o.weight * o.weight;
    known += 1;
  }
  for (Observation& o : observations)
    if (known > 0 && !scatter(o.data)) o.weight = std::sqrt(squares / known);
}

double rounded(double value, int digits) { return config::parse_number(fmt::format("{:.{}e}", value, digits - 1)).value_or(value); }

}  // namespace vsa::identify
