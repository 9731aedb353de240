// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scenario/toml.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/utf8.hpp"

namespace vsa::scenario {
namespace {

namespace fs = std::filesystem;
using config::TomlSection;

constexpr const char* kWorlds = "models/worlds";
constexpr const char* kGaits = "models/gaits";
constexpr double kAny = std::numeric_limits<double>::max();

/// A file beside the scenario, or a built-in one.
std::string file_at(TomlSection& section, const char* key, const fs::path& scenario, const char* folder, const char* extension) {
  const std::string given = section.text(key).value_or("");
  if (given.empty()) return "";
  try {
    return config::find_file(given, key, folder, extension, scenario.parent_path()).string();
  } catch (const InputError& error) {
    section.add(key, given, error.problems().front().message, error.problems().front().allowed);
    return "";
  }
}

void read_run(TomlSection& s, const fs::path& file, Scenario& out) {
  out.world = file_at(s.need("world", "an SDF, URDF or MJCF file, or a built-in world's name"), "world", file, kWorlds, ".sdf");
  out.duration_s = s.number("duration_s", kShortest_s, kLongest_s);
  out.step_s = s.number("step_s", engine::kShortestStep_s, engine::kLongestStep_s);
  out.type = s.text("type").value_or("");
  out.concave = s.word("concave", {"refuse", "hull", "decompose"}).value_or(out.concave);
  out.impossible_inertia = s.word("impossible_inertia", {"refuse", "lower"}).value_or(out.impossible_inertia);
  if (const auto seed = s.whole("seed", 0, kLargestSeed)) out.seed = static_cast<std::uint64_t>(*seed);
  out.faults = s.texts("faults");
}

/// All but its file is what a gait file may say, too, and read as one.
void read_motion(const toml::table* table, const fs::path& file, Problems& problems, Scenario& out) {
  if (table == nullptr) return;
  TomlSection s(table, file.string(), "motion.", problems);
  out.gait = file_at(s, "file", file, kGaits, ".toml");
  if (table->contains("base")) s.add("base", "", "is for gait files", "file = the gait to begin with");
  toml::table changes(*table);
  changes.erase("file");
  if (changes.empty()) return;
  std::ostringstream text;
  text << changes;
  out.motion = text.str();
}

void read_commands(const std::vector<const toml::table*>& all, const fs::path& file, Problems& problems, Scenario& out) {
  for (const toml::table* table : all) {
    const std::string place = config::place_of(file, *table);
    TomlSection s(table, place, "command.", problems);
    s.need("time_s", "0 … 1e8").need("actuator", "its name");
    Command c;
    c.time_s = s.number("time_s", 0, kLongest_s).value_or(0);
    c.actuator = s.text("actuator").value_or("");
    c.equilibrium_rad = s.number("equilibrium_rad", -kAny, kAny);
    c.preset_rad = s.number("preset_rad", -kAny, kAny);
    s.refuse_others();
    if (s.find("equilibrium_rad") == nullptr && s.find("preset_rad") == nullptr)
      s.add("equilibrium_rad", "", "commands nothing", "equilibrium_rad, preset_rad or both");
    out.commands.push_back(std::move(c));
  }
  const auto earlier = [](const Command& a, const Command& b) { return a.time_s < b.time_s; };
  std::stable_sort(out.commands.begin(), out.commands.end(), earlier);
}

/// A built-in file's name, or the whole path. Throws InputError.
std::string name_of(const fs::path& file, const fs::path& folder) {
  std::error_code differs;
  const auto built_in = config::find_data(folder / file.filename());
  if (built_in && fs::equivalent(*built_in, file, differs)) return file.stem().string();
  std::string name = fs::absolute(file).lexically_normal().string();
  if (!is_utf8(name)) throw InputError({"", "file", name, "can't stand in a scenario, which is UTF-8", "a name in UTF-8"});
  return name;
}

toml::table set_table(const std::vector<std::string>& set) {
  toml::table out;
  for (const std::string& text : set) {
    const std::string key = text.substr(0, text.find('=')), value = text.substr(text.find('=') + 1);
    const auto number = config::parse_number(value);
    // A number that would come back in other digits stays the text that was given.
    if (const auto whole = config::parse_integer(value); whole && std::to_string(*whole) == value) {
      out.insert_or_assign(key, *whole);
    } else if (number && config::number_text(*number) == value) {
      out.insert_or_assign(key, *number);
    } else if (value == "true" || value == "false") {
      out.insert_or_assign(key, value == "true");
    } else {
      out.insert_or_assign(key, value);
    }
  }
  return out;
}

toml::table run_table(const Scenario& o, double duration_s) {
  toml::table out{{"world", name_of(config::find_file(o.world, "world", kWorlds, ".sdf"), kWorlds)}};
  if (duration_s > 0) out.insert("duration_s", duration_s);
  if (o.step_s) out.insert("step_s", *o.step_s);
  if (!o.type.empty()) out.insert("type", o.type);
  if (o.concave != Scenario{}.concave) out.insert("concave", o.concave);
  if (o.impossible_inertia != Scenario{}.impossible_inertia) out.insert("impossible_inertia", o.impossible_inertia);
  if (o.seed) out.insert("seed", static_cast<std::int64_t>(*o.seed));
  toml::array faults;
  for (const std::string& fault : o.faults) faults.push_back(fault);
  if (!faults.empty()) out.insert("faults", std::move(faults));
  return out;
}

toml::table motion_table(const Scenario& o) {
  toml::table out = toml::parse(o.motion);
  if (!o.gait.empty()) out.insert("file", name_of(config::find_file(o.gait, "gait", kGaits, ".toml"), kGaits));
  return out;
}

toml::array commands_array(const Scenario& o) {
  toml::array out;
  for (const Command& c : o.commands) {
    toml::table one{{"time_s", c.time_s}, {"actuator", c.actuator}};
    if (c.equilibrium_rad) one.insert("equilibrium_rad", *c.equilibrium_rad);
    if (c.preset_rad) one.insert("preset_rad", *c.preset_rad);
    out.push_back(std::move(one));
  }
  return out;
}

/// toml++ writes 0.3 with seventeen digits.
std::string with_short_numbers(const std::string& text) {
  constexpr std::size_t kLong = 15;
  std::string out;
  for (const std::string& line : config::split(text, '\n')) {
    const std::size_t at = line.rfind(" = ") + 3;
    const bool fraction = line.find(" = ") != std::string::npos && !config::parse_integer(line.substr(at));
    const auto number = fraction ? config::parse_number(line.substr(at)) : std::nullopt;
    out +=
        (out.empty() ? "" : "\n") + (number && line.size() - at > kLong ? line.substr(0, at) + config::number_text(*number) : line);
  }
  return out;
}

}  // namespace

Scenario read(TomlSection& top, TomlSection& run, const fs::path& file, Problems& problems) {
  Scenario out;
  out.scenario = file.string();
  read_run(run, file, out);
  for (const config::Override& o : top.overrides("set")) out.set.push_back(o.key + '=' + o.value);
  read_motion(top.table("motion"), file, problems, out);
  read_commands(top.tables("command"), file, problems, out);
  return out;
}

std::string text(const Scenario& scenario, double duration_s, const toml::table& own) {
  std::ostringstream out;
  toml::table run = run_table(scenario, duration_s);
  for (const auto& [key, value] : own) run.insert(key, value);
  out << toml::table{{"scenario", std::move(run)}} << '\n';
  if (!scenario.set.empty()) out << '\n' << toml::table{{"set", set_table(scenario.set)}} << '\n';
  if (const toml::table motion = motion_table(scenario); !motion.empty()) out << '\n' << toml::table{{"motion", motion}} << '\n';
  if (!scenario.commands.empty()) out << '\n' << toml::table{{"command", commands_array(scenario)}} << '\n';
  return with_short_numbers(out.str());
}

}  // namespace vsa::scenario
