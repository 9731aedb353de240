// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit_spec.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "vsa/config/preset_attribute.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::mujoco {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestName = 120;  // a line's gets a few letters more

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

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// A name that the element takes: instances may have any.
std::string element_name(const UnitSpec& unit) {
  std::string out = unit.name.substr(0, kLongestName);
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' ||
           c == ':';
  };
  std::replace_if(
      out.begin(), out.end(), [&](char c) { return !good(c); }, '_');
  return out;
}

std::string attribute(const char* name, std::string_view value) { return std::string(" ") + name + "=\"" + escaped(value) + '"'; }

std::string initial_of(const UnitSpec& unit, const config::ActuatorType& type, Problems& problems) {
  std::string out;
  if (!unit.get("equilibrium").empty())
    out += attribute(type.unit.actuator.linear() ? "equilibrium_m" : "equilibrium_rad", unit.get("equilibrium"));
  if (const std::string_view preset = unit.get("preset"); !preset.empty()) {
    const std::string_view of = type.unit.preset_unit();
    if (of.empty())
      problems.add({where(unit), "preset", std::string(preset), type.name + " has no preset", "leave it out"});
    else
      out += attribute(config::preset_attribute(of).c_str(), preset);
  }
  return out.empty() ? out : "<initial" + out + "/>";
}

/// Lines by their names: what their units say of baud and cycle.
struct Line {
  std::string baud, cycle;
};

class Lines {
 public:
  /// The name of the unit's line.
  std::string add(const UnitSpec& unit, Problems& problems) {
    const std::string_view given = unit.get("bus");
    const std::string name = given.empty() ? "line:" + element_name(unit) : std::string(given);
    Line& line = lines_[name];
    take(unit, "baud", line.baud, problems);
    take(unit, "cycle_s", line.cycle, problems);
    return name;
  }
  [[nodiscard]] std::string elements() const {
    std::string out;
    for (const auto& [name, line] : lines_) {
      out += "<bus" + attribute("name", name);
      if (!line.baud.empty()) out += attribute("baud", line.baud);
      if (!line.cycle.empty()) out += attribute("cycle_s", line.cycle);
      out += "/>";
    }
    return out;
  }

 private:
  static void take(const UnitSpec& unit, const char* key, std::string& of_line, Problems& problems) {
    const std::string_view said = unit.get(key);
    if (said.empty()) return;
    if (!of_line.empty() && of_line != said)
      problems.add({where(unit), key, std::string(said), "another unit of this line says otherwise", of_line});
    of_line = said;
  }
  std::map<std::string, Line> lines_;
};

std::string actuator_of(const UnitSpec& unit, const std::string& joint, const std::string& line, const config::ActuatorType& type,
                        Problems& problems) {
  std::string out = "<actuator" + attribute("name", element_name(unit)) + "><joint>" + escaped(joint) + "</joint><type>" +
                    escaped(type_name(unit)) + "</type><bus";
  if (!unit.get("id").empty()) out += attribute("id", unit.get("id"));
  out += ">" + escaped(line) + "</bus>" + initial_of(unit, type, problems);
  for (const config::Override& o : overrides_of(unit))
    out += "<override" + attribute("key", o.key) + attribute("value", o.value) + "/>";
  return out + "</actuator>";
}

}  // namespace

std::string_view UnitSpec::get(std::string_view key) const {
  const auto at = said.find(key);
  return at == said.end() ? std::string_view{} : config::trim(at->second);
}

std::string where(const UnitSpec& unit) { return "vsasim.unit " + unit.name; }

config::TypeLibrary library_for(std::span<const UnitSpec> units) {
  const config::TypeLibrary standard;
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

std::string element_of(std::span<const UnitSpec> units, std::span<const std::string> joints, const config::TypeLibrary& library) {
  Problems problems;
  Lines lines;
  std::string actuators;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::string line = lines.add(units[i], problems);
    try {
      actuators += actuator_of(units[i], joints[i], line, type_of(units[i], library), problems);
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
  return "<plugin name=\"vsa::Robot\">" + actuators + lines.elements() + "</plugin>";
}

}  // namespace vsa::mujoco
