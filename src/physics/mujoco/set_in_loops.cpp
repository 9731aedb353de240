// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A joint that is put somewhere, and the others of its kinematic loops with it. In small steps, so that a linkage stays in its
// assembly, by Newton's method on the equalities' rows: with their gaps r, Jacobian J, and a weight W, 1/inertia of what may move, else 0,
//   Δq = −W Jᵀ (J W Jᵀ + ε)⁻¹ r     and likewise, with J v in place of r, for speeds.
#include <algorithm>
#include <cmath>

#include "physics/mujoco/physics.hpp"

namespace vsa::physics {
namespace {

constexpr double kStep_rad = 0.05;
constexpr int kStepsOfSlide = 32, kMostSteps = 512, kMostTries = 20;
constexpr double kSolved = 1e-10, kClosed = 1e-4;  // m and rad, in which a loop's gaps are counted

class Loops {
 public:
  /// `d`: with the state; what it has else is worked with. `weights`: by degree of freedom.
  Loops(const mjModel& m, mjData& d, std::vector<mjtNum> weights) : m_(m), d_(d), weights_(std::move(weights)) { look(); }

  [[nodiscard]] double gap() const {
    double most = 0;
    for (int r = 0; r < d_.ne; ++r) most = std::max(most, std::abs(d_.efc_pos[r]));
    return most;
  }

  void close() {
    look();
    for (int tries = 0; tries < kMostTries && gap() > kSolved; ++tries) {
      const std::vector<mjtNum> by = towards(d_.efc_pos);
      mj_integratePos(&m_, d_.qpos, by.data(), 1);
      look();
    }
  }

  void close_speeds() {
    std::vector<mjtNum> rates(static_cast<std::size_t>(d_.nefc));
    mj_mulJacVec(&m_, &d_, rates.data(), d_.qvel);
    const std::vector<mjtNum> by = towards(rates.data());
    mju_addTo(d_.qvel, by.data(), m_.nv);
  }

 private:
  /// The rows at the present positions, without contacts.
  void look() {
    mj_kinematics(&m_, &d_);
    mj_comPos(&m_, &d_);
    mj_tendon(&m_, &d_);
    d_.ncon = 0;
    mj_makeConstraint(&m_, &d_);
  }

  [[nodiscard]] std::vector<mjtNum> towards(const mjtNum* gaps) const {
    const auto rows = static_cast<std::size_t>(d_.ne), nv = static_cast<std::size_t>(m_.nv);
    std::vector<mjtNum> out(nv), jacobian(rows * nv), weighted(rows * nv), square(rows * rows),
        unit(static_cast<std::size_t>(d_.nefc)), share(rows);
    if (rows == 0) return out;
    for (std::size_t r = 0; r < rows; ++r) {
      unit[r] = 1;
      mj_mulJacTVec(&m_, &d_, &jacobian[r * nv], unit.data());
      unit[r] = 0;
      for (std::size_t i = 0; i < nv; ++i) weighted[r * nv + i] = weights_[i] * jacobian[r * nv + i];
    }
    mju_mulMatMatT(square.data(), jacobian.data(), weighted.data(), d_.ne, m_.nv, d_.ne);
    mjtNum trace = 0;
    for (std::size_t r = 0; r < rows; ++r) trace += square[r * rows + r];
    for (std::size_t r = 0; r < rows; ++r) square[r * rows + r] += 1e-10 * trace + mjMINVAL;  // rows that others imply
    mju_cholFactor(square.data(), d_.ne, mjMINVAL);
    mju_cholSolve(share.data(), square.data(), gaps, d_.ne);
    mju_mulMatTVec(out.data(), weighted.data(), share.data(), d_.ne, m_.nv);
    mju_scl(out.data(), out.data(), -1, m_.nv);
    return out;
  }

  const mjModel& m_;
  mjData& d_;
  std::vector<mjtNum> weights_;
};

}  // namespace

bool MujocoPhysics::set_in_loops(std::size_t joint, JointState state, std::span<const std::size_t> held) {
  const mjModel* m = model_.get();
  mjData* d = view_.get();
  view_stale_ = true;
  mju_copy(d->qpos, data_->qpos, m->nq);
  mju_copy(d->qvel, data_->qvel, m->nv);
  std::vector<mjtNum> weights(static_cast<std::size_t>(m->nv));
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1 / std::max(m->dof_M0[i], mjMINVAL);
  for (const std::size_t j : held) weights[static_cast<std::size_t>(joint_[j].v)] = 0;
  const auto [q, v] = joint_[joint];
  weights[static_cast<std::size_t>(v)] = 0;
  Loops loops(*m, *d, std::move(weights));
  const double from = d->qpos[q], way = state.position - from, open = std::max(kClosed, loops.gap());
  const double steps = m->jnt_type[m->dof_jntid[v]] == mjJNT_SLIDE ? kStepsOfSlide : std::ceil(std::abs(way) / kStep_rad);
  const int n = static_cast<int>(std::clamp<double>(steps, 1, kMostSteps));
  for (int k = 1; k <= n; ++k) {
    d->qpos[q] = k == n ? state.position : from + way * k / n;
    loops.close();
    if (!(loops.gap() <= open)) return false;
  }
  d->qvel[v] = state.speed;
  loops.close_speeds();
  mju_copy(data_->qpos, d->qpos, m->nq);
  mju_copy(data_->qvel, d->qvel, m->nv);
  return true;
}

}  // namespace vsa::physics
