// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Coriolis and centrifugal torques c at the speeds of now. mj_Euler steps as leapfrog does: v is the speed of half a step ago, q where
// joints are now. MuJoCo's c(q, v) is therefore wrong in the first order of dt: three free links may gain a fifth of their kinetic
// energy in ten seconds at 1 ms. c(q, v + dt/2·a) leaves the second order, with
//   in a tree without equalities   a = M⁻¹ (passive − c(q, v) + what pushed in the last step)
//   in one with them               a of the last step, which has what they did
// where dt/2·a is no more than a tenth of the tree's v, each speed weighed by its inertia; of more that tenth counts.
// That is the explicit midpoint rule: what swings with λ grows by (λ·dt)⁴/8 a step, and what spins with ω wobbles with about ω. So
// where a link of a tree without equalities turns by more than a fiftieth in half a step (of a tree that is one body, a two-hundredth)
// the implicit rule takes its place (implicit_bias.hpp), which keeps the energy of one body at any ω·dt.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "physics/mujoco/implicit_bias.hpp"
#include "vsa/physics/mujoco.hpp"
#include "vsa/physics/tied_trees.hpp"

namespace vsa::physics {

class CenteredBias {
 public:
  CenteredBias() = default;
  CenteredBias(const mjModel& model, Coriolis coriolis);
  /// Sets qfrc_bias, after mj_fwdVelocity and with all of qfrc_passive. `pushed`: what pushed in the last step. What else goes with
  /// speeds (cvel, cdof_dot) is left at those of now.
  void set(const mjModel& m, mjData& d, const TiedTrees& trees, const mjtNum* pushed);

 private:
  struct Kin {
    Tree tree;
    std::vector<int> links;
    bool lone = false;  ///< one free body, of which nothing but its mass resists a shift
    mjtNum slow = 0;    ///< of dt/2·ω: up to there the explicit rule is good enough
    bool fast = false;  ///< now
  };
  void solve_fast(const mjModel& m, mjData& d, const mjtNum* pushed);

  bool left_ = true;  // as MuJoCo has it
  std::vector<Kin> trees_;
  ImplicitBias implicit_;
  std::vector<mjtNum> before_, change_;  // speeds, accelerations
  std::vector<mjtNum> gravity_, kept_;   // torques; kept_: what keeps the momentum of free bodies
};

}  // namespace vsa::physics
