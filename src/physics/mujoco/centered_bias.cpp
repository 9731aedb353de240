// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/centered_bias.hpp"

#include <algorithm>
#include <cmath>

#include "physics/mujoco/versions.hpp"

namespace vsa::physics {
namespace {

constexpr double kMost = 0.1;        ///< of the speeds: beyond it dt is too long for what moves there, and more blows up
constexpr double kSlow = 0.02;       ///< of dt/2·ω
constexpr double kSlowAlone = 5e-3;  ///< where it is cheap: a wobble grows by 1e-9 a step

/// r × v, turned on with v for a time h.
void swept(mjtNum* out, const mjtNum* v, const mjtNum* r, double h) {
  mjtNum axis[3], turn[4], across[3];
  mju_copy3(axis, v);
  const mjtNum speed = mju_normalize3(axis);
  mju_axisAngle2Quat(turn, axis, speed * h);
  mju_cross(across, v, r);
  mju_rotVecQuat(out, across, turn);
}

/// What must push a free body's centre of mass, beside M·a + c(v'): M keeps its momentum for small turns in a step only.
///   m·δ,  δ = (E(−v·h)(v × r) − E(v"·h)(v" × r))/dt + α × r + v' × (v' × r)
/// with v" = v + dt·α the next speed, E what turns, r from the body's origin to the centre of mass.
void keep_momentum(const mjModel& m, const mjData& d, int first, const mjtNum* v, const mjtNum* centered, mjtNum* out) {
  const int body = m.jnt_bodyid[m.dof_jntid[first]];
  const double half_s = 0.5 * m.opt.timestep;
  mjtNum in_world[3], r[3], change[3], next[3], before[3], after[3], a[3], b[3], force[3];
  mju_sub3(in_world, d.subtree_com + 3 * body, d.xpos + 3 * body);
  turned_back(r, in_world, d.xmat + 9 * body);
  mju_sub3(change, centered, v);
  mju_scl3(change, change, 1 / half_s);
  mju_addScl3(next, v, change, m.opt.timestep);
  swept(before, v, r, -half_s);
  swept(after, next, r, half_s);
  mju_cross(a, change, r);
  mju_cross(b, centered, r);
  mju_cross(force, centered, b);
  for (int i = 0; i < 3; ++i) force[i] = m.body_subtreemass[body] * ((before[i] - after[i]) / m.opt.timestep + a[i] + force[i]);
  mju_rotVecMat(out, force, d.xmat + 9 * body);
  mju_cross(out + 3, r, force);
}

/// Of speeds, √ Σ M_ii x_i².
double size(const mjModel& m, mjData& d, const Tree& tree, const mjtNum* x) {
  double sum = 0;
  for (int i = tree.first; i < tree.first + tree.count; ++i) sum += mass_of_dof(m, d, i) * x[i] * x[i];
  return std::sqrt(sum);
}

/// How much of dt/2·a counts.
double half_step(const mjModel& m, mjData& d, const Tree& tree, const mjtNum* v, const mjtNum* a) {
  const double half_s = 0.5 * m.opt.timestep, change = half_s * size(m, d, tree, a), most = kMost * size(m, d, tree, v);
  return change > most ? half_s * (most / change) : half_s;
}

}  // namespace

CenteredBias::CenteredBias(const mjModel& model, Coriolis coriolis)
    : left_(coriolis == Coriolis::as_in_mj_step || bias_has_more(model)),
      before_(static_cast<std::size_t>(model.nv)),
      change_(before_),
      gravity_(before_),
      kept_(before_) {
  for (int v = 0; v < model.nv; ++v) {
    if (model.dof_parentid[v] < 0) trees_.emplace_back().tree.first = v;
    ++trees_.back().tree.count;
  }
  std::vector<Tree> trees;
  for (Kin& kin : trees_) {
    const int first = kin.tree.first, count = kin.tree.count;
    for (int v = first; v < first + count; ++v)
      if (v == model.body_dofadr[model.dof_bodyid[v]]) kin.links.push_back(model.dof_bodyid[v]);
    kin.slow = kin.links.size() > 1 ? kSlow : kSlowAlone;
    kin.lone = kin.links.size() == 1 && model.jnt_type[model.dof_jntid[first]] == mjJNT_FREE;
    for (int v = first; v < first + 3 && kin.lone; ++v) kin.lone = model.dof_armature[v] == 0 && model.dof_damping[v] == 0;
    trees.push_back(kin.tree);
  }
  implicit_ = ImplicitBias(trees);
}

void CenteredBias::solve_fast(const mjModel& m, mjData& d, const mjtNum* pushed) {
  mjtNum *const a = change_.data(), *const gravity = gravity_.data();
  const mjtNum* const v = before_.data();
  mju_copy(kept_.data(), d.qvel, m.nv);
  mju_zero(d.qvel, m.nv);
  find_bias(m, d, gravity);
  mju_copy(d.qvel, kept_.data(), m.nv);
  mju_sub(a, d.qfrc_passive, gravity, m.nv);
  mju_addTo(a, pushed, m.nv);
  mj_solveM(&m, &d, a, a, 1);
  for (std::size_t i = 0; i < trees_.size(); ++i) {
    const auto [first, count] = trees_[i].tree;
    if (!trees_[i].fast) continue;
    implicit_.want(i);
    mju_copy(d.qvel + first, v + first, count);
    mju_scl(a + first, a + first, half_step(m, d, trees_[i].tree, v, a), count);
    mju_addTo(a + first, v + first, count);
  }
  implicit_.solve(m, d, a, gravity);
  mju_zero(kept_.data(), m.nv);
  for (const Kin& kin : trees_) {
    const int turning = kin.tree.first + 3;
    if (kin.fast && kin.lone) keep_momentum(m, d, kin.tree.first, v + turning, d.qvel + turning, kept_.data() + kin.tree.first);
  }
  mju_subFrom(d.qfrc_bias, kept_.data(), m.nv);
}

void CenteredBias::set(const mjModel& m, mjData& d, const TiedTrees& trees, const mjtNum* pushed) {
  if (left_) return;
  mjtNum *const a = change_.data(), *const v = before_.data();
  mju_sub(a, d.qfrc_passive, d.qfrc_bias, m.nv);
  mju_addTo(a, pushed, m.nv);
  mj_solveM(&m, &d, a, a, 1);
  mju_copy(v, d.qvel, m.nv);
  bool fast = false;
  for (Kin& kin : trees_) {
    const auto [first, count] = kin.tree;
    const bool tied = trees.tied(first);
    if (tied) mju_copy(a + first, d.qacc_warmstart + first, count);
    const auto spins = [&](int body) { return 0.5 * m.opt.timestep * mju_norm3(d.cvel + 6 * body) > kin.slow; };
    kin.fast = !tied && std::any_of(kin.links.begin(), kin.links.end(), spins);
    fast |= kin.fast;
    mju_addToScl(d.qvel + first, a + first, half_step(m, d, kin.tree, v, a), count);
  }
  if (fast)
    solve_fast(m, d, pushed);
  else
    find_bias(m, d, d.qfrc_bias);
  mju_copy(d.qvel, v, m.nv);
}

}  // namespace vsa::physics
