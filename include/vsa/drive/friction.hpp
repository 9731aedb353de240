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

/// ½(τ_c/z_max)u², J; 0 where z_max = 0.
[[nodiscard]] double bristle_energy(const Friction& p, double u) noexcept;

/// Energy turned to heat in a step that began at u, J; its own formula, ≥ 0 in every branch.
[[nodiscard]] double friction_heat(const Friction& p, double u, const FrictionStep& step) noexcept;

}  // namespace vsa::drive
