// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scenario/scenario.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "vsa/checks.hpp"
#include "vsa/config/faults_text.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/motion/gait_text.hpp"
#include "vsa/scoped_name.hpp"
#include "vsa/units.hpp"

namespace vsa::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kTravelWindow_s = 1.3;  // where no gait tells its period; close to Table II's 2π/4.71 s
constexpr std::uint64_t kSeedsApart = 1000;
constexpr std::string_view kBlanks = " \t\n\r\f\v";

engine::Concave concave_of(const std::string& text) {
  return text == "hull" ? engine::Concave::hull : text == "decompose" ? engine::Concave::decompose : engine::Concave::refuse;
}

engine::ImpossibleInertia impossible_inertia_of(const std::string& text) {
  return text == "lower" ? engine::ImpossibleInertia::lower : engine::ImpossibleInertia::refuse;
}

/// Flags come behind the scenario's own, and of a key the last said counts.
std::vector<config::Override> last_of_each(const std::vector<config::Override>& all) {
  std::vector<config::Override> out;
  for (auto o = all.begin(); o != all.end(); ++o)
    if (std::none_of(o + 1, all.end(), [&](const config::Override& later) { return later.key == o->key; })) out.push_back(*o);
  return out;
}

/// Where a fault says its seed, as a word of its own.
bool has_seed(std::string_view fault) {
  const std::size_t at = fault.find("seed=");
  return at != std::string_view::npos && at > 0 && kBlanks.find(fault[at - 1]) != std::string_view::npos;
}

}  // namespace

void validate(const Scenario& s, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  if (s.duration_s) check.within("duration_s", *s.duration_s, kShortest_s, kLongest_s);
  if (s.step_s) check.within("step_s", *s.step_s, engine::kShortestStep_s, engine::kLongestStep_s);
  if (s.seed) check.within("seed", static_cast<double>(*s.seed), 0, kLargestSeed);
  if (concave_of(s.concave) == engine::Concave::refuse && s.concave != "refuse")
    check.refuse("concave", s.concave, "is not one of the words", "refuse, hull, decompose");
  if (impossible_inertia_of(s.impossible_inertia) == engine::ImpossibleInertia::refuse && s.impossible_inertia != "refuse")
    check.refuse("impossible_inertia", s.impossible_inertia, "is not one of the words", "refuse, lower");
  double before = 0;
  for (const Command& c : s.commands) {
    check.within("command.time_s", c.time_s, 0, kLongest_s);
    if (c.time_s < before) check.refuse("command.time_s", Checks::text(c.time_s), "is before the last one", "in order of time");
    before = c.time_s;
    if (c.equilibrium_rad) check.finite("command.equilibrium_rad", *c.equilibrium_rad);
    if (c.preset_rad) check.finite("command.preset_rad", *c.preset_rad);
    if (!c.equilibrium_rad && !c.preset_rad)
      check.refuse("command.equilibrium_rad", "", "commands nothing", "equilibrium_rad, preset_rad or both");
  }
}

engine::World load_world(const Scenario& scenario) {
  Problems problems;
  validate(scenario, "", problems);
  problems.throw_if_any();
  engine::WorldOptions with;
  with.step_s = scenario.step_s;
  with.concave = concave_of(scenario.concave);
  with.impossible_inertia = impossible_inertia_of(scenario.impossible_inertia);
  with.actuator.flag = scenario.scenario.empty() ? "--set" : "--set or [set]";
  with.actuator.overrides = last_of_each(config::parse_overrides(scenario.set, with.actuator.flag));
  if (!scenario.type.empty()) {
    with.actuator.type = scenario.type;
    static_cast<void>(with.types.load(scenario.type, with.actuator.overrides));  // its problems, once and by their own names
  }
  return engine::World::load(config::find_file(scenario.world, "world", "models/worlds", ".sdf"), std::move(with));
}

std::optional<motion::Gait> load_motion(const Scenario& scenario) {
  const fs::path file = scenario.gait.empty() ? fs::path() : config::find_file(scenario.gait, "gait", "models/gaits", ".toml");
  if (scenario.motion.empty()) return file.empty() ? std::nullopt : std::optional(motion::Gait::load(file));
  toml::table whole = toml::parse(scenario.motion);
  if (!file.empty()) whole.insert("base", fs::absolute(file).string());
  std::ostringstream text;
  text << whole;
  try {
    return motion::parse_gait(text.str(), scenario.scenario);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) {
      if (p.file == scenario.scenario) p.key = "motion." + p.key;
    }
    throw InputError(std::move(problems));
  }
}

std::vector<std::string> seeded_faults(const Scenario& scenario) {
  std::vector<std::string> faults = scenario.faults;
  for (std::size_t i = 0; scenario.seed && i < faults.size(); ++i) {
    if (!has_seed(faults[i])) faults[i] += " seed=" + std::to_string(*scenario.seed + kSeedsApart * i);
  }
  return faults;
}

namespace {

/// Those that a fault's first word names.
std::vector<engine::ActuatorRef> broken_by(const engine::World& world, const std::string& who, const std::string& source) {
  if (world.actuators().empty()) throw InputError({"", source, who, "the world has no actuator", ""});
  if (who == "all") return world.actuators();
  try {
    return {world.actuator(who)};
  } catch (const InputError& error) {
    Problem problem = error.problems().front();
    problem.key = source;
    problem.allowed = "all, " + problem.allowed;
    throw InputError(std::move(problem));
  }
}

}  // namespace

void break_robots(engine::World& world, const std::vector<std::string>& faults) {
  constexpr const char* kSource = "--fault";
  Problems problems;
  for (const std::string& text : faults) {
    const std::string_view trimmed = config::trim(text);
    const std::size_t end = std::min(trimmed.find_first_of(kBlanks), trimmed.size());
    try {
      device::Faults each = config::read_faults(trimmed.substr(end), kSource);
      const std::vector<engine::ActuatorRef> who = broken_by(world, std::string(trimmed.substr(0, end)), kSource);
      for (const engine::ActuatorRef& a : who) world.robot(a.robot).check_faults(a.index, each);
      for (const engine::ActuatorRef& a : who) {
        world.robot(a.robot).set_faults(a.index, each);
        ++each.seed;  // actuators have their own luck
      }
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
}

std::string travelling_model(const engine::World& world) {
  if (world.robot_count() == 0) return "";
  const std::string_view model = outermost(world.robot_model(0));
  const auto& links = world.links();
  const bool free = std::any_of(links.begin(), links.end(), [&](const auto& l) {
    return l.model == model && !l.is_static && world.free_dof(world.link(l.name)).has_value();
  });
  return std::string(free ? model : "");
}

double travel_window_s(const motion::Gait* gait) {
  return gait != nullptr && gait->params().frequency_rad_per_s > 0 ? 2 * kPi / gait->params().frequency_rad_per_s : kTravelWindow_s;
}

}  // namespace vsa::scenario
