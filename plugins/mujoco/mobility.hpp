// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// B of driven joints as MuJoCo's step has it (vsa/host/robot.hpp), from what mj_fwdPosition has worked out:
//   B = (M⁻¹)_aa                      M: with armature
//   B = ((M + dt·D)⁻¹)_aa             D: joint damping, where the integrator takes it implicitly
//   B −= Xᵀ (J M⁻¹ Jᵀ + R)⁻¹ X        J, R: rows and softness of equalities (mimic joints, closed loops); X = J M⁻¹ of those columns
// Contacts, limits, tendons' and fluids' damping aren't in it.
//
// And where those joints would go if what pushes the bodies stayed as in the last step (host::JointIn::free_acceleration):
//   a = (M + dt·D)⁻¹ (passive − bias + pushed + Jᵀ f),   f = (J M⁻¹ Jᵀ + R)⁻¹ (aref − J M⁻¹ (passive − bias + pushed))
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

namespace vsa::mujoco {

class Mobility {
 public:
  /// Of the degrees of freedom `dofs`, by rows, 1/(kg·m²). Allocates where a model has more rows than before.
  void of(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out);
  /// a of all degrees of freedom, after mj_fwdVelocity. `pushed`: what push() told of the last step.
  [[nodiscard]] std::span<const double> foresee(const mjModel& m, mjData& d, std::span<const double> pushed);
  /// After a step, by degree of freedom: all that is applied, of actuators, and of constraints but the equalities.
  void push(const mjModel& m, mjData& d, std::span<double> out);

 private:
  void solve(const mjModel& m, mjData& d);  ///< unit_ → column_
  void factor_ties(const mjModel& m, mjData& d);
  template <class Work>
  void with_dampers(const mjModel& m, mjData& d, Work&& work);
  void tie(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out);

  std::vector<double> unit_, column_, force_, mass_;
  std::vector<double> row_, moved_, tied_, ties_, of_joint_;
};

}  // namespace vsa::mujoco
