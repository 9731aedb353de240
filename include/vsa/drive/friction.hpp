// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Hayward and Armstrong's friction (2000): driven by position, free of drift, passive. The paper calls it "Hayward–Dahl".
//
//   u = x − z                     position less anchor, |u| ≤ z_max                  rad
//   z follows x only when |x − z| would exceed z_max
//   τ_f = −τ_c u/z_max            torque on the moving part                         N·m
//
// Over a step the torque is the mean of its values at both ends, τ̄ = −(τ_c/z_max)(u + u')/2. Then the work it takes,
// −τ̄ Δx, is exactly the change of the bristle's energy ½(τ_c/z_max)u² plus the dissipation (τ_c/z_max)(u + u')/2·Δz ≥ 0.
// z_max = 0 is Coulomb friction: τ̄ is whatever holds the part still, at most τ_c.
// Coupled explicitly to an inertia J this needs (τ_c/z_max) dt²/J < 4; solve_friction() has no such limit.
#pragma once

#include <string_view>

#include "vsa/lanes.hpp"

namespace vsa {
class Problems;
}

namespace vsa::drive {

/// Hayward and Armstrong's friction: τ_f = −τ_c u/z_max, u the bend of its bristle, at most z_max. Without presliding it is
/// Coulomb's.
struct FrictionParams {
  double coulomb_Nm = 0;      ///< τ_c ≥ 0
  double presliding_rad = 0;  ///< z_max ≥ 0
  bool operator==(const FrictionParams&) const = default;
};
void validate(const FrictionParams& params, std::string_view where, Problems& problems);  ///< finite and ≥ 0

/// The parameters with what every step needs of them, made once.
struct Friction : FrictionParams {
  /// Divides once for all steps.
  // NOLINTNEXTLINE(google-explicit-constructor): the same law, only prepared
  Friction(const FrictionParams& p) noexcept
      : FrictionParams(p), stiffness(p.presliding_rad > 0 && p.coulomb_Nm > 0 ? p.coulomb_Nm / p.presliding_rad : 0.0) {}
  double stiffness;  ///< τ_c/z_max, N·m/rad; 0 where there is no bristle
};

/// The same where each lane has a limit of its own; the bristle's stiffness is common to all.
template <class T>
struct FrictionOf {
  T coulomb_Nm = 0,                  ///< τ_c
      presliding_rad = 0;            ///< z_max
  lanes::Constant<T> stiffness = 0;  ///< τ_c/z_max
};

/// The friction under a load: τ_c grows by ratio·|load|, the bristle's stiffness stays (z_max grows with τ_c); without a bristle it
/// is Coulomb friction. A caller whose limit shrinks below the bristle's bend turns the difference of energy to heat.
template <class T, class Params>
[[nodiscard]] FrictionOf<T> at_load(const Params& p, T ratio, T load_Nm) noexcept {
  FrictionOf<T> loaded{p.coulomb_Nm + ratio * lanes::abs(load_Nm), 0.0, p.stiffness};
  if (bristled(p)) loaded.presliding_rad = loaded.coulomb_Nm / p.stiffness;
  return loaded;
}

/// What a part did in a step, and its friction with it.
template <class T>
struct FrictionStepOf {
  T displacement = 0;   ///< Δx, rad
  T torque = 0;         ///< τ̄ on the part, N·m
  T anchor_travel = 0;  ///< Δz, rad
};
using FrictionStep = FrictionStepOf<double>;  ///< of one part

/// Torque and its slope −dτ/d(Δx).
template <class T>
struct FrictionTorqueOf {
  T torque = 0,   ///< τ, N·m
      slope = 0;  ///< −dτ/d(Δx), N·m/rad
};
using FrictionTorque = FrictionTorqueOf<double>;  ///< of one part

/// Whether there is a bristle. Without one, what holds depends on the sign of what pulls: that is written for one number only, and a
/// caller with several lanes needs a bristle or no friction at all.
template <class Params>
[[nodiscard]] bool bristled(const Params& p) noexcept {
  return lanes::all(p.stiffness > 0.0);
}

namespace detail {

[[nodiscard]] constexpr double sign(double v) noexcept { return v > 0 ? 1.0 : (v < 0 ? -1.0 : 0.0); }

/// z_max = 0: hold still if at most τ_c does it, else slide at τ_c.
[[nodiscard]] inline FrictionStep solve_coulomb(double coulomb, double free, double compliance) noexcept {
  const double slide = std::abs(free) - compliance * coulomb;
  FrictionStep step;
  if (slide <= 0) {
    step.torque = compliance > 0 ? -free / compliance : 0.0;
    return step;
  }
  step.torque = -sign(free) * coulomb;
  step.displacement = sign(free) * slide;
  step.anchor_travel = step.displacement;
  return step;
}

}  // namespace detail

/// The law for a known displacement.
///   u           x − z at the start
template <class T, class Params>
[[nodiscard]] FrictionStepOf<T> follow_friction(const Params& p, T u, std::type_identity_t<T> displacement) noexcept {
  if constexpr (lanes::kScalar<T>) {
    if (p.coulomb_Nm <= 0) return {displacement, 0.0, displacement};
    if (p.presliding_rad <= 0) return {displacement, -detail::sign(displacement) * p.coulomb_Nm, displacement};
  } else if (!bristled(p)) {
    return {displacement, 0.0, displacement};
  }
  const T reached = u + displacement;
  const T end = lanes::clamp(reached, -T(p.presliding_rad), p.presliding_rad);
  return {displacement, -0.5 * p.stiffness * (u + end), reached - end};
}

/// What a part does that gives way, and how much more for each N·m on it, rad/(N·m).
template <class T>
struct YieldingStepOf {
  FrictionStepOf<T> step;  ///< its displacement and friction
  T gain = 0;              ///< ∂(Δx) by ∂torque
};

/// Solves resist·Δx = free + compliance·τ̄(Δx) in closed form (one scalar, clamped).
///   free        displacement without this friction, times resist
///   compliance  displacement per mean torque, rad/(N·m), ≥ 0
///   resist      1 + compliance·κ, > 0, of a part on a spring of stiffness κ
template <class T, class Params>
[[nodiscard]] YieldingStepOf<T> solve_yielding(const Params& p, T u, std::type_identity_t<T> free, lanes::Constant<T> compliance,
                                               std::type_identity_t<T> resist) noexcept {
  if (!bristled(p)) {
    const T yield = 1.0 / resist;
    if constexpr (lanes::kScalar<T>) {
      if (p.coulomb_Nm > 0) return {detail::solve_coulomb(p.coulomb_Nm, free * yield, compliance * yield), compliance * yield};
    }
    return {follow_friction(p, u, free * yield), compliance * yield};
  }
  const auto pull = compliance * p.stiffness;
  const T held = 1.0 / (resist + 0.5 * pull), stick = (free - pull * u) * held, reached = u + stick;
  const lanes::Truth<T> sticks = lanes::abs(reached) <= p.presliding_rad;
  if (lanes::all(sticks)) return {follow_friction(p, u, stick), compliance * held};
  // Where it slides the bristle ends fully bent. τ̄ falls monotonically with Δx, so the root lies on the side that `stick` overshot.
  const T bent = lanes::copysign(T(p.presliding_rad), reached), torque = -0.5 * p.stiffness * (u + bent), yield = 1.0 / resist;
  const T slide = (free + compliance * torque) * yield;
  const FrictionStepOf<T> slid{slide, torque, u + slide - bent};
  if (!lanes::any(sticks)) return {slid, compliance * yield};
  const FrictionStepOf<T> stuck = follow_friction(p, u, stick);
  return {{lanes::select(sticks, stuck.displacement, slid.displacement), lanes::select(sticks, stuck.torque, slid.torque),
           lanes::select(sticks, stuck.anchor_travel, slid.anchor_travel)},
          compliance * lanes::select(sticks, held, yield)};
}

/// The same of a part that stands alone: Δx = free + compliance·τ̄(Δx).
template <class T, class Params>
[[nodiscard]] FrictionStepOf<T> solve_friction(const Params& p, T u, std::type_identity_t<T> free,
                                               lanes::Constant<T> compliance) noexcept {
  return solve_yielding(p, u, free, compliance, 1.0).step;
}

/// The law blended towards the end of an engine's step (host/robot.hpp): the mean over x → x + Δx with the weight 1 − w, and with
/// the weight w where the part is then, x + 2Δx − drift. Needs a bristle: z_max > 0, or τ_c = 0.
template <class T, class Params>
[[nodiscard]] FrictionTorqueOf<T> leading_friction(const Params& p, T u, std::type_identity_t<T> displacement,
                                                   std::type_identity_t<T> drift, std::type_identity_t<T> weight) noexcept {
  const T z = p.presliding_rad, end = u + displacement, ahead = end + displacement - drift, held = 0.5 * (1.0 - weight);
  const T torque = -p.stiffness * (held * (u + lanes::clamp(end, -z, z)) + weight * lanes::clamp(ahead, -z, z));
  const T slope = lanes::where<T>(lanes::abs(end) <= z, held) + lanes::where<T>(lanes::abs(ahead) <= z, 2.0 * weight);
  return {torque, p.stiffness * slope};
}

/// ½(τ_c/z_max)u², J; 0 where z_max = 0.
template <class T, class Params>
[[nodiscard]] T bristle_energy(const Params& p, T u) noexcept {
  return 0.5 * p.stiffness * u * u;
}

/// Energy turned to heat in a step that began at u, J; its own formula, ≥ 0 in every branch.
template <class T, class Params>
[[nodiscard]] T friction_heat(const Params& p, T u, const FrictionStepOf<T>& step) noexcept {
  if constexpr (lanes::kScalar<T>) {
    if (p.coulomb_Nm <= 0) return 0.0;
    if (p.presliding_rad <= 0) return -step.torque * step.displacement;
  } else if (!bristled(p)) {
    return 0.0;
  }
  const T end = u + step.displacement - step.anchor_travel;
  return 0.5 * p.stiffness * (u + end) * step.anchor_travel;
}

}  // namespace vsa::drive
