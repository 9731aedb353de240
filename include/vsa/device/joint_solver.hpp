// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Joints of one kinematic tree, solved together: the Δy of each, with the torques that all of them cause (host/robot.hpp).
//
//   Δy = free + C (τ(Δy) − τ_last)          C = dt²/2·B, B = (M⁻¹)_aa over the tree's actuated joints, symmetric positive definite
//   g(Δy) = C⁻¹ (Δy − free) − τ(Δy) + τ_last = 0
//
// g is a gradient: of the kinetic part and the springs' energies over the path, convex where the laws are. Newton with C⁻¹ + S,
// S = −∂τ/∂Δy of each joint, by one LDLᵀ, mended for later S; a step that overshoots is shortened until its slope grows no more.
// A unit that takes a step for its last isn't tried again: its torque goes on linearly while that is near enough.
//
// States: none. Matrices are kept until the mobility or the step length changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "vsa/device/holder.hpp"
#include "vsa/device/joint_trials.hpp"

namespace vsa::device {

namespace solver {
inline constexpr int kMaxIterations = 80;  ///< rounds of Newton
inline constexpr int kMaxHalvings = 100;   ///< where these found nothing: of a way on which a solution lies
inline constexpr int kMaxWays = 20;        ///< of several joints then: ways
/// A guess may lie where the spring's exponential law has no numbers left, so it goes no further than this at once.
inline constexpr double kReach_rad = 0.25;
/// A step along which the slope still has this part of what it had, with the other sign, went too far. Where a friction begins or
/// ends to slide Newton can go to and fro, so after some rounds less is allowed.
inline constexpr double kOvershoot = 0.9, kOvershootLater = 0.3;
inline constexpr int kEarly = 8;  ///< rounds before kOvershootLater holds
/// How often what holds may change while a step is solved; then the torques are those of the last. Mostly it doesn't; seldom it needs
/// more than four.
inline constexpr int kMaxChanges = 20;
/// The torque that may be left over where no round settles.
inline constexpr double kLeft = 1e-3, kLeft_Nm = 1e-4;  ///< of a torque; N·m
/// Memory that begins on a line of the cache, for vectors of any width.
template <class T>
struct OnLine {
  using value_type = T;                         ///< as a standard allocator has it, like all that follows
  static constexpr std::align_val_t kLine{64};  ///< bytes
  OnLine() = default;                           ///< any is like any other
  template <class U>
  explicit OnLine(const OnLine<U>& /*other*/) noexcept {}  ///< likewise
  /// Room for n.
  [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* p, std::size_t /*n*/) noexcept { ::operator delete(p, kLine); }          ///< of allocate()
  friend bool operator==(const OnLine& /*a*/, const OnLine& /*b*/) noexcept { return true; }  ///< any is like any other
};
using Row = std::vector<double, OnLine<double>>;  ///< numbers that begin on a line
}  // namespace solver

/// Solves one tree's step: the Δy of all its joints with the torques that they cause in each other. One thread; after the
/// constructor nothing is allocated.
class JointSolver {
 public:
  /// Everything that a step needs is allocated here. `instructions`: as JointTrials has them.
  explicit JointSolver(std::size_t joints, std::string_view instructions = {});

  [[nodiscard]] std::size_t size() const noexcept { return n_; }  ///< joints

  /// B by rows, n × n, 1/(kg·m²). One that isn't finite and positive definite leaves each joint by itself with its diagonal. A
  /// diagonal entry of 0 (n = 1 only): the motion is prescribed.
  void set(std::span<const double> mobility, std::int64_t dt_ns) noexcept;

  [[nodiscard]] JointTrials& trials() noexcept { return trials_; }  ///< to let joints stay in lanes between steps

  /// A first Δy for every plan, from what the last steps left: for ticks inside a step.
  void predict(std::span<const JointInStep> joints) noexcept;
  /// Solves, ends every unit's step, writes the torques; one joint alone has its unit solve it, with the entry of B that its step was
  /// begun with. False: after kMaxIterations more than a thousandth of a torque (and more
  /// than 1e-4 N·m) is left over; the torques are those of the last attempt.
  /// `holder`: of the tree that has this index there; solves anew with what holds, up to kMaxChanges times.
  bool solve(std::span<const JointInStep> joints, std::span<double> torques, Holder* holder = nullptr,
             std::size_t tree = 0) noexcept;

  static constexpr int kMaxIterations = solver::kMaxIterations;  ///< as the solver has it

 private:
  void factor_mobility() noexcept;
  void gradient() noexcept;
  bool factor_slopes() noexcept;
  void newton() noexcept;
  [[nodiscard]] bool stale() const noexcept;
  [[nodiscard]] bool fresh_newton() noexcept;
  void attempt(std::span<const JointInStep> joints, bool rough, bool keep = false) noexcept;
  double set_out(double& part) noexcept;
  bool search(std::span<const JointInStep> joints) noexcept;
  bool search_closely(std::span<const JointInStep> joints) noexcept;
  bool near(std::span<const JointInStep> joints) noexcept;
  void guess() noexcept;
  bool settle(std::span<const JointInStep> joints) noexcept;
  bool holds_else(std::span<const JointInStep> joints, Holder& holder, std::size_t tree, std::span<double> torques,
                  bool first) noexcept;
  [[nodiscard]] double along() const noexcept;

  bool factor() noexcept;
  void substitute(solver::Row& x) const noexcept;

  std::size_t n_;
  std::size_t stride_;  // of a row, with zeros behind its n_ numbers: whole vectors
  const LaneTable* algebra_;
  std::int64_t dt_ns_ = 0;
  std::vector<double> mobility_;         // as set
  solver::Row inertia_, lower_inertia_;  // C⁻¹, and 0 above its diagonal
  // The factor of C⁻¹ + S: L without its diagonal of ones and its transpose, 0 elsewhere; 1/D.
  solver::Row lower_, upper_, reciprocal_;
  solver::Row off_, move_, change_, gradient_;
  std::vector<double> dy_, factored_, column_;
  std::vector<double> acceleration_, told_;  // a holder's, its B by rows
  std::vector<double> between_, way_;        // torques, and from where to where they changed
  struct Answer {
    double torque = 0, dy = 0, off = 0;  // the units' Δy with that torque, and how far beyond it the holder has the joint
  };
  std::vector<Answer> tried_before_;  // of a holder
  JointTrials trials_;
  TrialColumns tried_;
};

}  // namespace vsa::device
