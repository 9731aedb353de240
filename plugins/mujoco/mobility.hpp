// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// B of driven joints as MuJoCo's step has it (vsa/host/robot.hpp), from what mj_fwdPosition has worked out:
//   B = (M⁻¹)_aa                      M: with armature
//   B = ((M + dt·D)⁻¹)_aa             D: joint damping, where the integrator takes it implicitly
//   B = ((M + dt·D + Jᵀ H J)⁻¹)_aa    of trees that an equality ties (mimic joints, closed loops), or where anything holds a stiff joint:
//                                     with what holds (vsa/physics/holding.hpp)
// Tendons' and fluids' damping isn't in it.
//
// And where those joints would go if what pushes the bodies stayed as in the last step (host::JointIn::free_acceleration):
//   a = (M + dt·D)⁻¹ (passive − bias + pushed + Jᵀ f)
// f: of such trees by all constraints, solved with these forces; of others what it was, but of stiff ones 0.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

#include "vsa/physics/holding.hpp"

namespace vsa::mujoco {

/// What pushes the bodies, by degree of freedom.
struct Pushed {
  std::span<double> forces;       ///< applied and of actuators
  std::span<double> constraints;  ///< of all of them
};

class Mobility {
 public:
  Mobility() = default;
  explicit Mobility(const mjModel& m);

  /// In each step after mj_fwdVelocity, before all else: which degrees of freedom have springs that the step doesn't resolve.
  void look(const mjModel& m, const mjData& d, std::span<const int> stiff);
  /// Whether anything may hold stiff joints of that tree in this step; by a degree of freedom.
  [[nodiscard]] bool held(int dof) const noexcept { return holding_.held(dof); }
  /// Of the degrees of freedom `dofs`, by rows, 1/(kg·m²). Allocates where a model has more rows than before.
  void of(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out);
  /// Its diagonal, as if nothing tied or held them.
  void of_each(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out);
  /// a of all degrees of freedom. `pushed`: what push() told of the last step.
  [[nodiscard]] std::span<const double> foresee(const mjModel& m, mjData& d, Pushed pushed);
  /// Of the degrees of freedom of a tree, after foresee(): as device::Holder has it, with `more` than what pushed them in the last step.
  [[nodiscard]] bool holds_else(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<const double> more,
                                std::span<double> accelerations, std::span<double> mobility);
  /// After a step.
  static void push(const mjModel& m, const mjData& d, Pushed out);

 private:
  void solve(const mjModel& m, mjData& d);  // unit_ → column_
  void constrain(const mjModel& m, mjData& d);
  void accelerate(const mjModel& m, mjData& d);
  template <class Work>
  void with_dampers(const mjModel& m, mjData& d, Work&& work);

  physics::Holding holding_;
  bool any_tied_ = false;
  std::vector<double> unit_, column_, force_, mass_;
  std::vector<double> as_before_, tried_;  // forces without constraints: if all went on, and with the torques that are tried
};

}  // namespace vsa::mujoco
