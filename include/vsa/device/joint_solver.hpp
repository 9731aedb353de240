// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Joints of one kinematic tree, solved together: the Δy of each, with the torques that all of them cause (host/robot.hpp).
//
//   Δy = free + C (τ(Δy) − τ_last)          C = dt²/2·B, B = (M⁻¹)_aa over the tree's actuated joints, symmetric positive definite
//   g(Δy) = C⁻¹ (Δy − free) − τ(Δy) + τ_last = 0
//
// g is a gradient: of the kinetic part and the springs' energies over the path, convex where the laws are. Newton with C⁻¹ + S,
// S = −∂τ/∂Δy of each joint, by LDLᵀ; a step that overshoots is shortened until the slope along it no longer grows.
// A unit that takes a step for its last isn't tried again: its torque goes on linearly while that is near enough.
//
// States: none. Matrices are kept until the mobility or the step length changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vsa::device {

class Unit;
struct UnitState;
struct StepPlan;

/// The whole torque on a shaft for a displacement Δy of its step.
struct ShaftTorque {
  double torque = 0;  ///< N·m
  double slope = 0;   ///< −dτ/d(Δy), N·m/rad
  bool settled = true;
};

struct JointInStep {
  Unit* unit = nullptr;
  UnitState* state = nullptr;
  StepPlan* plan = nullptr;
};

class JointSolver {
 public:
  /// Everything that a step needs is allocated here.
  explicit JointSolver(std::size_t joints);

  [[nodiscard]] std::size_t size() const noexcept { return n_; }

  /// B by rows, n × n, 1/(kg·m²). One that isn't finite and positive definite leaves each joint by itself with its diagonal. A
  /// diagonal entry of 0 (n = 1 only): the motion is prescribed.
  void set(std::span<const double> mobility, std::int64_t dt_ns) noexcept;

  /// A first Δy for every plan, from what the last steps left: for ticks inside a step.
  void predict(std::span<const JointInStep> joints) noexcept;
  /// Solves, ends every unit's step, writes the torques. False: after kMaxIterations more than a thousandth of a torque (and more
  /// than 1e-4 N·m) is left over; the torques are those of the last attempt.
  bool solve(std::span<const JointInStep> joints, std::span<double> torques) noexcept;

  static constexpr int kMaxIterations = 80;

 private:
  void factor_mobility() noexcept;
  static void follow(const JointInStep& joint, double& torque) noexcept;

  // N = 1 of a joint alone, 0 of any number.
  template <std::size_t N>
  void predict_all(std::span<const JointInStep> joints) noexcept;
  template <std::size_t N>
  bool solve_all(std::span<const JointInStep> joints, std::span<double> torques) noexcept;
  template <std::size_t N>
  void gradient(std::span<const JointInStep> joints) noexcept;
  template <std::size_t N>
  bool factor_slopes() noexcept;
  template <std::size_t N>
  [[nodiscard]] bool stale() const noexcept;
  template <std::size_t N>
  void newton() noexcept;
  template <std::size_t N>
  bool near(std::span<const JointInStep> joints, std::span<double> torques) noexcept;
  template <std::size_t N>
  void attempt(std::span<const JointInStep> joints, bool rough) noexcept;
  template <std::size_t N>
  void go_on(std::span<const JointInStep> joints) noexcept;
  template <std::size_t N>
  double set_out(double& part) noexcept;
  template <std::size_t N>
  bool search(std::span<const JointInStep> joints, std::span<double> torques) noexcept;
  template <std::size_t N>
  void guess(std::span<const JointInStep> joints) noexcept;
  template <std::size_t N>
  [[nodiscard]] double along() const noexcept;

  std::size_t n_;
  std::int64_t dt_ns_ = 0;
  std::vector<double> mobility_;  // as set
  std::vector<double> inertia_;   // C⁻¹
  std::vector<double> work_;      // the factor of C⁻¹ + S
  std::vector<double> dy_, off_, move_, gradient_, torque_, slope_, factored_, column_;
  std::vector<ShaftTorque> carried_;  // what the last move_ foretold
};

}  // namespace vsa::device
