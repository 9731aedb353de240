// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// From a file to a World: read, build the robots, compile, and remember the first sample. All problems are thrown at once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/world_cache.hpp"
#include "engine/world_impl.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::engine {
namespace {

using description::Joint;

std::int64_t step_ns(const WorldOptions& options, const description::World& world, const std::string& file, Problems& problems) {
  const double step_s = options.step_s.value_or(world.step_s);
  if (!(step_s >= kShortestStep_s && step_s <= kLongestStep_s)) {
    const char* key = options.step_s ? "step_s" : world.native ? "option@timestep" : "physics/max_step_size";
    problems.add(
        {options.step_s ? "" : file, key, fmt::format("{}", step_s), "step out of range",
         fmt::format("{} … {} s{}", kShortestStep_s, kLongestStep_s, options.step_s ? "" : ", here or as step_s (--step-s)")});
    return 1'000'000;
  }
  return std::llround(step_s * 1e9);
}

void check_choices(const WorldOptions& options, Problems& problems) {
  if (options.concave != Concave::refuse && options.concave != Concave::hull && options.concave != Concave::decompose)
    problems.add(
        {"", "concave", fmt::format("{}", static_cast<int>(options.concave)), "no such choice", "refuse, hull, decompose"});
  if (options.impossible_inertia != ImpossibleInertia::refuse && options.impossible_inertia != ImpossibleInertia::lower)
    problems.add({"", "impossible_inertia", fmt::format("{}", static_cast<int>(options.impossible_inertia)), "no such choice",
                  "refuse, lower"});
}

/// Empty: an actuator can drive it.
std::string refusal_of(const description::World& world, std::size_t joint) {
  const Joint& j = world.joints[joint];
  const bool follows = std::any_of(world.couplings.begin(), world.couplings.end(),
                                   [&](const description::Coupling& k) { return k.follower == joint; });
  return j.closes                       ? "closes a kinematic loop and has no angle"
         : j.kind == Joint::Kind::fixed ? "can't move: it is fixed, or its limits leave it no room"
         : !j.one_axis()                ? "isn't a joint with one axis"
         : follows                      ? "follows another joint (<mimic> or <equality>)"
                                        : "";
}

/// Joints as a plugin in `model` may name them: relative to that model. `index`: of each in the world, which `owner` steps.
std::vector<seat::Joint> joints_under(const description::World& world, const void* owner, const std::string& model,
                                      std::vector<std::size_t>& index) {
  std::vector<seat::Joint> out;
  const std::vector<Joint>& joints = world.joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto name = relative_to(model, joints[j].name);
    if (!name) continue;
    index.push_back(j);
    out.push_back({std::string(*name), {owner, j}, refusal_of(world, j), std::nullopt});
    if (joints[j].one_axis()) out.back().start_rad = joints[j].axes[0].start;
    out.back().slides = joints[j].kind == Joint::Kind::slide;
  }
  return out;
}

}  // namespace

void World::Impl::add_robots(const std::string& file, Problems& problems) {
  if (!options.actuators) return;
  const seat::Options with{options.types, options.actuator, {}, true, false};
  const bool all_joints = problems.empty();
  for (const description::Plugin& plugin : world->plugins) {
    try {
      if (!all_joints) {  // of a file with errors some may be missing: no word on those
        (void)config::parse_plugin(plugin.xml, file + ": " + plugin.model, options.types, options.actuator);
        continue;
      }
      std::vector<std::size_t> index;
      const std::vector<seat::Joint> joints = joints_under(*world, this, plugin.model, index);
      RobotSlot slot;
      slot.seat = std::make_unique<seat::Seat>(seat::Model{plugin.xml, file + ": " + plugin.model, plugin.model, joints}, with);
      for (const std::size_t j : slot.seat->joints()) slot.joints.push_back(index[j]);
      for (std::size_t i = 0; i < slot.joints.size(); ++i)
        actuators.push_back({plugin.top_model, slot.robot().config().actuators[i].name, robots.size(), i});
      if (slot.robot().config().record)
        warnings.push_back(plugin.model + ": <record> is for a Gazebo: here `vsa run --record` does it");
      if (slot.robot().config().view_port)
        warnings.push_back(plugin.model + ": <view> is for a Gazebo: here `vsa run --view` does it");
      for (const std::string& notice : slot.robot().config().notices) {
        if (std::find(warnings.begin(), warnings.end(), notice) == warnings.end()) warnings.push_back(notice);
      }
      const auto same = [&](const RobotSlot& other) { return other.seat->model() == plugin.model; };
      if (std::count_if(robots.begin(), robots.end(), same) == 1)
        warnings.push_back(plugin.model +
                           ": several vsa::Robot plug-ins share the model's topics, so that a command of all actuators " +
                           "goes to each: one plug-in with all actuators is meant");
      robots.push_back(std::move(slot));
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
}

/// What is deep in something else at the start is thrown out of it, or is pressed against it for ever by its actuators.
void World::Impl::tell_overlaps() {
  constexpr double kDeep_m = 5e-3;
  std::vector<scene::Overlap> all = physics->overlaps();
  std::erase_if(all, [](const scene::Overlap& o) { return o.depth_m <= kDeep_m; });
  if (all.empty()) return;
  const auto deepest = std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.depth_m < b.depth_m; });
  std::string more;
  if (all.size() > 1) more = fmt::format(" and {} more", all.size() - 1);
  warnings.push_back(fmt::format("shapes that collide are in each other from the start: {} and {} by {:.3g} mm{}",
                                 world->links[deepest->link].name, world->links[deepest->other].name, deepest->depth_m * 1e3,
                                 more));
}

/// One number for all: engine and robots step together.
void World::Impl::find_substeps(const std::string& file, Problems& problems) {
  const RobotSlot* first = nullptr;
  for (const RobotSlot& slot : robots) {
    const std::optional<int> n = slot.robot().config().substeps;
    if (!n) continue;
    if (first != nullptr && *n != substeps) {
      problems.add({file, "substeps", fmt::format("{} of {}, {} of {}", substeps, first->seat->model(), *n, slot.seat->model()),
                    "robots of one world can't have different ones", "one number, or given once"});
      return;
    }
    first = &slot;
    substeps = *n;
  }
  const std::int64_t least_ns = std::llround(kShortestStep_s * 1e9);
  if (first == nullptr || (dt_ns % substeps == 0 && substep_ns() >= least_ns)) return;
  problems.add({file + ": " + first->seat->model(), "substeps", fmt::format("{}", substeps),
                fmt::format("can't divide the world's step of {} ns", dt_ns),
                fmt::format("what leaves whole nanoseconds, at least {}", least_ns)});
}

std::unique_ptr<World::Impl> World::Impl::load(const reader::SdfSource& source, WorldOptions options) {
  auto impl = std::make_unique<World::Impl>();
  impl->options = std::move(options);
  Problems problems;
  check_choices(impl->options, problems);
  problems.throw_if_any();
  const std::shared_ptr<ReadWorld> file = read_world(source, impl->options, problems);
  impl->world = file->world;
  impl->warnings = file->warnings;
  impl->add_robots(source.label(), problems);
  impl->dt_ns = step_ns(impl->options, *impl->world, source.label(), problems);
  impl->find_substeps(source.label(), problems);
  problems.throw_if_any();
  const auto compiled = file->compiled(impl->substep_s(), source.label(), problems);
  problems.throw_if_any();
  impl->physics = compiled->start();
  impl->before.resize(impl->physics->state_size());
  impl->join_trees();
  for (std::size_t j = 0; j < impl->world->joints.size(); ++j) {
    const description::Joint& joint = impl->world->joints[j];
    if (joint.one_axis() && joint.axes[0].start) impl->physics->set_joint(j, {*joint.axes[0].start, 0});
  }
  impl->tell_open_loops();
  impl->tell_overlaps();
  impl->index_names();
  // Whatever a unit was told first: its shaft is where the file has the joint.
  for (const RobotSlot& slot : impl->robots) {
    impl->tell_joints(slot);
    for (std::size_t i = 0; i < slot.joints.size(); ++i) slot.robot().relocate(i, slot.seat->in()[i].angle_rad);
  }
  impl->initial = impl->snapshot();
  return impl;
}

World World::load(const std::filesystem::path& sdf, WorldOptions options) {
  return World(Impl::load({config::find_file(sdf.string(), "world", "models/worlds", ".sdf"), {}}, std::move(options)));
}

World World::load_string(std::string_view sdf, WorldOptions options) { return World(Impl::load({{}, sdf}, std::move(options))); }

}  // namespace vsa::engine
