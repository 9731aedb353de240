// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Forces from outside, what a controller asks of the bodies, and clones.
#include <algorithm>

#include "mjcf.hpp"
#include "mujoco_physics.hpp"

namespace vsa::engine {

/// The model is shared, the data are new: contacts of the last step aren't taken along.
MujocoPhysics::MujocoPhysics(const MujocoPhysics& other)
    : model_(other.model_),
      body_(other.body_),
      link_of_geom_(other.link_of_geom_),
      static_(other.static_),
      mass_(other.mass_),
      joint_(other.joint_),
      root_(other.root_),
      q_owner_(other.q_owner_),
      v_owner_(other.v_owner_),
      before_(other.before_),
      unit_(other.unit_),
      column_(other.column_),
      jacobian_(other.jacobian_),
      mobility_(other.mobility_),
      mass_matrix_(other.mass_matrix_),
      damped_(other.damped_) {
  make_data();
  PhysicsState state;
  other.save(state);
  restore(state);
}

std::unique_ptr<Physics> MujocoPhysics::clone() const { return std::unique_ptr<Physics>(new MujocoPhysics(*this)); }

void MujocoPhysics::push(std::size_t joint, double torque) { data_->qfrc_applied[joint_[joint].v] += torque; }

void MujocoPhysics::push(std::size_t link, const Wrench& wrench) {
  mjData* d = data_.get();
  const int body = body_[link];
  mjtNum point[3];
  mju_rotVecQuat(point, wrench.point_m.data(), d->xquat + 4 * body);
  mju_addTo3(point, d->xpos + 3 * body);
  mj_applyFT(model_.get(), d, wrench.force_N.data(), wrench.torque_Nm.data(), point, body, d->qfrc_applied);
}

std::size_t MujocoPhysics::dofs() const { return static_cast<std::size_t>(model_->nv); }

std::optional<std::size_t> MujocoPhysics::joint_dof(std::size_t joint) const {
  const int id = mj_name2id(model_.get(), mjOBJ_JOINT, joint_name(joint, 0).c_str());
  if (id < 0) return std::nullopt;
  return static_cast<std::size_t>(model_->jnt_dofadr[id]);
}

std::optional<std::size_t> MujocoPhysics::free_dof(std::size_t link) const {
  const int id = mj_name2id(model_.get(), mjOBJ_JOINT, free_joint_name(link).c_str());
  if (id < 0) return std::nullopt;
  return static_cast<std::size_t>(model_->jnt_dofadr[id]);
}

Pose MujocoPhysics::pose(std::size_t link) const {
  const mjData& d = view();
  const mjtNum* p = d.xpos + 3 * body_[link];
  const mjtNum* q = d.xquat + 4 * body_[link];
  return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
}

Twist MujocoPhysics::velocity(std::size_t link) const {
  static_cast<void>(view());
  mj_comVel(model_.get(), view_.get());
  mjtNum v[6];
  mj_objectVelocity(model_.get(), view_.get(), mjOBJ_XBODY, body_[link], v, 0);
  return {{v[3], v[4], v[5]}, {v[0], v[1], v[2]}};
}

void MujocoPhysics::mass_matrix(std::span<double> out) const {
  static_cast<void>(view());
  mj_crb(model_.get(), view_.get());
  mj_fullM(model_.get(), out.data(), view_->qM);
}

void MujocoPhysics::bias(std::span<double> out, bool moving) const {
  static_cast<void>(view());
  if (!moving) {
    mju_zero(view_->qvel, model_->nv);
    view_stale_ = true;
  }
  mj_comVel(model_.get(), view_.get());
  mj_rne(model_.get(), view_.get(), 0, out.data());
}

void MujocoPhysics::jacobian(std::size_t link, const std::array<double, 3>& point, std::span<double> out) const {
  const mjData& d = view();
  const int body = body_[link];
  mjtNum place[3];
  mju_rotVecQuat(place, point.data(), d.xquat + 4 * body);
  mju_addTo3(place, d.xpos + 3 * body);
  mj_jac(model_.get(), &d, out.data(), out.data() + 3 * model_->nv, place, body);
}

}  // namespace vsa::engine
