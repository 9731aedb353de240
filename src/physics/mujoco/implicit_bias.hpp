// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The speeds v' in the middle of a step, of trees in which something spins fast. With c(v) = g + Q(v), Q the Coriolis and centrifugal
// torques, and f all else that pushes:
//   v' = v + h·M⁻¹ (f − g) − h·M⁻¹ Q(v'),   h = dt/2
// by Newton's method. ∂Q/∂v is made of differences, of all trees at once, since Q of one doesn't know the others: one mj_rne() for each
// degree of freedom that the largest has.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/LU>
#include <vector>

namespace vsa::physics {

/// c at d.qvel.
void find_bias(const mjModel& m, mjData& d, mjtNum* out);

/// Degrees of freedom from `first` on.
struct Tree {
  int first = 0, count = 0;
};

class ImplicitBias {
 public:
  ImplicitBias() = default;
  explicit ImplicitBias(const std::vector<Tree>& trees);
  /// That tree is one of those to solve next.
  void want(std::size_t tree);
  /// v' of those trees to d.qvel, which has a first guess; what finds no solution keeps it. `straight`: v + h·M⁻¹ (f − g); `gravity`: g.
  /// Leaves c(d.qvel) in qfrc_bias.
  void solve(const mjModel& m, mjData& d, const mjtNum* straight, const mjtNum* gravity);

 private:
  struct Solution {
    Tree tree;
    enum class State { left, steep, near, settled } state = State::left;  ///< steep: ∂Q/∂v is to be found anew
    mjtNum moved = 0;                                                     ///< in the last round: the largest of its speeds
    std::vector<mjtNum> guess;
    Eigen::PartialPivLU<Eigen::MatrixXd> slope;  ///< 1 + h·M⁻¹ ∂Q/∂v
    Eigen::VectorXd change;                      ///< of a round
  };
  void find_slopes(const mjModel& m, mjData& d);
  void step(Solution& of, mjtNum* x);

  std::vector<Solution> trees_;
  std::vector<mjtNum> missing_, at_;
  std::vector<mjtNum> columns_;  ///< nv numbers each
};

}  // namespace vsa::physics
