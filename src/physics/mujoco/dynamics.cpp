// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Forces from outside, what a controller asks of the bodies, and clones.
#include <algorithm>

#include "physics/mujoco/physics.hpp"
#include "physics/mujoco/versions.hpp"

namespace vsa::physics {

/// The model is shared, the data are new: contacts of the last step aren't taken along.
MujocoPhysics::MujocoPhysics(const MujocoPhysics& other)
    : model_(other.own_ ? ModelPtr(mj_copyModel(nullptr, other.model_.get())) : other.model_),
      own_(other.own_),
      objects_(other.objects_),
      bodies_(other.bodies_),
      joint_(other.joint_),
      root_(other.root_),
      weightless_(other.weightless_),
      directed_(other.directed_),
      holding_(other.holding_),
      centered_(other.centered_),
      q_owner_(other.q_owner_),
      v_owner_(other.v_owner_),
      before_(other.before_),
      pushed_(other.pushed_),
      asked_(other.asked_),
      tried_(other.tried_),
      unit_(other.unit_),
      column_(other.column_),
      jacobian_(other.jacobian_),
      mobility_(other.mobility_),
      mass_matrix_(other.mass_matrix_),
      damped_(other.damped_) {
  stiff_.reserve(unit_.size());
  make_data();
  std::vector<double> state(state_size());
  other.save(state);
  restore(state);
}

std::unique_ptr<Physics> MujocoPhysics::clone() const { return std::unique_ptr<Physics>(new MujocoPhysics(*this)); }

void MujocoPhysics::push(std::size_t joint, double torque) { data_->qfrc_applied[joint_[joint].v] += torque; }

void MujocoPhysics::push(std::size_t link, const scene::Wrench& wrench) {
  mjData* d = data_.get();
  const int body = objects_.body[link];
  mjtNum point[3];
  mju_rotVecQuat(point, wrench.point_m.data(), d->xquat + 4 * body);
  mju_addTo3(point, d->xpos + 3 * body);
  mj_applyFT(model_.get(), d, wrench.force_N.data(), wrench.torque_Nm.data(), point, body, d->qfrc_applied);
}

std::size_t MujocoPhysics::dofs() const { return static_cast<std::size_t>(model_->nv); }

std::optional<std::size_t> MujocoPhysics::joint_dof(std::size_t joint) const {
  const int id = objects_.joints[joint][0];
  if (id < 0) return std::nullopt;
  return static_cast<std::size_t>(model_->jnt_dofadr[id]);
}

std::optional<std::size_t> MujocoPhysics::free_dof(std::size_t link) const {
  const int id = objects_.free[link];
  if (id < 0) return std::nullopt;
  return static_cast<std::size_t>(model_->jnt_dofadr[id]);
}

scene::Pose MujocoPhysics::pose(std::size_t link) const {
  const mjData& d = view();
  const mjtNum* p = d.xpos + 3 * objects_.body[link];
  const mjtNum* q = d.xquat + 4 * objects_.body[link];
  return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
}

scene::Twist MujocoPhysics::velocity(std::size_t link) const {
  static_cast<void>(view());
  mj_comVel(model_.get(), view_.get());
  mjtNum v[6];
  mj_objectVelocity(model_.get(), view_.get(), mjOBJ_XBODY, objects_.body[link], v, 0);
  return {{v[3], v[4], v[5]}, {v[0], v[1], v[2]}};
}

void MujocoPhysics::mass_matrix(std::span<double> out) const {
  static_cast<void>(view());
  make_mass(*model_, *view_);
  full_mass(*model_, *view_, out.data());
}

void MujocoPhysics::bias(std::span<double> out, bool moving) const {
  static_cast<void>(view());
  if (!moving) {
    mju_zero(view_->qvel, model_->nv);
    view_stale_ = true;
  }
  mj_comVel(model_.get(), view_.get());
  mj_rne(model_.get(), view_.get(), 0, out.data());
  hold_up(*view_, out.data(), -1);
}

void MujocoPhysics::jacobian(std::size_t link, const std::array<double, 3>& point, std::span<double> out) const {
  const mjData& d = view();
  const int body = objects_.body[link];
  mjtNum place[3];
  mju_rotVecQuat(place, point.data(), d.xquat + 4 * body);
  mju_addTo3(place, d.xpos + 3 * body);
  mj_jac(model_.get(), &d, out.data(), out.data() + 3 * model_->nv, place, body);
}

mjModel& MujocoPhysics::own_model() {
  if (!own_) {
    ModelPtr copy(mj_copyModel(nullptr, model_.get()));
    if (!copy) throw SimulationError("MuJoCo: no memory for a world with other masses");
    model_ = std::move(copy);
    own_ = true;
  }
  return *model_;
}

namespace {

/// InputError where they aren't of such a model.
const MujocoBodies& of_model(const mjModel& model, const Bodies* bodies) {
  const auto* of = dynamic_cast<const MujocoBodies*>(bodies);
  if (of == nullptr || !of->fits(model)) throw InputError(Problem{"", "bodies", "", "another world's", "this one's or a copy's"});
  return *of;
}

}  // namespace

std::shared_ptr<const Bodies> MujocoPhysics::bodies_with(const Bodies& base, std::span<const scene::LinkParameters> links) {
  mjModel& m = own_model();
  const MujocoBodies& from = of_model(m, &base);
  view_stale_ = true;
  std::shared_ptr<const MujocoBodies> made;
  try {
    made = std::make_shared<const MujocoBodies>(from, links, objects_, m, *view_);
  } catch (...) {
    bodies_->put_masses_into(m);  // MuJoCo gave up on the way
    throw;
  }
  bodies_->put_masses_into(m);
  return made;
}

void MujocoPhysics::use(std::shared_ptr<const Bodies> bodies) {
  if (bodies == bodies_) return;
  mjModel& m = own_model();
  of_model(m, bodies.get()).put_into(m, *bodies_);
  bodies_ = std::static_pointer_cast<const MujocoBodies>(std::move(bodies));
  changed();
}

}  // namespace vsa::physics
