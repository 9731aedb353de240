// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/centered_bias.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/mujoco/versions.hpp"

namespace vsa::physics {
namespace {

using Matrix3 = std::array<mjtNum, 9>;

constexpr double kMost = 0.1;   ///< of the speeds: beyond it dt is too long for what moves there, and more blows up
constexpr double kSlow = 5e-3;  ///< of dt/2·ω, up to which a wobble grows by 1e-9 a step

Matrix3 inverse(const Matrix3& a) {
  const auto minor = [&](int i, int k) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    return a[3 * i1 + k1] * a[3 * i2 + k2] - a[3 * i1 + k2] * a[3 * i2 + k1];
  };
  const mjtNum determinant = a[0] * minor(0, 0) + a[1] * minor(0, 1) + a[2] * minor(0, 2);
  Matrix3 out;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) out[3 * i + k] = minor(k, i) / determinant;
  return out;
}

/// One rigid body's turning, in its own axes.
class Rotor {
 public:
  /// `turning`: the first of three degrees of freedom, behind three that shift a free body.
  Rotor(const mjModel& m, mjData& d, int turning, bool is_free, bool damped) {
    Matrix3 all;  // of M, without what shifts
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k <= i; ++k) {
        mjtNum& entry = all[3 * i + k] = mass_before(m, d, turning + i, i - k);
        for (int s = 1; s <= 3 && is_free; ++s)
          entry -= mass_before(m, d, turning + i, i + s) * mass_before(m, d, turning + k, k + s) / mass_of_dof(m, d, turning - s);
        all[3 * k + i] = entry;
      }
    }
    inertia_ = all;
    for (int i = 0; i < 3; ++i)
      inertia_[4 * i] -= m.dof_armature[turning + i] + (damped ? m.opt.timestep * m.dof_damping[turning + i] : 0);
    mobility_ = inverse(all);
  }

  /// W·(v × I·v)
  void turned_by_itself(mjtNum* out, const mjtNum* v) const {
    mjtNum momentum[3], torque[3];
    mju_rotVecMat(momentum, v, inertia_.data());
    mju_cross(torque, v, momentum);
    mju_rotVecMat(out, torque, mobility_.data());
  }

  /// v' = v + h·(b − W·(v' × I·v')), by Newton's method. False: not found.
  bool solve(mjtNum* out, const mjtNum* v, const mjtNum* b, double h) const {
    constexpr int kRounds = 12;
    constexpr double kClose = 1e-13;  ///< of the speed
    mju_copy3(out, v);
    for (int round = 0; round < kRounds; ++round) {
      mjtNum missing[3], step[3];
      turned_by_itself(missing, out);
      for (int i = 0; i < 3; ++i) missing[i] = v[i] + h * (b[i] - missing[i]) - out[i];
      mju_rotVecMat(step, missing, inverse(slope(out, h)).data());
      mju_addTo3(out, step);
      if (!(mju_norm3(step) < 1e6 * (1 + mju_norm3(v)))) return false;
      if (mju_norm3(step) <= kClose * mju_norm3(out)) return true;
    }
    return false;
  }

 private:
  /// 1 + h·∂(W·(v × I·v))/∂v
  [[nodiscard]] Matrix3 slope(const mjtNum* v, double h) const {
    Matrix3 out;
    mjtNum momentum[3];
    mju_rotVecMat(momentum, v, inertia_.data());
    for (int k = 0; k < 3; ++k) {
      mjtNum unit[3] = {0, 0, 0}, changed[3], a[3], b[3];
      unit[k] = 1;
      mju_rotVecMat(changed, unit, inertia_.data());
      mju_cross(a, v, changed);
      mju_cross(b, unit, momentum);
      mju_addTo3(a, b);
      mju_rotVecMat(changed, a, mobility_.data());
      for (int i = 0; i < 3; ++i) out[3 * i + k] = h * changed[i] + (i == k ? 1 : 0);
    }
    return out;
  }

  Matrix3 inertia_, mobility_;  // I, W
};

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
double size(const mjModel& m, mjData& d, int first, int count, const mjtNum* x) {
  double sum = 0;
  for (int i = first; i < first + count; ++i) sum += mass_of_dof(m, d, i) * x[i] * x[i];
  return std::sqrt(sum);
}

}  // namespace

CenteredBias::CenteredBias(const mjModel& model, Coriolis coriolis)
    : left_(coriolis == Coriolis::as_in_mj_step || bias_has_more(model)),
      before_(static_cast<std::size_t>(model.nv)),
      change_(before_),
      kept_(before_) {
  for (int v = 0; v < model.nv; ++v) {
    if (model.dof_parentid[v] < 0) trees_.push_back({v, 0, -1});
    ++trees_.back().count;
  }
  for (Tree& tree : trees_) {
    const int type = model.jnt_type[model.dof_jntid[tree.first]];
    if (type == mjJNT_BALL && tree.count == 3) tree.turning = tree.first;
    if (type == mjJNT_FREE && tree.count == 6) tree.turning = tree.first + 3;
    for (int v = tree.first; v < tree.turning; ++v)
      if (model.dof_armature[v] > 0 || model.dof_damping[v] > 0) tree.turning = -1;  // M's part is more than the mass
  }
}

double CenteredBias::part_of(const mjModel& m, mjData& d, const Tree& tree) const {
  const double change = 0.5 * m.opt.timestep * size(m, d, tree.first, tree.count, change_.data()),
               most = kMost * size(m, d, tree.first, tree.count, d.qvel);
  return change > most ? most / change : 1;
}

bool CenteredBias::turn(const mjModel& m, mjData& d, const Tree& tree, bool damped) {
  const Rotor rotor(m, d, tree.turning, tree.count > 3, damped);
  mjtNum *const v = d.qvel + tree.turning, *const b = change_.data() + tree.turning;
  mjtNum by_itself[3], pushed[3], found[3];
  rotor.turned_by_itself(by_itself, v);
  mju_addTo3(b, by_itself);
  const double part = part_of(m, d, tree), half_s = 0.5 * m.opt.timestep;
  mju_scl3(pushed, b, part);
  if (!rotor.solve(found, v, pushed, half_s)) {
    mju_subFrom3(b, by_itself);
    return false;
  }
  if (tree.count > 3) {
    mju_addToScl3(d.qvel + tree.first, change_.data() + tree.first, half_s * part);
    keep_momentum(m, d, tree.first, v, found, kept_.data() + tree.first);
  }
  mju_copy3(v, found);
  return true;
}

void CenteredBias::set(const mjModel& m, mjData& d, const TiedTrees& trees, const mjtNum* pushed, bool damped) {
  if (left_) return;
  mjtNum* const change = change_.data();
  mju_sub(change, d.qfrc_passive, d.qfrc_bias, m.nv);
  mju_addTo(change, pushed, m.nv);
  mj_solveM(&m, &d, change, change, 1);
  mju_copy(before_.data(), d.qvel, m.nv);
  mju_zero(kept_.data(), m.nv);
  const double half_s = 0.5 * m.opt.timestep;
  for (const Tree& tree : trees_) {
    if (trees.tied(tree.first))
      mju_copy(change + tree.first, d.qacc_warmstart + tree.first, tree.count);
    else if (tree.turning >= 0 && half_s * mju_norm3(d.qvel + tree.turning) > kSlow && turn(m, d, tree, damped))
      continue;
    const double part = half_s * part_of(m, d, tree);
    mju_addToScl(d.qvel + tree.first, change + tree.first, part, tree.count);
  }
  mj_comVel(&m, &d);
  mj_rne(&m, &d, 0, d.qfrc_bias);
  mju_subFrom(d.qfrc_bias, kept_.data(), m.nv);
  mju_copy(d.qvel, before_.data(), m.nv);
}

}  // namespace vsa::physics
