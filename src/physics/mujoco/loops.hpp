// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A joint that is put somewhere, and the others of its kinematic loops with it, along the curve that the loops leave: step by step from
// what the step before foretells, by Newton's method on the equalities' rows. With their gaps r, Jacobian J, and a weight W, 1/inertia of
// what may move, else 0,
//   Δq = −W Jᵀ (J W Jᵀ + ε)⁻¹ r
// Speeds likewise, with J v in place of r where the speeds of mj_Euler belong: at q − dt/2·v.
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <vector>

namespace vsa::physics {

class Loops {
 public:
  /// Of the degree of freedom `dof`: the equalities and the freedoms that hang together with it, by connects, welds, joints that follow
  /// and tendons. What two sides have in common is not among them: a base doesn't turn with a loop that it carries. `d` has the state
  /// and is worked with; `held`: degrees of freedom that stay.
  Loops(const mjModel& m, mjData& d, int dof, const std::vector<int>& held);

  [[nodiscard]] bool any() const noexcept { return any_; }  ///< whether there is one: more than joints that follow

  /// Puts it there, where `q` is its position, and goes along. False: not reached, or by a dead centre only.
  [[nodiscard]] bool go(int q, double to);
  /// With this speed there, and where it hasn't `moved` only the change of speed goes along. False: the loops leave it none such, or one
  /// that is out of all proportion.
  [[nodiscard]] bool set_speed(double to, bool moved);
  [[nodiscard]] const std::vector<char>& moves() const noexcept { return in_; }  ///< by degree of freedom

 private:
  using Numbers = std::vector<mjtNum>;
  void look();
  [[nodiscard]] std::vector<int> freedoms_of(int equality) const;
  void find_rows();
  [[nodiscard]] double gap() const;
  [[nodiscard]] double size(const mjtNum* x) const;
  [[nodiscard]] Numbers towards(const mjtNum* gaps) const;
  [[nodiscard]] Numbers rates(const Numbers& here);
  bool close(Numbers& moved);

  const mjModel& m_;
  mjData& d_;
  int dof_;
  bool any_ = false;
  std::vector<char> in_;      // degrees of freedom, by number
  std::vector<char> of_row_;  // equalities, by number
  std::vector<int> rows_;     // theirs among d's
  Numbers weights_;
};

}  // namespace vsa::physics
