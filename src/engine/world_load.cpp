// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// From a file to a World: read, build the robots, compile, and remember the first sample. All problems are thrown at once.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vsa/config/plugin_xml.hpp"
#include "world_cache.hpp"
#include "world_impl.hpp"

namespace vsa::engine {
namespace {

constexpr double kStepMin_s = 1e-6, kStepMax_s = 16e-3;

std::int64_t step_ns(const WorldOptions& options, const WorldDescription& world, const std::string& file, Problems& problems) {
  const double step_s = options.step_s.value_or(world.step_s);
  if (!(step_s >= kStepMin_s && step_s <= kStepMax_s)) {
    problems.add({options.step_s ? "" : file, options.step_s ? "step_s" : "physics/max_step_size", fmt::format("{}", step_s),
                  "step out of range", fmt::format("{} … {} s", kStepMin_s, kStepMax_s)});
    return 1'000'000;
  }
  return std::llround(step_s * 1e9);
}

/// Joints as a plugin in `model` may name them: relative to that model.
std::vector<std::pair<std::string, std::size_t>> joints_under(const WorldDescription& world, const std::string& model) {
  std::vector<std::pair<std::string, std::size_t>> out;
  const std::string prefix = model + "::";
  for (std::size_t j = 0; j < world.joints.size(); ++j) {
    if (world.joints[j].name.rfind(prefix, 0) == 0) out.emplace_back(world.joints[j].name.substr(prefix.size()), j);
  }
  return out;
}

struct RobotBuilder {
  const WorldDescription& world;
  const config::PresetLibrary& presets;
  const config::Replacement& actuator;
  std::string file;
  Problems& problems;

  /// The joints of the config's actuators; empty where one isn't there.
  std::vector<std::size_t> match(const host::RobotConfig& config, const Plugin& plugin, const std::string& where) {
    const auto known = joints_under(world, plugin.model);
    std::vector<std::string> names;
    for (const auto& [name, index] : known) names.push_back(name);
    const std::size_t before = problems.list().size();
    config::check_joints(config, names, where, problems);
    std::vector<std::size_t> out;
    for (const host::ActuatorConfig& a : config.actuators) {
      const auto it = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.first == a.joint; });
      if (it == known.end()) continue;
      check_drivable(it->second, "actuator[" + a.name + "]/joint", a.joint, where);
      out.push_back(it->second);
    }
    return problems.list().size() == before ? out : std::vector<std::size_t>{};
  }

  /// The laws' positions are angles, their outputs torques.
  void check_drivable(std::size_t joint, const std::string& key, const std::string& name, const std::string& where) {
    const Joint& j = world.joints[joint];
    const bool follows =
        std::any_of(world.couplings.begin(), world.couplings.end(), [&](const Coupling& k) { return k.follower == joint; });
    const char* wrong = j.kind == Joint::Kind::fixed   ? "can't move: it is fixed, or its limits leave it no room"
                        : j.kind == Joint::Kind::slide ? "is prismatic: the actuators' laws are for angles and torques"
                        : !j.one_axis()                ? "isn't a joint with one axis"
                        : follows                      ? "follows another joint (<mimic>)"
                                                       : nullptr;
    if (wrong != nullptr) problems.add({where, key, name, wrong, "a revolute or continuous joint that follows no other"});
  }

  /// An actuator whose text gives no equilibrium starts where its joint does, so that its springs aren't wound up.
  void start_with_joints(host::RobotConfig& config, const std::vector<std::size_t>& joints, const Plugin& plugin,
                         const std::string& where) {
    tinyxml2::XMLDocument xml;
    if (xml.Parse(plugin.xml.c_str()) != tinyxml2::XML_SUCCESS || xml.RootElement() == nullptr) return;
    const tinyxml2::XMLElement* e = xml.RootElement()->FirstChildElement("actuator");
    for (std::size_t i = 0; i < joints.size(); ++i, e = e == nullptr ? e : e->NextSiblingElement("actuator")) {
      const double start = world.joints[joints[i]].axes[0].start.value_or(0);
      const tinyxml2::XMLElement* initial = e == nullptr ? nullptr : e->FirstChildElement("initial");
      if (start == 0 || (initial != nullptr && initial->Attribute("equilibrium_rad") != nullptr)) continue;
      if (std::abs(start) > std::numbers::pi)
        problems.add({where, "actuator[" + config.actuators[i].name + "]/initial@equilibrium_rad", "",
                      fmt::format("is needed: its joint starts at {} rad", start), "an equilibrium near the joint's start"});
      config.actuators[i].initial_equilibrium_rad = start;
    }
  }

  std::optional<RobotSlot> build(const Plugin& plugin) {
    const std::string where = file + ": " + plugin.model;
    try {
      host::RobotConfig config = config::parse_plugin(plugin.xml, where, presets, actuator);
      std::vector<std::size_t> joints = match(config, plugin, where);
      if (joints.size() != config.actuators.size()) return std::nullopt;
      start_with_joints(config, joints, plugin, where);
      const std::size_t n = joints.size();
      return RobotSlot{plugin.model,
                       host::Robot(std::move(config)),
                       std::move(joints),
                       std::vector<host::JointIn>(n),
                       std::vector<double>(n),
                       {},
                       Mobility{}};
    } catch (const InputError& error) {
      problems.add_all(error);
      return std::nullopt;
    }
  }
};

/// A joint belongs to one robot; within a plugin config:: has looked already.
void check_shared_joints(const std::vector<RobotSlot>& robots, const WorldDescription& world, const std::string& file,
                         Problems& problems) {
  std::vector<std::size_t> seen;
  for (const RobotSlot& slot : robots) {
    for (const std::size_t j : slot.joints) {
      if (std::find(seen.begin(), seen.end(), j) != seen.end()) {
        problems.add({file, slot.model, world.joints[j].name, "two plugins drive this joint", "one actuator a joint"});
      }
    }
    seen.insert(seen.end(), slot.joints.begin(), slot.joints.end());
  }
}

}  // namespace

void World::Impl::add_robots(const std::string& file, Problems& problems) {
  if (!options.actuators) return;
  RobotBuilder builder{*world, options.presets, options.actuator, file, problems};
  for (const Plugin& plugin : world->plugins) {
    std::optional<RobotSlot> slot = builder.build(plugin);
    if (!slot) continue;
    for (std::size_t i = 0; i < slot->joints.size(); ++i) {
      actuators.push_back({plugin.top_model, slot->robot.config().actuators[i].name, robots.size(), i});
    }
    robots.push_back(std::move(*slot));
  }
  check_shared_joints(robots, *world, file, problems);
}

/// One number for all: engine and robots step together.
void World::Impl::find_substeps(const std::string& file, Problems& problems) {
  const RobotSlot* first = nullptr;
  for (const RobotSlot& slot : robots) {
    const std::optional<int> n = slot.robot.config().substeps;
    if (!n) continue;
    if (first != nullptr && *n != substeps) {
      problems.add({file, "substeps", fmt::format("{} of {}, {} of {}", substeps, first->model, *n, slot.model),
                    "robots of one world can't have different ones", "one number, or given once"});
      return;
    }
    first = &slot;
    substeps = *n;
  }
  const std::int64_t least_ns = std::llround(kStepMin_s * 1e9);
  if (first == nullptr || (dt_ns % substeps == 0 && substep_ns() >= least_ns)) return;
  problems.add({file + ": " + first->model, "substeps", fmt::format("{}", substeps),
                fmt::format("can't divide the world's step of {} ns", dt_ns),
                fmt::format("what leaves whole nanoseconds, at least {}", least_ns)});
}

std::unique_ptr<World::Impl> World::Impl::load(const SdfSource& source, WorldOptions options) {
  auto impl = std::make_unique<World::Impl>();
  impl->options = std::move(options);
  Problems problems;
  const std::shared_ptr<ReadWorld> file = read_world(source, impl->options, problems);
  impl->world = file->world;
  impl->warnings = file->warnings;
  impl->dt_ns = step_ns(impl->options, *impl->world, source.label(), problems);
  impl->add_robots(source.label(), problems);
  impl->find_substeps(source.label(), problems);
  problems.throw_if_any();
  const auto compiled = file->compiled(impl->substep_s(), source.label(), problems);
  problems.throw_if_any();
  impl->physics = compiled->start();
  impl->join_trees();
  for (std::size_t j = 0; j < impl->world->joints.size(); ++j) {
    const Joint& joint = impl->world->joints[j];
    if (joint.one_axis() && joint.axes[0].start) impl->physics->set_joint(j, {*joint.axes[0].start, 0});
  }
  impl->index_names();
  impl->initial = impl->snapshot();
  return impl;
}

World World::load(const std::filesystem::path& sdf, WorldOptions options) {
  std::filesystem::path file = sdf;
  // A bare name that is no file here may be a built-in world's.
  if (!sdf.has_parent_path() && !std::filesystem::exists(sdf)) {
    if (auto built_in = config::find_data("models/worlds" / sdf)) file = *built_in;
  }
  return World(Impl::load({file, {}}, std::move(options)));
}

World World::load_string(std::string_view sdf, WorldOptions options) { return World(Impl::load({{}, sdf}, std::move(options))); }

}  // namespace vsa::engine
