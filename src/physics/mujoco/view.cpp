// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Looking at the world; none of this touches the state that steps, but displace().
#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/mujoco/physics.hpp"
#include "physics/mujoco/versions.hpp"

namespace vsa::physics {

void MujocoPhysics::look(const mjModel& m, mjData& d) const {
  mju_copy(d.qpos, data_->qpos, m.nq);
  mju_copy(d.qvel, data_->qvel, m.nv);
  mj_kinematics(&m, &d);
  mj_comPos(&m, &d);
}

const mjData& MujocoPhysics::view() const {
  if (std::exchange(view_stale_, false)) look(*model_, *view_);
  return *view_;
}

void MujocoPhysics::poses(std::span<scene::Pose> links) const {
  const mjData& d = view();
  for (std::size_t i = 0; i < links.size() && i < objects_.body.size(); ++i) {
    const mjtNum* p = d.xpos + 3 * objects_.body[i];
    const mjtNum* q = d.xquat + 4 * objects_.body[i];
    links[i] = {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  }
}

std::array<double, 3> MujocoPhysics::center_of_mass(std::span<const std::size_t> links) const {
  const mjData& d = view();
  Vec3 sum;
  double mass = 0;
  for (const std::size_t i : links) {
    const mjtNum* p = d.xipos + 3 * objects_.body[i];
    const double own = bodies_->links()[i].mass_kg;
    sum += Vec3(p[0], p[1], p[2]) * own;
    mass += own;
  }
  const Vec3 mean = mass > 0 ? sum / mass : Vec3::Zero;
  return {mean.X(), mean.Y(), mean.Z()};
}

bool MujocoPhysics::displace(std::span<const std::size_t> links, double yaw, const std::array<double, 3>& shift) {
  std::vector<int> roots;
  for (const std::size_t i : links) {
    if (root_[i] < 0) return false;
    if (std::find(roots.begin(), roots.end(), root_[i]) == roots.end()) roots.push_back(root_[i]);
  }
  const double half_cos = std::cos(yaw / 2), half_sin = std::sin(yaw / 2),
               length = std::sqrt(half_cos * half_cos + half_sin * half_sin);
  const description::Quat turn(half_cos / length, 0, 0, half_sin / length);
  for (const int id : roots) {
    mjtNum* q = data_->qpos + model_->jnt_qposadr[id];
    const int dof = model_->jnt_dofadr[id];
    mjtNum* v = data_->qvel + dof;
    const Vec3 position = turn * Vec3(q[0], q[1], q[2]) + Vec3(shift[0], shift[1], shift[2]);
    const description::Quat rotation = turn * description::Quat(q[3], q[4], q[5], q[6]);
    const Vec3 velocity = turn * Vec3(v[0], v[1], v[2]);  // the angular one is in the body's own axes
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = position[k];
      v[k] = velocity[k];
    }
    for (mjtNum* in_world_axes : {data_->qacc_warmstart + dof, pushed_.data() + dof, asked_.data() + dof}) {
      const Vec3 turned = turn * Vec3(in_world_axes[0], in_world_axes[1], in_world_axes[2]);
      for (std::size_t k = 0; k < 3; ++k) in_world_axes[k] = turned[k];
    }
    q[3] = rotation.W(), q[4] = rotation.X(), q[5] = rotation.Y(), q[6] = rotation.Z();
  }
  changed();
  return true;
}

namespace {

double half_square(double stiffness, double stretch) { return stiffness * stretch * stretch / 2; }

/// Of a joint's spring, as MuJoCo pulls by it: a ball's by the angle of the turn from where it rests, a free body's also by the way.
double spring_of_joint(const mjModel& m, const mjData& d, int joint) {
  const double k = m.jnt_stiffness[joint];
  if (!(k > 0)) return 0;
  const mjtNum *q = d.qpos + m.jnt_qposadr[joint], *rest = m.qpos_spring + m.jnt_qposadr[joint];
  const int type = m.jnt_type[joint];
  if (type == mjJNT_HINGE || type == mjJNT_SLIDE) return half_square(k, *q - *rest);
  double out = 0;
  if (type == mjJNT_FREE) {
    out = half_square(k, mju_dist3(q, rest));
    q += 3;
    rest += 3;
  }
  mjtNum turned[4], away[3];
  mju_copy4(turned, q);
  mju_normalize4(turned);
  mju_subQuat(away, turned, rest);
  return out + half_square(k, mju_norm3(away));
}

double spring_of_tendon(const mjModel& m, const mjData& d, int tendon) {
  const auto [shortest, longest] = rest_of_tendon(m, tendon);
  const double length = d.ten_length[tendon];
  return half_square(m.tendon_stiffness[tendon], length - std::clamp(length, shortest, std::max(shortest, longest)));
}

}  // namespace

scene::Energy MujocoPhysics::energy() const {
  const mjModel* m = model_.get();
  mjData* d = view_.get();
  view_stale_ = true;
  mju_copy(d->qpos, data_->qpos, m->nq);
  mju_copy(d->qvel, data_->qvel, m->nv);
  mj_integratePos(m, d->qpos, d->qvel, -m->opt.timestep / 2);
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_tendon(m, d);
  make_mass(*m, *d);
  std::vector<mjtNum> momentum(static_cast<std::size_t>(m->nv));
  mj_mulM(m, d, momentum.data(), d->qvel);
  scene::Energy out;
  out.kinetic = mju_dot(momentum.data(), d->qvel, m->nv) / 2;
  for (std::size_t i = 0; i < objects_.body.size() && !switched_off(*m, {"Gravity"}); ++i)
    out.gravitational -= bodies_->links()[i].mass_kg * mju_dot3(m->opt.gravity, d->xipos + 3 * objects_.body[i]);
  for (const std::size_t i : weightless_)
    out.gravitational += bodies_->links()[i].mass_kg * mju_dot3(m->opt.gravity, d->xipos + 3 * objects_.body[i]);
  if (without_springs(*m)) return out;
  for (int j = 0; j < m->njnt; ++j) out.springs += spring_of_joint(*m, *d, j);
  for (int t = 0; t < m->ntendon; ++t) out.springs += spring_of_tendon(*m, *d, t);
  return out;
}

/// All that touches now. Where it is more than there is room for, a larger model finds it, and only here: prepare() makes room for
/// those of a step, and who looks between two steps changes nothing of them.
std::vector<mjContact> MujocoPhysics::touching() const {
  static_cast<void>(view());
  ModelPtr larger;
  DataPtr room;
  const mjModel* m = model_.get();
  mjData* d = view_.get();
  for (;;) {
    mj_collision(m, d);
    if (std::exchange(d->warning[mjWARN_CONTACTFULL].number, 0) == 0) break;
    ModelPtr next(mj_copyModel(nullptr, m));
    if (!next) throw SimulationError("MuJoCo: no memory for a larger world");
    if (!grow_contacts(*next)) break;
    room.reset(mj_makeData(next.get()));
    if (!room) throw SimulationError("MuJoCo: no memory for the world's state");
    larger = std::move(next);
    m = larger.get();
    d = room.get();
    look(*m, *d);
  }
  return {d->contact, d->contact + d->ncon};
}

int MujocoPhysics::contact_count() const { return static_cast<int>(touching().size()); }

std::vector<scene::Overlap> MujocoPhysics::overlaps() const {
  std::vector<scene::Overlap> out;
  for (const mjContact& c : touching()) {
    if (c.dist >= 0) continue;
    const std::size_t first = objects_.geoms[static_cast<std::size_t>(c.geom1)],
                      second = objects_.geoms[static_cast<std::size_t>(c.geom2)];
    const std::size_t link = std::min(first, second), other = std::max(first, second);
    const auto same = [&](const scene::Overlap& o) { return o.link == link && o.other == other; };
    auto it = std::find_if(out.begin(), out.end(), same);
    if (it == out.end()) it = out.insert(it, {link, other, 0});
    it->depth_m = std::max(it->depth_m, -c.dist);
  }
  return out;
}

void MujocoPhysics::contacts(std::vector<scene::Contact>& out) const {
  out.clear();
  if (!stepped_) return;
  const mjData* d = data_.get();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (c.efc_address < 0) continue;
    mjtNum wrench[6], force[3];
    mj_contactForce(model_.get(), d, i, wrench);  // on the second body, in the contact's frame, whose axes are rows
    turned_back(force, wrench, c.frame);
    scene::Contact contact{{c.pos[0], c.pos[1], c.pos[2]},
                           {force[0], force[1], force[2]},
                           objects_.geoms[static_cast<std::size_t>(c.geom2)],
                           objects_.geoms[static_cast<std::size_t>(c.geom1)]};
    if (objects_.is_static[contact.link]) {
      std::swap(contact.link, contact.other);
      for (double& f : contact.force_N) f = -f;
    }
    out.push_back(contact);
  }
}

}  // namespace vsa::physics
