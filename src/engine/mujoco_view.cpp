// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Looking at the world and building it; none of this touches the state that steps, but displace().
#include <algorithm>
#include <cmath>

#include "mjcf.hpp"
#include "mujoco_physics.hpp"

namespace vsa::engine {

const mjData& MujocoPhysics::view() const {
  if (view_stale_) {
    const mjModel* m = model_.get();
    mju_copy(view_->qpos, data_->qpos, m->nq);
    mju_copy(view_->qvel, data_->qvel, m->nv);
    mj_kinematics(m, view_.get());
    mj_comPos(m, view_.get());
    view_stale_ = false;
  }
  return *view_;
}

void MujocoPhysics::poses(std::span<Pose> links) const {
  const mjData& d = view();
  for (std::size_t i = 0; i < links.size() && i < body_.size(); ++i) {
    const mjtNum* p = d.xpos + 3 * body_[i];
    const mjtNum* q = d.xquat + 4 * body_[i];
    links[i] = {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  }
}

Vec3 MujocoPhysics::center_of_mass(std::span<const std::size_t> links) const {
  const mjData& d = view();
  Vec3 sum;
  double mass = 0;
  for (const std::size_t i : links) {
    const mjtNum* p = d.xipos + 3 * body_[i];
    sum += Vec3(p[0], p[1], p[2]) * mass_[i];
    mass += mass_[i];
  }
  return mass > 0 ? sum / mass : Vec3::Zero;
}

bool MujocoPhysics::displace(std::span<const std::size_t> links, double yaw, const Vec3& shift) {
  std::vector<int> roots;
  for (const std::size_t i : links) {
    if (root_[i] < 0) return false;
    if (std::find(roots.begin(), roots.end(), root_[i]) == roots.end()) roots.push_back(root_[i]);
  }
  const ignition::math::Quaterniond turn(0, 0, yaw);
  for (const int id : roots) {
    mjtNum* q = data_->qpos + model_->jnt_qposadr[id];
    mjtNum* v = data_->qvel + model_->jnt_dofadr[id];
    const Vec3 position = turn * Vec3(q[0], q[1], q[2]) + shift;
    const ignition::math::Quaterniond rotation = turn * ignition::math::Quaterniond(q[3], q[4], q[5], q[6]);
    const Vec3 velocity = turn * Vec3(v[0], v[1], v[2]);  // the angular one is in the body's own axes
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = position[k];
      v[k] = velocity[k];
    }
    q[3] = rotation.W(), q[4] = rotation.X(), q[5] = rotation.Y(), q[6] = rotation.Z();
  }
  changed();
  return true;
}

World::Energy MujocoPhysics::energy() const {
  const mjModel* m = model_.get();
  mjData* d = view_.get();
  view_stale_ = true;
  mju_copy(d->qpos, data_->qpos, m->nq);
  mju_copy(d->qvel, data_->qvel, m->nv);
  mj_integratePos(m, d->qpos, d->qvel, -m->opt.timestep / 2);
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  std::vector<mjtNum> momentum(static_cast<std::size_t>(m->nv));
  mj_mulM(m, d, momentum.data(), d->qvel);
  World::Energy out;
  out.kinetic = mju_dot(momentum.data(), d->qvel, m->nv) / 2;
  for (std::size_t i = 0; i < body_.size(); ++i) out.gravitational -= mass_[i] * mju_dot3(m->opt.gravity, d->xipos + 3 * body_[i]);
  for (int j = 0; j < m->njnt; ++j) {
    const int q = m->jnt_qposadr[j];
    const double stretch = m->jnt_stiffness[j] > 0 ? d->qpos[q] - m->qpos_spring[q] : 0;
    out.springs += m->jnt_stiffness[j] * stretch * stretch / 2;
  }
  return out;
}

int MujocoPhysics::contact_count() const {
  static_cast<void>(view());
  mj_collision(model_.get(), view_.get());
  return view_->ncon;
}

void MujocoPhysics::contacts(std::vector<Contact>& out) const {
  out.clear();
  if (!stepped_) return;
  const mjData* d = data_.get();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (c.efc_address < 0) continue;
    mjtNum wrench[6], force[3];
    mj_contactForce(model_.get(), d, i, wrench);  // on the second body, in the contact's frame, whose axes are rows
    mju_rotVecMatT(force, wrench, c.frame);
    Contact contact{{c.pos[0], c.pos[1], c.pos[2]},
                    {force[0], force[1], force[2]},
                    link_of_geom_[static_cast<std::size_t>(c.geom2)],
                    link_of_geom_[static_cast<std::size_t>(c.geom1)]};
    if (static_[contact.link]) {
      std::swap(contact.link, contact.other);
      for (double& f : contact.force_N) f = -f;
    }
    out.push_back(contact);
  }
}

namespace {

class CompiledMujoco final : public CompiledWorld {
 public:
  CompiledMujoco(ModelPtr model, std::shared_ptr<const WorldDescription> world, std::vector<TreeNode> tree)
      : model_(std::move(model)), world_(std::move(world)), tree_(std::move(tree)) {}
  std::unique_ptr<Physics> start() const override { return std::make_unique<MujocoPhysics>(model_, *world_, tree_); }

 private:
  std::shared_ptr<mjModel> model_;
  std::shared_ptr<const WorldDescription> world_;
  std::vector<TreeNode> tree_;
};

}  // namespace

std::shared_ptr<const CompiledWorld> compile_mujoco(const std::shared_ptr<const WorldDescription>& description, double step_s,
                                                    std::string_view file, Problems& problems) {
  const WorldDescription& world = *description;
  std::vector<TreeNode> tree = build_tree(world, file, problems);
  if (!problems.empty()) return nullptr;
  int moving = 0;
  for (const Link& l : world.links) moving += l.is_static ? 0 : static_cast<int>(l.collisions.size());
  // Room to begin with: it grows where it must, and a world that needs little is made and cloned in little time.
  const int contacts = 16 + 2 * std::min(moving, 100);
  const Mjcf mjcf = write_mjcf(world, tree, step_s, {contacts, 3 * contacts + 100});
  std::string reason;
  ModelPtr model = compile(mjcf.xml, mjcf.parts, reason);
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

}  // namespace vsa::engine
