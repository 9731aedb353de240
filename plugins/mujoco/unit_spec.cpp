// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit_spec.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "vsa/config/plugin_draft.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::mujoco {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestName = 120;  // a line's gets a few letters more
constexpr int kLeastBaud = 9600, kMostBaud = 10'000'000;
constexpr double kLongestCycle_s = 10;

bool is_file(std::string_view type) { return type.find('/') != std::string_view::npos || type.ends_with(".toml"); }

std::string type_name(const UnitSpec& unit) {
  const std::string type(unit.get("type"));
  return is_file(type) ? fs::path(type).stem().string() : type;
}

std::vector<config::Override> overrides_of(const UnitSpec& unit) {
  std::istringstream words{std::string(unit.get("override"))};
  std::vector<std::string> texts;
  for (std::string word; words >> word;) texts.push_back(word);
  return config::parse_overrides(texts, where(unit) + ": override");
}

/// A name that a robot takes: instances may have any.
std::string actuator_name(const UnitSpec& unit) {
  std::string out = unit.name.substr(0, kLongestName);
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' ||
           c == ':';
  };
  std::replace_if(
      out.begin(), out.end(), [&](char c) { return !good(c); }, '_');
  return out;
}

class Reader {
 public:
  explicit Reader(Problems& problems) : problems_(problems) {}

  config::RobotDraft read(std::span<const UnitSpec> units, std::span<const std::string> joints,
                          const config::TypeLibrary& library) {
    config::RobotDraft out;
    for (std::size_t i = 0; i < units.size(); ++i) {
      try {
        out.actuators.push_back(actuator(units[i], joints[i], type_of(units[i], library)));
      } catch (const InputError& error) {
        problems_.add_all(error);
      }
    }
    for (const auto& [name, line] : lines_) out.buses.push_back(line.draft);
    return out;
  }

 private:
  struct Line {
    config::BusDraft draft;
    std::string baud, cycle;  ///< as the first unit that says it does
  };

  config::ActuatorDraft actuator(const UnitSpec& unit, const std::string& joint, const config::ActuatorType& type) {
    config::ActuatorDraft out;
    out.path = unit.name;
    out.name = actuator_name(unit);
    out.name_ok = true;
    out.joint = joint;
    out.type = type_name(unit);
    out.overrides = overrides_of(unit);
    out.bus = line_of(unit);
    if (!unit.get("id").empty()) {
      out.id = whole(unit, "id", 1, config::kMaxId);
      out.id_ok = out.id.has_value();
    }
    if (const auto q = number(unit, "equilibrium")) {
      out.equilibrium_given = true;
      out.equilibrium_key = type.unit.actuator.linear() ? "equilibrium_m" : "equilibrium_rad";
      out.initial_equilibrium = *q;
    }
    if (const auto p = number(unit, "preset")) {
      out.initial_preset_key = config::preset_attribute(type.unit.preset_unit());
      out.initial_preset = *p;
      if (out.initial_preset_key.empty()) refuse(unit, "preset", type.name + " has no preset", "leave it out");
    }
    return out;
  }

  /// The name of its line, to which it adds what it says of it.
  std::string line_of(const UnitSpec& unit) {
    const std::string_view given = unit.get("bus");
    std::string name = given.empty() ? "line:" + actuator_name(unit) : std::string(given);
    Line& line = lines_[name];
    line.draft.name = name;
    line.draft.path = "bus " + name;
    if (says(unit, "baud", line.baud)) line.draft.baud_Hz = whole(unit, "baud", kLeastBaud, kMostBaud).value_or(2'000'000);
    if (says(unit, "cycle_s", line.cycle) && line.cycle != "auto") {
      line.draft.cycle_s = number(unit, "cycle_s");
      if (line.draft.cycle_s && !(*line.draft.cycle_s > 0 && *line.draft.cycle_s <= kLongestCycle_s))
        refuse(unit, "cycle_s", "is out of range", "auto, or up to 10 s");
    }
    return name;
  }

  /// Whether the unit is the first of its line that says this.
  bool says(const UnitSpec& unit, const char* key, std::string& of_line) {
    const std::string_view said = unit.get(key);
    if (said.empty() || said == of_line) return false;
    if (!of_line.empty()) {
      refuse(unit, key, "another unit of this line says otherwise", of_line);
      return false;
    }
    of_line = said;
    return true;
  }

  std::optional<double> number(const UnitSpec& unit, const char* key) {
    const std::string_view text = unit.get(key);
    if (text.empty()) return std::nullopt;
    const auto value = config::parse_number(text);
    if (!value) refuse(unit, key, "isn't a number", "a number");
    return value;
  }

  std::optional<int> whole(const UnitSpec& unit, const char* key, int min, int max) {
    const auto value = config::parse_integer(unit.get(key));
    if (value && *value >= min && *value <= max) return static_cast<int>(*value);
    refuse(unit, key, "isn't a whole number of its range", config::range_text(min, max));
    return std::nullopt;
  }

  void refuse(const UnitSpec& unit, const char* key, const std::string& message, const std::string& allowed) {
    problems_.add({where(unit), key, std::string(unit.get(key)), message, allowed});
  }

  Problems& problems_;
  std::map<std::string, Line> lines_;
};

}  // namespace

std::string_view UnitSpec::get(std::string_view key) const {
  const auto at = said.find(key);
  return at == said.end() ? std::string_view{} : config::trim(at->second);
}

std::string where(const UnitSpec& unit) { return "vsasim.unit " + unit.name; }

config::TypeLibrary library_for(std::span<const UnitSpec> units) {
  config::TypeLibrary standard;
  std::vector<fs::path> directories;
  for (const UnitSpec& unit : units) {
    const std::string type(unit.get("type"));
    if (!is_file(type)) continue;
    const fs::path folder = fs::absolute(type).lexically_normal().parent_path();
    if (std::find(directories.begin(), directories.end(), folder) == directories.end()) directories.push_back(folder);
  }
  if (directories.empty()) return standard;
  directories.insert(directories.end(), standard.directories().begin(), standard.directories().end());
  return config::TypeLibrary(std::move(directories));
}

config::ActuatorType type_of(const UnitSpec& unit, const config::TypeLibrary& library) {
  const std::string type(unit.get("type"));
  if (type.empty()) throw InputError({where(unit), "type", "", "is missing", "an actuator type: " + config::join(library.names())});
  if (is_file(type)) {
    std::error_code error;
    if (!fs::is_regular_file(type, error)) throw InputError({where(unit), "type", type, "there is no such file", "a type's file"});
    const fs::path found = library.find(type_name(unit));
    if (!fs::equivalent(found, type, error))
      throw InputError({where(unit), "type", type, "another type of this name is found before it: " + found.string(),
                        "names that differ, or files of one folder"});
  }
  try {
    return library.load(type_name(unit), overrides_of(unit));
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) p.file = p.file.empty() ? where(unit) : where(unit) + ": " + p.file;
    throw InputError(problems);
  }
}

std::size_t controls_of(const config::ActuatorType& type) {
  if (type.unit.is(control::ServoKind::motor_voltages))
    return static_cast<std::size_t>(type.unit.actuator.transmission->motor_count());
  return type.unit.preset_unit().empty() ? 1 : 2;
}

host::RobotConfig robot_of(std::span<const UnitSpec> units, std::span<const std::string> joints,
                           const config::TypeLibrary& library) {
  Problems problems;
  const config::RobotDraft draft = Reader(problems).read(units, joints, library);
  problems.throw_if_any();
  host::RobotConfig out = config::finish(draft, "vsasim.unit", library, problems);
  problems.throw_if_any();
  return out;
}

}  // namespace vsa::mujoco
