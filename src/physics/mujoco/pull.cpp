// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Hands that pull.
//
// A pull by its spring k and damper c, backward Euler over the step so that it is stable whatever the link weighs:
//   F = k·(target − p − dt·v') − c·v'  with  v' = u + dt·W·F,  W = J M⁻¹ Jᵀ            p, v: the point's place and velocity
//   u = v + dt·J M⁻¹ f with all that is known so far: gravity, actuators, joint springs and dampers, earlier pulls
//   (1 + (k·dt² + c·dt)·W) F = k·(target − p − dt·u) − c·u
// Contacts are left out. A free body at rest is held by k·(target − p) exactly.
#include <algorithm>

#include "physics/mujoco/physics.hpp"

namespace vsa::physics {
namespace {

constexpr std::size_t kDim = 3;

/// Solves the symmetric positive definite A x = b.
Vec3 solved(const std::array<std::array<double, kDim>, kDim>& a, const Vec3& b) {
  const Mat3 m(a[0][0], a[0][1], a[0][2], a[1][0], a[1][1], a[1][2], a[2][0], a[2][1], a[2][2]);
  return m.Inverse() * b;
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
  std::array<std::array<double, kDim>, kDim> a{};
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
      a[i][j] = (i == j ? 1.0 : 0.0) + (k * dt * dt + c * dt) * mobility;
    }
  }
  Vec3 force = solved(a, pulling);
  if (const double size = force.Length(); size > pull.force_max_N) force *= pull.force_max_N / size;
  const mjtNum pushed[kDim] = {force.X(), force.Y(), force.Z()};
  const mjtNum no_torque[kDim] = {0, 0, 0};
  mj_applyFT(m, d, pushed, no_torque, point, body, d->qfrc_applied);
}

}  // namespace vsa::physics
