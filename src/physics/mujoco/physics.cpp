// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/physics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/mujoco/versions.hpp"
#include "vsa/grouped.hpp"
#include "vsa/physics/dofs_beside.hpp"
#include "vsa/physics/reach.hpp"
#include "vsa/physics/tree_roots.hpp"

namespace vsa::physics {
namespace {

const char* warning_text(int kind) {
  switch (kind) {
    case mjWARN_INERTIA:
      return "singular inertia matrix";
    case mjWARN_CONTACTFULL:
      return "too many contacts";
    case mjWARN_CNSTRFULL:
      return "too many constraints";
    case mjWARN_BADQPOS:
      return "bad position";
    case mjWARN_BADQVEL:
      return "bad velocity";
    case mjWARN_BADQACC:
      return "bad acceleration";
    default:
      return "engine warning";
  }
}

}  // namespace

MujocoPhysics::MujocoPhysics(std::shared_ptr<mjModel> model, const description::World& world, LinkObjects objects,
                             Coriolis coriolis)
    : model_(std::move(model)), objects_(std::move(objects)), joint_(world.joints.size()), root_(world.links.size(), -1) {
  const mjModel* m = model_.get();
  q_owner_.resize(static_cast<std::size_t>(m->nq));
  v_owner_.resize(static_cast<std::size_t>(m->nv));
  const auto own = [&](int id, const std::string& name) {
    const int q_end = id + 1 < m->njnt ? m->jnt_qposadr[id + 1] : m->nq, v_end = id + 1 < m->njnt ? m->jnt_dofadr[id + 1] : m->nv;
    std::fill(q_owner_.begin() + m->jnt_qposadr[id], q_owner_.begin() + q_end, name);
    std::fill(v_owner_.begin() + m->jnt_dofadr[id], v_owner_.begin() + v_end, name);
  };
  for (std::size_t j = 0; j < world.joints.size(); ++j) {
    for (const int id : objects_.joints[j]) {
      if (id < 0) continue;
      own(id, "joint " + world.joints[j].name);
      if (world.joints[j].one_axis()) joint_[j] = {m->jnt_qposadr[id], m->jnt_dofadr[id]};
    }
  }
  for (std::size_t l = 0; l < world.links.size(); ++l) {
    if (objects_.free[l] >= 0) own(objects_.free[l], "link " + world.links[l].name);
    const int root = m->body_rootid[objects_.body[l]], first = m->body_jntadr[root];
    if (first >= 0 && m->jnt_type[first] == mjJNT_FREE) root_[l] = first;
    if (world.links[l].weightless && !objects_.is_static[l] && !switched_off(*m, {"Gravity"})) weightless_.push_back(l);
  }
  directed_ = DirectedFriction(objects_.directions, *m);
  holding_ = Holding(*m);
  centered_ = CenteredBias(*m, coriolis);
  unit_.resize(static_cast<std::size_t>(m->nv));
  pushed_.resize(unit_.size());
  asked_.resize(unit_.size());
  tried_.resize(unit_.size());
  stiff_.reserve(unit_.size());
  column_.resize(unit_.size());
  // Where mj_Euler takes none, nor may what is solved before it.
  damped_ = !switched_off(*m, {"Damper", "Eulerdamp"}) &&
            std::any_of(m->dof_damping, m->dof_damping + m->nv, [](mjtNum d) { return d > 0; });
  jacobian_.resize(3 * unit_.size());
  mobility_.resize(3 * unit_.size());
  bodies_ = std::make_shared<const MujocoBodies>(*m, objects_);
  make_data();
  if (damped_) mass_matrix_.resize(mass_numbers(*m, *data_).size());
  before_.resize(state_size());
  save(before_);
}

void MujocoPhysics::make_data() {
  data_.reset(mj_makeData(model_.get()));
  view_.reset(mj_makeData(model_.get()));
  if (!data_ || !view_) throw SimulationError("MuJoCo: no memory for the world's state");
  view_stale_ = true;
  holding_.reserve(row_room(*model_, *data_));
}

bool MujocoPhysics::grow(bool contacts_only) {
  ModelPtr larger(mj_copyModel(nullptr, model_.get()));
  if (!larger) throw SimulationError("MuJoCo: no memory for a larger world");
  if (!grow_memory(*larger, contacts_only)) return false;
  model_ = std::move(larger);
  own_ = true;
  data_.reset();  // before the new ones: they are large
  view_.reset();
  make_data();
  restore(before_);  // mj_fwdPosition has made quaternions units, and would find others if it did so again
  return true;
}

void MujocoPhysics::changed() { view_stale_ = true; }

std::vector<int> MujocoPhysics::dofs_of(std::span<const std::size_t> joints) const {
  std::vector<int> out;
  for (const std::size_t joint : joints) out.push_back(joint_[joint].v);
  return out;
}

void MujocoPhysics::set_stiff(std::span<const std::size_t> joints) {
  stiff_.clear();
  for (const std::size_t joint : joints) stiff_.push_back(joint_[joint].v);
  holding_.set_stiff(stiff_);
}

bool MujocoPhysics::is_held(std::span<const std::size_t> joints) const {
  return std::any_of(joints.begin(), joints.end(), [this](std::size_t joint) { return holding_.held(joint_[joint].v); });
}

void MujocoPhysics::prepare() {
  const mjModel* m = model_.get();
  save(before_);
  for (;;) {
    mj_fwdPosition(m, data_.get());
    const bool rows = data_->warning[mjWARN_CNSTRFULL].number > 0, contacts = data_->warning[mjWARN_CONTACTFULL].number > 0;
    if (!(rows || contacts) || !grow(!rows)) break;
    m = model_.get();  // another
  }
  if (directed_.turn(*m, *data_)) {
    mj_makeConstraint(m, data_.get());
    mj_projectConstraint(m, data_.get());
  }
  take_dampers();
  mj_fwdVelocity(m, data_.get());
  hold_up(*data_, data_->qfrc_passive, 1);
  holding_.look(*m, *data_);
  centered_.set(*m, *data_, holding_.trees(), pushed_.data());
  mju_zero(data_->qfrc_applied, m->nv);
}

/// MuJoCo's gravity is for every body: −m·g at the centre of mass of one without it.
void MujocoPhysics::hold_up(mjData& d, mjtNum* forces, double part) const {
  const mjModel* m = model_.get();
  for (const std::size_t link : weightless_) {
    const int body = objects_.body[link];
    mjtNum force[3], none[3] = {0, 0, 0};
    mju_scl3(force, m->opt.gravity, -part * m->body_mass[body]);
    mj_applyFT(m, &d, force, none, d.xipos + 3 * body, body, forces);
  }
}

/// mj_Euler steps v' = v + dt·(M + dt·D)⁻¹ f with the joints' damping D, but MuJoCo's constraints are solved for accelerations M⁻¹ f:
/// beside a strong damper they push too much or too little, and what ties light followers to a damped leader gains energy. So from
/// here until mj_Euler the mass matrix is M + dt·D for all that is solved with it.
void MujocoPhysics::take_dampers() {
  if (!damped_) return;
  const mjModel* m = model_.get();
  const std::span<mjtNum> mass = mass_numbers(*m, *data_);
  std::copy(mass.begin(), mass.end(), mass_matrix_.begin());
  for (int i = 0; i < m->nv; ++i) mass_of_dof(*m, *data_, i) += m->opt.timestep * m->dof_damping[i];
  mj_factorM(m, data_.get());
  mj_projectConstraint(m, data_.get());
}

/// mj_Euler adds them by itself.
void MujocoPhysics::give_dampers_back() {
  if (damped_) std::copy(mass_matrix_.begin(), mass_matrix_.end(), mass_numbers(*model_, *data_).begin());
}

std::vector<std::vector<std::size_t>> MujocoPhysics::trees(std::span<const std::size_t> joints) const {
  const TreeRoots of_model(*model_);
  std::vector<int> roots;
  for (const std::size_t joint : joints) roots.push_back(of_model.root(joint_[joint].v));
  return grouped(roots);
}

void MujocoPhysics::mobility(std::span<const std::size_t> joints, std::span<double> out) {
  const mjModel* m = model_.get();
  const std::size_t n = joints.size();
  const bool held = std::any_of(joints.begin(), joints.end(), [&](std::size_t joint) { return holding_.tied(joint_[joint].v); }) &&
                    holding_.factor(*m, *data_);
  for (std::size_t i = 0; i < n; ++i) {
    const int v = joint_[joints[i]].v;
    unit_[static_cast<std::size_t>(v)] = 1;
    if (held)
      holding_.solve(column_, unit_);
    else
      mj_solveM(m, data_.get(), column_.data(), unit_.data(), 1);
    unit_[static_cast<std::size_t>(v)] = 0;
    for (std::size_t k = 0; k < n; ++k) out[i * n + k] = column_[static_cast<std::size_t>(joint_[joints[k]].v)];
  }
  for (std::size_t i = 0; held && i < n; ++i)
    for (std::size_t k = 0; k < i; ++k) out[k * n + i] = out[i * n + k];
}

void MujocoPhysics::solve_diagonal(mjData& d, std::span<const std::size_t> joints, std::span<double> out) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto v = static_cast<std::size_t>(joint_[joints[i]].v);
    unit_[v] = 1;
    mj_solveM(model_.get(), &d, column_.data(), unit_.data(), 1);
    unit_[v] = 0;
    out[i] = column_[v];
  }
}

void MujocoPhysics::free_mobility(std::span<const std::size_t> joints, std::span<double> out) {
  solve_diagonal(*data_, joints, out);
}

void MujocoPhysics::first_mobility(std::span<const std::size_t> joints, std::span<double> out) {
  static_cast<void>(view());
  make_mass(*model_, *view_);
  mj_factorM(model_.get(), view_.get());
  solve_diagonal(*view_, joints, out);
}

void MujocoPhysics::zero_mobility(std::span<const std::size_t> joints, std::span<double> out) const {
  for (std::size_t i = 0; i < joints.size(); ++i) out[i] = model_->dof_invweight0[joint_[joints[i]].v];
}

std::vector<std::size_t> MujocoPhysics::neighbours(std::span<const std::size_t> joints) const {
  return Reach(*model_).neighbours(dofs_of(joints));
}

std::vector<std::size_t> MujocoPhysics::beside(std::span<const std::size_t> joints) const {
  return dofs_beside(*model_, dofs_of(joints));
}

double MujocoPhysics::turned_rad(std::span<const std::size_t> dofs) const {
  return physics::turned_rad(*model_, data_->qvel, dofs, model_->opt.timestep);
}

/// Equalities answer to what joint speeds do at once, so where they tie one of the joints all constraints are solved as in advance();
/// likewise where a stiff joint is held by whatever it is.
void MujocoPhysics::foresee(std::span<const std::size_t> joints, std::span<double> out) {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  const auto tied = [&](std::size_t joint) { return holding_.tied(joint_[joint].v); };
  mj_fwdActuation(m, d);
  mju_sub(unit_.data(), d->qfrc_passive, d->qfrc_bias, m->nv);
  mju_addTo(unit_.data(), d->qfrc_actuator, m->nv);
  for (int v = 0; v < m->nv; ++v) pushed_[v] += d->qfrc_applied[v] - asked_[v];
  mju_copy(asked_.data(), d->qfrc_applied, m->nv);
  mju_addTo(unit_.data(), pushed_.data(), m->nv);
  mj_solveM(m, d, column_.data(), unit_.data(), 1);
  mju_zero(unit_.data(), m->nv);
  if (std::any_of(joints.begin(), joints.end(), tied)) {
    mju_copy(tried_.data(), pushed_.data(), m->nv);
    try_torques();
    holding_.begin(*d);
    for (int v = 0; v < m->nv; ++v)
      if (holding_.tied(v)) column_[v] = d->qacc[v];
  }
  std::transform(joints.begin(), joints.end(), out.begin(),
                 [&](std::size_t joint) { return column_[static_cast<std::size_t>(joint_[joint].v)]; });
}

/// v̇ with tried_; qfrc_applied stays.
void MujocoPhysics::try_torques() {
  mjData* d = data_.get();
  mju_copy(d->qfrc_applied, tried_.data(), model_->nv);
  mj_fwdAcceleration(model_.get(), d);
  holding_.constrain(*model_, *d);
  mju_copy(d->qfrc_applied, asked_.data(), model_->nv);
}

bool MujocoPhysics::holds_else(std::span<const std::size_t> joints, std::span<const double> torques,
                               std::span<double> accelerations, std::span<double> mobility) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const int v = joint_[joints[i]].v;
    tried_[v] = asked_[v] + torques[i];
  }
  try_torques();
  if (!holding_.changed(*data_, joint_[joints.front()].v)) return false;
  for (std::size_t i = 0; i < joints.size(); ++i) accelerations[i] = data_->qacc[joint_[joints[i]].v];
  this->mobility(joints, mobility);
  return true;
}

void MujocoPhysics::apply(std::size_t joint, double torque) { data_->qfrc_applied[joint_[joint].v] += torque; }

std::optional<Refusal> MujocoPhysics::check(const mjtNum* values, int n, bool positions, const char* quantity) const {
  const auto& owner = positions ? q_owner_ : v_owner_;
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(values[i]) || std::abs(values[i]) > mjMAXVAL)
      return Refusal{owner[static_cast<std::size_t>(i)], quantity, values[i]};
  }
  return std::nullopt;
}

/// Of a singular inertia MuJoCo tells whose; of another warning the fastest joint is shown.
std::optional<Refusal> MujocoPhysics::find_fault() const {
  for (int kind = 0; kind < mjNWARNING; ++kind) {
    if (data_->warning[kind].number == 0) continue;
    const auto nv = static_cast<std::size_t>(model_->nv);
    if (nv == 0) return Refusal{"world", warning_text(kind), 0};
    const auto slower = [](mjtNum a, mjtNum b) { return std::abs(a) < std::abs(b); };
    const auto fastest = static_cast<std::size_t>(std::max_element(data_->qvel, data_->qvel + nv, slower) - data_->qvel),
               of_it = static_cast<std::size_t>(data_->warning[kind].lastinfo),
               dof = kind == mjWARN_INERTIA && of_it < nv ? of_it : fastest;
    return Refusal{v_owner_[dof], fmt::format("speed ({})", warning_text(kind)), data_->qvel[dof]};
  }
  return std::nullopt;
}

std::optional<Refusal> MujocoPhysics::advance() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  std::optional<Refusal> fault = check(d->qpos, m->nq, true, "position");
  if (!fault) fault = check(d->qvel, m->nv, false, "speed");
  if (!fault) fault = check(d->qfrc_applied, m->nv, false, "applied torque");
  if (!fault) {
    mj_fwdActuation(m, d);
    mj_fwdAcceleration(m, d);
    mj_fwdConstraint(m, d);
    fault = check(d->qacc, m->nv, false, "acceleration");
  }
  if (!fault) fault = find_fault();
  if (!fault) {
    give_dampers_back();
    mj_Euler(m, d);
    mju_copy(pushed_.data(), d->qfrc_applied, m->nv);
    for (int v = 0; v < m->nv; ++v)
      if (!holding_.tied(v)) pushed_[v] += d->qfrc_constraint[v];
    fault = check(d->qvel, m->nv, false, "speed");
    if (!fault) fault = check(d->qpos, m->nq, true, "position");
    if (!fault) fault = find_fault();
  }
  if (fault) restore(before_);
  changed();
  stepped_ = !fault;
  return fault;
}

JointState MujocoPhysics::joint(std::size_t joint) const { return {data_->qpos[joint_[joint].q], data_->qvel[joint_[joint].v]}; }

void MujocoPhysics::set_joint(std::size_t joint, JointState state) {
  data_->qpos[joint_[joint].q] = state.position;
  data_->qvel[joint_[joint].v] = state.speed;
  pushed_[joint_[joint].v] = asked_[joint_[joint].v];  // what held it, or drove it, did so where it was
  changed();
}

std::size_t MujocoPhysics::state_size() const {
  return static_cast<std::size_t>(model_->nq) + 4 * static_cast<std::size_t>(model_->nv);
}

StateLayout MujocoPhysics::state_layout() const {
  const mjModel* m = model_.get();
  StateLayout out;
  const auto block = [&](const char* what, bool position, const char* turning, const char* sliding, const char* free) {
    for (int id = 0; id < m->njnt; ++id) {
      const int at = position ? m->jnt_qposadr[id] : m->jnt_dofadr[id], all = position ? m->nq : m->nv;
      const int next = id + 1 < m->njnt ? (position ? m->jnt_qposadr[id + 1] : m->jnt_dofadr[id + 1]) : all;
      const std::string& owner = position ? q_owner_[at] : v_owner_[at];
      const bool again = id > 0 && owner == v_owner_[m->jnt_dofadr[id - 1]];  // a universal joint's second axis
      const int type = m->jnt_type[id];
      const char* unit = type == mjJNT_HINGE ? turning : type == mjJNT_SLIDE ? sliding : free;
      out.add(owner + (again ? ", second axis." : ".") + what, unit, StateKind::real, static_cast<std::size_t>(next - at));
    }
  };
  block("position", true, "rad", "m", "m, quaternion w x y z");
  block("speed", false, "rad/s", "m/s", "m/s, rad/s");
  block("acceleration", false, "rad/s²", "m/s²", "m/s², rad/s²");
  block("pushed", false, "N·m", "N", "N, N·m");
  block("asked", false, "N·m", "N", "N, N·m");
  return out;
}

void MujocoPhysics::save(std::span<double> out) const {
  const mjModel* m = model_.get();
  mju_copy(out.data(), data_->qpos, m->nq);
  mju_copy(out.data() + m->nq, data_->qvel, m->nv);
  mju_copy(out.data() + m->nq + m->nv, data_->qacc_warmstart, m->nv);
  mju_copy(out.data() + m->nq + 2 * m->nv, pushed_.data(), m->nv);
  mju_copy(out.data() + m->nq + 3 * m->nv, asked_.data(), m->nv);
}

void MujocoPhysics::restore(std::span<const double> in) {
  const mjModel* m = model_.get();
  mju_copy(data_->qpos, in.data(), m->nq);
  mju_copy(data_->qvel, in.data() + m->nq, m->nv);
  mju_copy(data_->qacc_warmstart, in.data() + m->nq + m->nv, m->nv);
  mju_copy(pushed_.data(), in.data() + m->nq + 2 * m->nv, m->nv);
  mju_copy(asked_.data(), in.data() + m->nq + 3 * m->nv, m->nv);
  for (mjWarningStat& warning : data_->warning) warning = {};
  stepped_ = false;
  changed();
}

}  // namespace vsa::physics
