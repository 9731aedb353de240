// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Reads gait files. Every key that nobody asks for is a mistake; all mistakes of a file are reported together.
#include <cmath>

#include "motion/motion_file.hpp"
#include "motion/toml_reader.hpp"
#include "vsa/motion/gait_text.hpp"

namespace vsa::motion {
namespace {

constexpr int kMaxBases = 4;

Bounds bounds(const GaitRange& range, std::optional<double> fallback = {}) { return {range.min, range.max, fallback}; }

/// Tables are merged, everything else is replaced.
void overlay(toml::table& under, const toml::table& over) {
  for (const auto& [key, node] : over) {
    toml::table* below = under[key.str()].as_table();
    const toml::table* above = node.as_table();
    if (below != nullptr && above != nullptr) {
      overlay(*below, *above);
    } else {
      node.visit([&, name = key](const auto& value) { under.insert_or_assign(name, value); });
    }
  }
}

template <class Parse>
toml::table parsed(const std::filesystem::path& file, const Parse& parse) {
  try {
    return parse();
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    const std::string where = line == 0 ? "" : fmt::format("line {}: ", line);
    throw InputError(Problem{file.string(), "", "", where + std::string(error.description()), ""});
  }
}

toml::table with_bases(toml::table own, const std::filesystem::path& file, int depth) {
  const toml::node* node = own.get("base");
  if (node == nullptr) return own;
  const auto base = node->value<std::string>();
  if (!base) throw InputError(Problem{file.string(), "base", "", "not a file name", ""});
  if (depth >= kMaxBases)
    throw InputError(Problem{file.string(), "base", *base, "too many bases one upon the other", fmt::format("{}", kMaxBases)});
  const std::filesystem::path below = file.parent_path() / *base;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(below, ignored)) {
    throw InputError(Problem{file.string(), "base", *base, "no such file", "a gait file beside this one"});
  }
  toml::table whole = with_bases(parsed(below, [&] { return toml::parse_file(below.string()); }), below, depth + 1);
  own.erase("base");
  overlay(whole, own);
  return whole;
}

void read_members(Reader& reader, const toml::table& table, const std::string& scope, GaitGroup& group) {
  const toml::array* names = table["actuators"].as_array();
  const toml::array* numbers = table["n"].as_array();
  if (names == nullptr || names->empty()) reader.problem(scope + "actuators", "", "missing or empty", "a list of actuators");
  if (numbers == nullptr) reader.problem(scope + "n", "", "missing", "a list of whole numbers, one per actuator");
  for (std::size_t i = 0; names != nullptr && i < names->size(); ++i) {
    const auto name = names->get(i)->value<std::string>();
    if (!name) reader.problem(fmt::format("{}actuators[{}]", scope, i), "", "not a text", "");
    group.actuators.push_back(name.value_or(""));
  }
  for (std::size_t i = 0; numbers != nullptr && i < numbers->size(); ++i) {
    const auto n = numbers->get(i)->value_exact<std::int64_t>();
    if (!n || *n < -1000 || *n > 1000)
      reader.problem(fmt::format("{}n[{}]", scope, i), "", "not a whole number in range", "-1000 … 1000");
    group.n.push_back(static_cast<int>(n.value_or(0)));
  }
  if (names != nullptr && numbers != nullptr && group.n.size() != group.actuators.size()) {
    reader.problem(scope + "n", fmt::format("{} numbers", group.n.size()), "not one per actuator",
                   fmt::format("{}", group.actuators.size()));
  }
}

GaitGroup read_group(Reader& reader, const toml::table& table, const std::string& name) {
  const std::string scope = "group." + name + ".";
  reader.only(table, scope, {"actuators", "n", "amplitude_deg", "offset_deg", "lambda", "delta_deg", "preset_deg"});
  GaitGroup group;
  group.name = name;
  read_members(reader, table, scope, group);
  group.amplitude_rad = reader.number(table, scope, "amplitude_deg", bounds(kGaitBounds.amplitude_deg)) * kDegree;
  group.offset_rad = reader.number(table, scope, "offset_deg", bounds(kGaitBounds.offset_deg, 0.0)) * kDegree;
  group.lambda = reader.number(table, scope, "lambda", bounds(kGaitBounds.lambda));
  group.delta_rad = reader.number(table, scope, "delta_deg", bounds(kGaitBounds.delta_deg, 0.0)) * kDegree;
  group.preset_rad = reader.number(table, scope, "preset_deg", bounds(kGaitBounds.preset_deg)) * kDegree;
  return group;
}

SteeringParams read_steering(Reader& reader, const toml::table& table) {
  const std::string scope = "steering.";
  reader.only(table, scope, {"group", "gain", "limit_rad", "slew_rad_per_s", "min_travel_m", "target_deg"});
  SteeringParams s;
  s.group = reader.text(table, scope, "group");
  s.gain = reader.number(table, scope, "gain", {-100, 100});
  s.limit_rad = reader.number(table, scope, "limit_rad", {0, kPi});
  s.slew_rad_per_s = reader.number(table, scope, "slew_rad_per_s", {0, 100});
  s.min_travel_m = reader.number(table, scope, "min_travel_m", {1e-6, 100, 0.03});
  if (table.contains("target_deg")) s.target_rad = reader.number(table, scope, "target_deg", {-360, 360}) * kDegree;
  return s;
}

void check_whole(Reader& reader, const GaitParams& gait) {
  std::set<std::string> seen;
  for (const GaitGroup& group : gait.groups) {
    for (const std::string& name : group.actuators) {
      if (!seen.insert(name).second) reader.problem("group." + group.name + ".actuators", name, "listed twice", "");
    }
  }
  if (!gait.steering) return;
  std::string names;
  for (const GaitGroup& group : gait.groups) {
    if (group.name == gait.steering->group) return;
    names += (names.empty() ? "" : ", ") + group.name;
  }
  reader.problem("steering.group", gait.steering->group, "no such group", names);
}

/// A gait of keyframes has no waves.
Gait load_motion(Reader& reader, Problems& problems, const toml::table& root, const std::string& file) {
  GaitParams gait;
  gait.file = file;
  gait.title = reader.text(root, "", "title");
  gait.period_ns = std::llround(reader.number(root, "", "period_s", {1e-3, 1, 0.01}) * 1e9);
  gait.motion = read_motion(reader, root);
  problems.throw_if_any();
  return Gait(std::move(gait));
}

Gait read_gait(const toml::table& root, const std::filesystem::path& file) {
  Problems problems;
  Reader reader(file.string(), problems);
  if (root.contains("keyframe")) return load_motion(reader, problems, root, file.string());
  reader.only(root, "", {"base", "title", "frequency_rad_per_s", "ramp_s", "period_s", "group", "steering"});
  GaitParams gait;
  gait.file = file.string();
  gait.title = reader.text(root, "", "title");
  gait.frequency_rad_per_s = reader.number(root, "", "frequency_rad_per_s", bounds(kGaitBounds.frequency_rad_per_s));
  gait.ramp_s = reader.number(root, "", "ramp_s", {0, 1000, 0.0});
  gait.period_ns = std::llround(reader.number(root, "", "period_s", {1e-3, 1, 0.01}) * 1e9);
  const toml::table* groups = root["group"].as_table();
  if (groups == nullptr || groups->empty())
    reader.problem("group", "", "missing: a gait needs at least one [group.NAME] or [[keyframe]]", "");
  for (std::size_t i = 0; groups != nullptr && i < groups->size(); ++i) {
    const auto entry = std::next(groups->begin(), static_cast<std::ptrdiff_t>(i));
    const auto& [key, node] = *entry;
    if (node.is_table()) {
      gait.groups.push_back(read_group(reader, *node.as_table(), std::string(key.str())));
    } else {
      reader.problem("group." + std::string(key.str()), "", "not a table", "");
    }
  }
  if (const toml::node* node = root.get("steering"); node != nullptr) {
    if (node->is_table()) gait.steering = read_steering(reader, *node->as_table());
    if (!node->is_table()) reader.problem("steering", "", "not a table", "");
  }
  check_whole(reader, gait);
  problems.throw_if_any();
  return Gait(std::move(gait));
}

}  // namespace

Gait Gait::load(const std::filesystem::path& file) {
  return read_gait(with_bases(parsed(file, [&] { return toml::parse_file(file.string()); }), file, 0), file);
}

Gait parse_gait(std::string_view text, const std::filesystem::path& file) {
  return read_gait(with_bases(parsed(file, [&] { return toml::parse(text, file.string()); }), file, 0), file);
}

}  // namespace vsa::motion
