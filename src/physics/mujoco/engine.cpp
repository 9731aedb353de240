// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// From a description to MuJoCo's model, and what of a description MuJoCo can honour.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "physics/mujoco/mjcf.hpp"
#include "physics/mujoco/mjcf_file.hpp"
#include "physics/mujoco/physics.hpp"
#include "vsa/description/capabilities.hpp"
#include "vsa/physics/mujoco.hpp"

namespace vsa::physics {
namespace {

class CompiledMujoco final : public CompiledWorld {
 public:
  CompiledMujoco(ModelPtr model, std::shared_ptr<const description::World> world, LinkObjects objects, Coriolis coriolis)
      : model_(std::move(model)), world_(std::move(world)), objects_(std::move(objects)), coriolis_(coriolis) {}
  std::unique_ptr<Physics> start() const override { return std::make_unique<MujocoPhysics>(model_, *world_, objects_, coriolis_); }

 private:
  std::shared_ptr<mjModel> model_;
  std::shared_ptr<const description::World> world_;
  LinkObjects objects_;
  Coriolis coriolis_;
};

LinkObjects objects_of(const mjModel& m, const description::World& world) {
  const MjcfNames names{world};
  LinkObjects out;
  out.geoms.resize(static_cast<std::size_t>(m.ngeom));
  for (std::size_t l = 0; l < world.links.size(); ++l) {
    out.body.push_back(mj_name2id(&m, mjOBJ_BODY, names.body(l).c_str()));
    out.is_static.push_back(world.links[l].is_static);
    out.free.push_back(mj_name2id(&m, mjOBJ_JOINT, names.free_joint(l).c_str()));
    for (std::size_t k = 0; k < world.links[l].collisions.size(); ++k) {
      const int geom = mj_name2id(&m, mjOBJ_GEOM, names.geom(l, k).c_str());
      if (geom >= 0) out.geoms[static_cast<std::size_t>(geom)] = l;
    }
  }
  for (const FrictionDirection& d : directions_of(world)) {
    const int geom = mj_name2id(&m, mjOBJ_GEOM, names.geom(d.link, d.collision).c_str());
    out.directions.push_back({geom, d.of ? out.body[*d.of] : 0, d.along, d.mu, d.mu2});
  }
  for (std::size_t j = 0; j < world.joints.size(); ++j) {
    out.joints.push_back(
        {mj_name2id(&m, mjOBJ_JOINT, names.joint(j, 0).c_str()), mj_name2id(&m, mjOBJ_JOINT, names.joint(j, 1).c_str())});
  }
  return out;
}

description::Capabilities what_it_can() {
  using enum Geometry::Kind;
  description::Capabilities can;
  can.engine = "MuJoCo";
  can.shapes = {box, sphere, cylinder, capsule, ellipsoid, plane, heightmap, mesh};
  can.joints = {Joint::Kind::fixed, Joint::Kind::hinge, Joint::Kind::slide, Joint::Kind::ball, Joint::Kind::universal};
  can.followers = true;
  can.loops = true;
  can.collision_masks = true;
  can.spin_friction = true;
  can.directional_friction = true;
  can.weightless_links = true;
  return can;
}

/// MuJoCo's condition for a body that moves: mass and moments of its own, or of one that is fixed to it.
class Weights {
 public:
  Weights(const description::World& world, const std::vector<TreeNode>& tree) : world_(world), tree_(tree) {}

  void check(std::string_view file, Problems& problems) const {
    for (const TreeNode& node : tree_) {
      if (!moves(node) || suffices(node.link)) continue;
      const Link& link = world_.links[node.link];
      const bool light = link.mass < mjMINVAL;
      problems.add({std::string(file), link.name + (light ? "/inertial/mass" : "/inertial/inertia"),
                    light ? fmt::format("{}", link.mass) : fmt::format("smallest principal moment {:.6g}", least_moment(link)),
                    "is too little for MuJoCo in a link that moves",
                    light ? fmt::format("≥ {} kg", mjMINVAL) : fmt::format("principal moments ≥ {} kg·m²", mjMINVAL)});
    }
  }

 private:
  [[nodiscard]] bool moves(const TreeNode& node) const {
    return node.free || (node.joint && world_.joints[*node.joint].kind != Joint::Kind::fixed);
  }
  static double least_moment(const Link& link) {
    std::array<mjtNum, 9> inertia{}, axes{};
    std::array<mjtNum, 4> turn{};
    std::array<mjtNum, 3> moments{};
    for (std::size_t i = 0; i < 9; ++i) inertia[i] = link.inertia(i / 3, i % 3);
    mju_eig3(moments.data(), axes.data(), turn.data(), inertia.data());
    return *std::min_element(moments.begin(), moments.end());
  }
  [[nodiscard]] bool suffices(std::size_t link) const {
    if (world_.links[link].mass >= mjMINVAL && least_moment(world_.links[link]) >= mjMINVAL) return true;
    return std::any_of(tree_.begin(), tree_.end(),
                       [&](const TreeNode& n) { return n.parent == link && !moves(n) && suffices(n.link); });
  }

  const description::World& world_;
  const std::vector<TreeNode>& tree_;
};

class Mujoco final : public Engine {
 public:
  explicit Mujoco(Coriolis coriolis) : coriolis_(coriolis) {}
  const description::Capabilities& capabilities() const override { return can_; }

  std::shared_ptr<const CompiledWorld> compile(const std::shared_ptr<const description::World>& description, double step_s,
                                               std::string_view file, Problems& problems) const override {
    const description::World& world = *description;
    if (const auto* own = dynamic_cast<const MjcfFile*>(world.native.get())) {
      ModelPtr model(mj_copyModel(nullptr, own->model.get()));
      model->opt.timestep = step_s;
      return std::make_shared<CompiledMujoco>(std::move(model), description, own->objects, coriolis_);
    }
    const std::vector<TreeNode> tree = build_tree(world, file, problems);
    Weights(world, tree).check(file, problems);
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
    LinkObjects objects = objects_of(*model, world);
    return std::make_shared<CompiledMujoco>(std::move(model), description, std::move(objects), coriolis_);
  }

 private:
  Coriolis coriolis_;
  description::Capabilities can_ = what_it_can();
};

}  // namespace

std::shared_ptr<const Engine> mujoco(Coriolis coriolis) { return std::make_shared<Mujoco>(coriolis); }

}  // namespace vsa::physics
