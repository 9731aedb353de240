// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// From a description to MuJoCo's model, and what of a description MuJoCo can honour.
#include <algorithm>

#include "physics/mujoco/mjcf.hpp"
#include "physics/mujoco/physics.hpp"
#include "vsa/description/capabilities.hpp"
#include "vsa/physics/mujoco.hpp"

namespace vsa::physics {
namespace {

class CompiledMujoco final : public CompiledWorld {
 public:
  CompiledMujoco(ModelPtr model, std::shared_ptr<const description::World> world, std::vector<TreeNode> tree)
      : model_(std::move(model)), world_(std::move(world)), tree_(std::move(tree)) {}
  std::unique_ptr<Physics> start() const override { return std::make_unique<MujocoPhysics>(model_, *world_, tree_); }

 private:
  std::shared_ptr<mjModel> model_;
  std::shared_ptr<const description::World> world_;
  std::vector<TreeNode> tree_;
};

description::Capabilities what_it_can() {
  using enum Geometry::Kind;
  description::Capabilities can;
  can.engine = "MuJoCo";
  can.shapes = {box, sphere, cylinder, capsule, ellipsoid, plane, heightmap, mesh};
  can.joints = {Joint::Kind::fixed, Joint::Kind::hinge, Joint::Kind::slide, Joint::Kind::ball, Joint::Kind::universal};
  can.followers = true;
  can.collision_masks = true;
  can.spin_friction = true;
  return can;
}

/// Room to begin with: it grows where it must, and a world that needs little is made and cloned in little time.
Capacity capacity_for(const description::World& world) {
  int moving = 0;
  for (const Link& l : world.links) moving += l.is_static ? 0 : static_cast<int>(l.collisions.size());
  const int contacts = 16 + 2 * std::min(moving, 100);
  return {contacts, 3 * contacts + 100};
}

class Mujoco final : public Engine {
 public:
  const description::Capabilities& capabilities() const override { return can_; }

  std::shared_ptr<const CompiledWorld> compile(const std::shared_ptr<const description::World>& description, double step_s,
                                               std::string_view file, Problems& problems) const override {
    const description::World& world = *description;
    std::vector<TreeNode> tree = build_tree(world, file, problems);
    if (!problems.empty()) return nullptr;
    const Mjcf mjcf = write_mjcf(world, tree, step_s, capacity_for(world));
    std::string reason;
    ModelPtr model = physics::compile(mjcf.xml, mjcf.parts, reason);
    if (!model) {
      problems.add({std::string(file), "", "", "MuJoCo refuses the world: " + reason, ""});
      return nullptr;
    }
    for (std::size_t h = 0; h < mjcf.heightmaps.size(); ++h) {
      const Heightmap& map = *mjcf.heightmaps[h];
      float* to = model->hfield_data + model->hfield_adr[h];
      const double scale = heightmap_scale(map);
      for (const double height : map.heights) *to++ = static_cast<float>(height / scale);
    }
    return std::make_shared<CompiledMujoco>(std::move(model), description, std::move(tree));
  }

 private:
  description::Capabilities can_ = what_it_can();
};

}  // namespace

std::shared_ptr<const Engine> mujoco() { return std::make_shared<Mujoco>(); }

}  // namespace vsa::physics
