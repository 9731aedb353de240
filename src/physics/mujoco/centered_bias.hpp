// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Coriolis and centrifugal torques c at the speeds of now. mj_Euler steps as leapfrog does: v is the speed of half a step ago, q where
// joints are now. MuJoCo's c(q, v) is therefore wrong in the first order of dt: three free links may gain a fifth of their kinetic
// energy in ten seconds at 1 ms. c(q, v + dt/2·a) leaves the second order, with
//   in a tree without equalities   a = M⁻¹ (passive − c(q, v) + what pushed in the last step)
//   in one with them               a of the last step, which has what they did
// where dt/2·a is no more than a tenth of the tree's v, each speed weighed by its inertia; of more that tenth counts.
// That is the explicit midpoint rule: what swings with λ grows by (λ·dt)⁴/8 a step, and a body that spins with ω wobbles with about ω.
// So for a tree that is one rigid body, free or on a ball joint, the implicit rule, which keeps the energy at any ω·dt:
//   ω' = ω + dt/2·(b − W·(ω' × I·ω'))      b: a without c; W: of M⁻¹; I: inertia about its centre of mass, or the ball
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "physics/mujoco/tied_trees.hpp"
#include "vsa/physics/mujoco.hpp"

namespace vsa::physics {

class CenteredBias {
 public:
  CenteredBias() = default;
  CenteredBias(const mjModel& model, Coriolis coriolis);
  /// Sets qfrc_bias, after mj_fwdVelocity and with all of qfrc_passive. `pushed`: what pushed in the last step. `damped`: M has
  /// dt·damping. What else goes with speeds (cvel, cdof_dot) is left at those of now.
  void set(const mjModel& m, mjData& d, const TiedTrees& trees, const mjtNum* pushed, bool damped);

 private:
  struct Tree {
    int first = 0, count = 0;  ///< degrees of freedom
    int turning = -1;          ///< of one rigid body: the first of three that turn it
  };
  /// How much of change_ counts, at most 1.
  double part_of(const mjModel& m, mjData& d, const Tree& tree) const;
  /// The implicit rule: qvel to v'. False: it found none.
  bool turn(const mjModel& m, mjData& d, const Tree& tree, bool damped);

  bool left_ = true;  // as MuJoCo has it
  std::vector<Tree> trees_;
  std::vector<mjtNum> before_, change_;  // speeds, accelerations
  std::vector<mjtNum> kept_;             // what is added to forces, for the momentum of free bodies
};

}  // namespace vsa::physics
