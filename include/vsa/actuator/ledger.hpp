// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where the energy of one actuator went:
//
//   supply = copper + bridge + conversion + viscous + motor_friction + shaft_friction + tendon_friction
//            + (stored − stored at the start) + delivered + pending + integrator + coupling
//
// `integrator` and `coupling` close the balance of a part (springs over a segment; shaft between unit and host), so the whole
// closes by construction and tests the motors and frictions, which have formulas of their own. What tests springs and coupling is
// that those two stay small: a negative sum of `coupling` is energy out of nothing. Units: J, since the start or the last reset.
#pragma once

namespace vsa::actuator {

struct Ledger {
  double supply = 0;           ///< Σ ∫V I dt drawn from the supply; negative when motors feed back
  double copper = 0;           ///< Σ ∫R I² dt
  double bridge = 0;           ///< heat of the bridges' switches and diodes
  double conversion = 0;       ///< Σ (K_b − K_τ)∫Iω dt: zero where the two constants agree, as physics asks
  double viscous = 0;          ///< Σ ∫b ω² dt
  double motor_friction = 0;   ///< heat of the gearboxes' friction
  double shaft_friction = 0;   ///< heat of the output shaft's friction
  double tendon_friction = 0;  ///< heat of the springs' tension-proportional friction
  double delivered = 0;        ///< ∫τ dq given to the robot, in the host's own (midpoint) terms
  double integrator = 0;       ///< −(ΔH + Σ load̄ Δx + τ̄ Δq): what the means miss, and what looking ahead takes away
  double pending = 0;   ///< work of the step under way along the predicted path; the next step turns it into delivered + coupling
  double coupling = 0;  ///< what the shaft's mispredicted path costs: see Actuator::settle
  double kinetic = 0;   ///< now: Σ ½Jω² of the motors
  double magnetic = 0;  ///< now: Σ ½LI²
  double elastic = 0;   ///< now: H
  double bristle = 0;   ///< now: presliding energy of the gearboxes' frictions
  double shaft_bristle = 0;   ///< now: presliding energy of the shaft's friction
  double tendon_bristle = 0;  ///< now: presliding energy of the tendons' friction
  double stored_at_start = 0;
  double supply_moved = 0;     ///< ∫|P_supply| dt, by steps
  double delivered_moved = 0;  ///< ∫|P_shaft| dt, by steps

  [[nodiscard]] double stored() const noexcept { return kinetic + magnetic + elastic + bristle + shaft_bristle + tendon_bristle; }
  /// Left side less right side of the balance, J: rounding only.
  [[nodiscard]] double imbalance() const noexcept {
    return supply - (copper + bridge + conversion + viscous + motor_friction + shaft_friction + tendon_friction +
                     (stored() - stored_at_start) + delivered + pending + integrator + coupling);
  }
  /// ∫|P_supply| + ∫|P_shaft|, J: what the balance is measured against.
  [[nodiscard]] double moved() const noexcept { return supply_moved + delivered_moved; }

  Ledger& operator+=(const Ledger& other) noexcept;
};

}  // namespace vsa::actuator
