// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The exact step of a motor whose mean current falls with its speed as a bridge's does near one speed (drive/pwm_cycle.hpp):
//
//   J ω̇ = K_τ I − b ω + T,     I = I₀ − g ω,  g ≥ 0
//
// With λ = (b + K_τ g)/J, x = λh, s = ω̇(0) = (K_τ I₀ + T)/J − λ ω₀:
//   ∫ω = h ω₀ + h² s φ₂,   ω(h) = ω₀ + h s φ₁,   φ₁ = (1 − e^(−x))/x,  φ₂ = (1 − φ₁)/x
//   ∫(ω − ω̄)² = h³ s² ψ,   ψ = φ₁ (½(1 + e^(−x)) − φ₁)/x²
// One exponential. The same as MotorStepper at R = K_b/g, V = I₀ K_b/g, where g may change every step and may be 0.
#pragma once

#include "vsa/drive/motor.hpp"

namespace vsa::drive {

/// The exact step of a motor whose mean current falls with its speed: J ω̇ = K_τ (I₀ − g ω) − b ω + T over h. Copyable, no
/// allocation.
class DroopStepper {
 public:
  DroopStepper() = default;
  DroopStepper(const MotorParams& pulley_side, double droop_As_per_rad, double h_s) noexcept;  ///< g ≥ 0, A·s/rad; h > 0

  /// ∫ω for T = 0.
  [[nodiscard]] double free_displacement(double speed, double current_at_rest) const noexcept {
    return h_ * speed + h_ * h_ * phi2_ * start_slope(speed, current_at_rest, 0.0);
  }
  /// ∂(∫ω)/∂T, rad/(N·m).
  [[nodiscard]] double compliance() const noexcept { return h_ * h_ * phi2_ / inertia_; }
  /// The whole step: its end and the integrals for the ledger.
  [[nodiscard]] MotorStep step(double speed, double current_at_rest, double torque) const noexcept;
  /// ∫(ω − ω̄)² of the same step: what keeps its heat above that at the mean speed.
  [[nodiscard]] double spread(double speed, double current_at_rest, double torque) const noexcept {
    const double s = start_slope(speed, current_at_rest, torque);
    return h_ * h_ * h_ * psi_ * s * s;
  }
  [[nodiscard]] double droop_As_per_rad() const noexcept { return droop_; }  ///< g
  [[nodiscard]] double h_s() const noexcept { return h_; }                   ///< the step length that it was made for

 private:
  [[nodiscard]] double start_slope(double speed, double current_at_rest, double torque) const noexcept {
    return (torque_constant_ * current_at_rest + torque) / inertia_ - decay_ * speed;
  }
  double h_ = 0, inertia_ = 1, torque_constant_ = 0, droop_ = 0, decay_ = 0;
  double phi1_ = 1, phi2_ = 0.5, psi_ = 1.0 / 12;
};

}  // namespace vsa::drive
