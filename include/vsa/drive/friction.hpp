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

#include <algorithm>
#include <cmath>

namespace vsa::drive {

struct FrictionParams {
  double coulomb_Nm = 0;      ///< τ_c ≥ 0
  double presliding_rad = 0;  ///< z_max ≥ 0
  bool operator==(const FrictionParams&) const = default;
};

/// The parameters with what every step needs of them, made once.
struct Friction : FrictionParams {
  // NOLINTNEXTLINE(google-explicit-constructor): the same law, only prepared
  Friction(const FrictionParams& p) noexcept
      : FrictionParams(p), stiffness(p.presliding_rad > 0 && p.coulomb_Nm > 0 ? p.coulomb_Nm / p.presliding_rad : 0.0) {}
  double stiffness;  ///< τ_c/z_max, N·m/rad; 0 where there is no bristle
};

/// The friction under a load: τ_c grows by ratio·|load|, the bristle's stiffness stays (z_max grows with τ_c); without a bristle it
/// is Coulomb friction. A caller whose limit shrinks below the bristle's bend turns the difference of energy to heat.
[[nodiscard]] Friction at_load(const Friction& p, double ratio, double load_Nm) noexcept;

struct FrictionStep {
  double displacement = 0;   ///< Δx, rad
  double torque = 0;         ///< τ̄ on the part, N·m
  double anchor_travel = 0;  ///< Δz, rad
};

/// Solves Δx = free + compliance·τ̄(Δx) in closed form (one scalar, clamped).
///   u           x − z at the start
///   free        displacement without this friction
///   compliance  displacement per mean torque, rad/(N·m), ≥ 0
[[nodiscard]] FrictionStep solve_friction(const Friction& p, double u, double free, double compliance) noexcept;

/// The same law for a known displacement.
[[nodiscard]] FrictionStep follow_friction(const Friction& p, double u, double displacement) noexcept;

/// Torque and its slope −dτ/d(Δx).
struct FrictionTorque {
  double torque = 0, slope = 0;
};

/// The law blended towards the end of an engine's step (host/robot.hpp): the mean over x → x + Δx with the weight 1 − w, and with
/// the weight w where the part is then, x + 2Δx − drift. Needs a bristle: z_max > 0, or τ_c = 0.
[[nodiscard]] FrictionTorque leading_friction(const Friction& p, double u, double displacement, double drift,
                                              double weight) noexcept;

/// ½(τ_c/z_max)u², J; 0 where z_max = 0.
[[nodiscard]] double bristle_energy(const Friction& p, double u) noexcept;

/// Energy turned to heat in a step that began at u, J; its own formula, ≥ 0 in every branch.
[[nodiscard]] double friction_heat(const Friction& p, double u, const FrictionStep& step) noexcept;

// The law, inline: a step of one actuator calls it a dozen times.

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
  step.torque = -detail::sign(free) * coulomb;
  step.displacement = detail::sign(free) * slide;
  step.anchor_travel = step.displacement;
  return step;
}

}  // namespace detail

inline Friction at_load(const Friction& p, double ratio, double load_Nm) noexcept {
  Friction loaded = p;
  loaded.coulomb_Nm += ratio * std::abs(load_Nm);
  loaded.presliding_rad = p.stiffness > 0 ? loaded.coulomb_Nm / p.stiffness : 0.0;
  return loaded;
}

inline FrictionStep follow_friction(const Friction& p, double u, double displacement) noexcept {
  FrictionStep step;
  step.displacement = displacement;
  if (p.coulomb_Nm <= 0) {
    step.anchor_travel = displacement;
    return step;
  }
  if (p.presliding_rad <= 0) {
    step.torque = -detail::sign(displacement) * p.coulomb_Nm;
    step.anchor_travel = displacement;
    return step;
  }
  const double reached = u + displacement;
  const double end = std::clamp(reached, -p.presliding_rad, p.presliding_rad);
  step.torque = -0.5 * p.stiffness * (u + end);
  step.anchor_travel = reached - end;
  return step;
}

inline FrictionStep solve_friction(const Friction& p, double u, double free, double compliance) noexcept {
  if (p.coulomb_Nm <= 0) return follow_friction(p, u, free);
  if (p.presliding_rad <= 0) return detail::solve_coulomb(p.coulomb_Nm, free, compliance);
  const double stick = (free - compliance * p.stiffness * u) / (1.0 + 0.5 * compliance * p.stiffness);
  if (std::abs(u + stick) <= p.presliding_rad) return follow_friction(p, u, stick);
  // The bristle ends fully bent. τ̄ falls monotonically with Δx, so the root lies on the side that `stick` overshot.
  FrictionStep step;
  const double end = std::copysign(p.presliding_rad, u + stick);
  step.torque = -0.5 * p.stiffness * (u + end);
  step.displacement = free + compliance * step.torque;
  step.anchor_travel = u + step.displacement - end;
  return step;
}

inline FrictionTorque leading_friction(const Friction& p, double u, double displacement, double drift, double weight) noexcept {
  const double z = p.presliding_rad, end = u + displacement, ahead = end + displacement - drift, held = 0.5 * (1.0 - weight);
  const double torque = -p.stiffness * (held * (u + std::clamp(end, -z, z)) + weight * std::clamp(ahead, -z, z));
  const double slope = (std::abs(end) > z ? 0.0 : held) + (std::abs(ahead) > z ? 0.0 : 2.0 * weight);
  return {torque, p.stiffness * slope};
}

inline double bristle_energy(const Friction& p, double u) noexcept { return 0.5 * p.stiffness * u * u; }

inline double friction_heat(const Friction& p, double u, const FrictionStep& step) noexcept {
  if (p.coulomb_Nm <= 0) return 0.0;
  if (p.presliding_rad <= 0) return -step.torque * step.displacement;
  const double end = u + step.displacement - step.anchor_travel;
  return 0.5 * p.stiffness * (u + end) * step.anchor_travel;
}

}  // namespace vsa::drive
