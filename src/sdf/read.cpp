// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sdf/read.hpp"

#include <sdf/Model.hh>
#include <sdf/Physics.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>

#include "sdf/includes.hpp"
#include "sdf/parse.hpp"
#include "sdf/read_context.hpp"
#include "vsa/config/plugin_xml.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;

void read_physics(ReadContext& c, const sdf::World& world) {
  const sdf::Physics* physics = world.PhysicsDefault();
  if (physics == nullptr) return;
  c.out.step_s = physics->MaxStepSize();
  const sdf::ElementPtr element = physics->Element();
  for (const std::string engine : {"ode", "bullet", "simbody", "dart"}) {
    // A world for several hosts may hold settings for each; what its own type asks for is missed here.
    if (engine == physics->EngineType() && child(element, engine))
      c.notes.add("solver settings of other engines are left out", "physics/" + engine);
  }
}

void read_world_extras(ReadContext& c, const sdf::World& world) {
  const sdf::ElementPtr e = world.Element();
  if (world.ActorCount() > 0) c.notes.add("actors are left out", "world");
  if (!alike(world.WindLinearVelocity(), Vec3::Zero)) c.notes.add("wind is left out", "world");
  for (const char* name : {"population", "road"}) {
    if (child(e, name)) c.problem(child(e, name), std::string("world/") + name, "", "isn't supported");
  }
  for (sdf::ElementPtr p = child(e, "plugin"); p; p = p->GetNextElement("plugin")) {
    const std::string name = p->GetAttribute("name")->GetAsString(), key = "world/plugin[" + name + "]";
    if (name == config::kPluginName) {
      c.problem(p, key, "", "belongs to a model", "in the <model> whose joints it drives");
    } else {
      c.notes.add("foreign plugins are left out", key);
    }
  }
}

void read_root(ReadContext& c, const sdf::Root& root) {
  if (root.WorldCount() > 1) c.problem(nullptr, "world", root.WorldByIndex(1)->Name(), "a second world", "one world a file");
  if (root.WorldCount() > 0) {
    const sdf::World& world = *root.WorldByIndex(0);
    c.out.name = world.Name();
    c.out.gravity = world.Gravity();
    if (!c.out.gravity.IsFinite()) c.problem(world.Element(), "world/gravity", "", "isn't finite", "finite numbers");
    if (world.Element()) {
      read_physics(c, world);
      read_world_extras(c, world);
    }
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) read_model(c, *world.ModelByIndex(i), nullptr);
    if (c.problems.empty()) read_state(c, world);
  } else if (root.Model() != nullptr) {
    c.out.name = "default";
    read_model(c, *root.Model(), nullptr);
  }
  if (c.out.links.empty() && c.problems.empty()) c.problem(nullptr, "", "", "holds no model with a link");
}

}  // namespace

description::World read_sdf(const SdfSource& source, const ReadOptions& options, const Finder& finder, SeenFiles& seen,
                            std::vector<std::string>& warnings, Problems& problems) {
  description::World out;
  if (!is_there(source, problems)) return out;
  const fs::path base = source.path.empty() ? fs::current_path() : fs::absolute(source.path).parent_path();
  Notes notes;
  InputFiles files;
  if (!source.path.empty()) {
    files.call(source.path);
    seen.reads(source.path);
  }
  ReadContext context{
      {out, problems, notes, finder, seen, source.label(), base, options.engine, options.concave, options.impossible_inertia},
      files};
  if (!prepare_files(source, context)) return out;
  sdf::Root root;
  parse_sdf(source, context, root);
  check_sdfs(context, root.Element());
  read_root(context, root);
  check_urdfs_found(context);
  if (problems.empty()) find_direction_frames(context);
  if (problems.empty()) finish_joints(context);
  if (problems.empty()) close_loops(context);
  warnings = notes.texts();
  return out;
}

}  // namespace vsa::reader
