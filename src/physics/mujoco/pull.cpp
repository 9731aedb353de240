// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Hands that pull.
//
// A pull by its spring k and damper c, backward Euler over the step so that it is stable whatever the link weighs:
//   F = k·(target − p − dt·v') − c·v'  with  v' = u + dt·W·F,  W = J M⁻¹ Jᵀ            p, v: the point's place and velocity
//   u = v + dt·J M⁻¹ f with all that is known so far: gravity, actuators, joint springs and dampers, earlier pulls
//   (1 + G W) F = k·(target − p − dt·u) − c·u = f,  G = k·dt² + c·dt
// Where that is more than force_max, F has this size and the direction of f − G W F, which is what spring and damper ask for at the
// step's end: (μ + G W) F = f with the μ > 1 that makes it so.
// Contacts are left out. A body at rest is held by k·(target − p) exactly, or by force_max in that direction.
#include <algorithm>
#include <cmath>

#include "physics/mujoco/physics.hpp"

namespace vsa::physics {
namespace {

constexpr std::size_t kDim = 3;

/// (μ + A) x = b with the least μ ≥ 1 for which x is no longer than `most` > 0; A by rows, symmetric and positive semidefinite. In A's
/// axes x_i = b_i/(μ + a_i), whose length falls with μ.
Vec3 solved(const mjtNum* a, const Vec3& b, double most) {
  mjtNum values[kDim], axes[kDim * kDim], turn[4], along[kDim];
  mju_eig3(values, axes, turn, a);
  const mjtNum wanted[kDim] = {b.X(), b.Y(), b.Z()};
  mju_mulMatTVec(along, axes, wanted, kDim, kDim);
  const auto length = [&](double mu) {
    double sum = 0;
    for (std::size_t i = 0; i < kDim; ++i) sum += along[i] * along[i] / ((mu + values[i]) * (mu + values[i]));
    return std::sqrt(sum);
  };
  double low = 1, high = 1;
  if (length(1) > most) {
    high = std::max(1.0, b.Length() / most);
    for (int n = 0; n < 200 && high - low > 1e-15 * high; ++n) {
      const double middle = (low + high) / 2;
      (length(middle) > most ? low : high) = middle;
    }
  }
  mjtNum x[kDim];
  for (std::size_t i = 0; i < kDim; ++i) along[i] /= high + values[i];
  mju_mulMatVec(x, axes, along, kDim, kDim);
  return {x[0], x[1], x[2]};
}

}  // namespace

void MujocoPhysics::pull(const scene::Pull& pull) {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  const int body = objects_.body[pull.link];
  mjtNum point[kDim];
  mju_rotVecQuat(point, pull.point_m.data(), d->xquat + 4 * body);
  mju_addTo3(point, d->xpos + 3 * body);
  mj_jac(m, d, jacobian_.data(), nullptr, point, body);
  mj_solveM(m, d, mobility_.data(), jacobian_.data(), kDim);
  const double k = pull.stiffness_N_per_m, c = pull.damping_Ns_per_m, dt = m->opt.timestep;
  mjtNum a[kDim * kDim];
  Vec3 pulling;
  for (std::size_t i = 0; i < kDim; ++i) {
    const mjtNum* row = jacobian_.data() + i * unit_.size();
    const mjtNum* moved = mobility_.data() + i * unit_.size();
    const double known = mju_dot(moved, d->qfrc_applied, m->nv) + mju_dot(moved, pushed_.data(), m->nv) -
                         mju_dot(moved, asked_.data(), m->nv) + mju_dot(moved, d->qfrc_passive, m->nv) -
                         mju_dot(moved, d->qfrc_bias, m->nv);
    const double v = mju_dot(row, d->qvel, m->nv) + dt * known;
    pulling[i] = k * (pull.target_m[i] - point[i] - dt * v) - c * v;
    for (std::size_t j = 0; j < kDim; ++j) {
      const double mobility = mju_dot(row, mobility_.data() + j * unit_.size(), m->nv);
      a[i * kDim + j] = (k * dt * dt + c * dt) * mobility;
    }
  }
  if (pull.force_max_N <= 0) return;
  const Vec3 force = solved(a, pulling, pull.force_max_N);
  const mjtNum pushed[kDim] = {force.X(), force.Y(), force.Z()};
  const mjtNum no_torque[kDim] = {0, 0, 0};
  mj_applyFT(m, d, pushed, no_torque, point, body, d->qfrc_applied);
}

}  // namespace vsa::physics
