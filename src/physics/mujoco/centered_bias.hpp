// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Coriolis and centrifugal torques c at the speeds of now. mj_Euler steps as leapfrog does: v is the speed of half a step ago, q where
// joints are now. MuJoCo's c(q, v) is therefore wrong in the first order of dt: three free links may gain a fifth of their kinetic
// energy in ten seconds at 1 ms. c(q, v + dt/2·a) leaves the second order, with
//   without equalities   a = M⁻¹ (passive − c(q, v) + what pushed in the last step)
//   with them            a of the last step, which has what they did
// where dt/2·a is no more than a tenth of v, each speed weighed by its inertia; of more that tenth counts.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "vsa/physics/mujoco.hpp"

namespace vsa::physics {

class CenteredBias {
 public:
  CenteredBias() = default;
  CenteredBias(const mjModel& model, Coriolis coriolis);
  /// Sets qfrc_bias, after mj_fwdVelocity and with all of qfrc_passive. `pushed`: what pushed in the last step. What else goes with
  /// speeds (cvel, cdof_dot) is left at those of now.
  void set(const mjModel& m, mjData& d, const mjtNum* pushed);

 private:
  bool left_ = true;                     // as MuJoCo has it
  std::vector<mjtNum> before_, speeds_;  // speeds
};

}  // namespace vsa::physics
