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

/// Energies of one actuator, J: sums since the start or the last reset, and what is stored now.
template <class T>
struct LedgerOf {
  T supply = 0;           ///< Σ ∫V I dt drawn from the supply; negative when motors feed back
  T copper = 0;           ///< Σ ∫R I² dt
  T bridge = 0;           ///< heat of the bridges' switches and diodes
  T conversion = 0;       ///< Σ (K_b − K_τ)∫Iω dt: zero where the two constants agree, as physics asks
  T viscous = 0;          ///< Σ ∫b ω² dt
  T motor_friction = 0;   ///< heat of the gearboxes' friction
  T shaft_friction = 0;   ///< heat of the output shaft's friction
  T tendon_friction = 0;  ///< heat of the springs' tension-proportional friction
  T delivered = 0;        ///< ∫τ dq given to the robot, in the host's own (midpoint) terms
  T integrator = 0;       ///< −(ΔH + Σ load̄ Δx + τ̄ Δq): what the means miss, and what looking ahead takes away
  T pending = 0;          ///< work of the step under way along the predicted path; the next step turns it into delivered + coupling
  T coupling = 0;         ///< what the shaft's mispredicted path costs: see Actuator::settle
  T kinetic = 0;          ///< now: Σ ½Jω² of the motors
  T magnetic = 0;         ///< now: Σ ½LI²
  T elastic = 0;          ///< now: H
  T bristle = 0;          ///< now: presliding energy of the gearboxes' frictions
  T shaft_bristle = 0;    ///< now: presliding energy of the shaft's friction
  T tendon_bristle = 0;   ///< now: presliding energy of the tendons' friction
  T stored_at_start = 0;  ///< of the six that are stored
  T supply_moved = 0;     ///< ∫|P_supply| dt, by steps
  T delivered_moved = 0;  ///< ∫|P_shaft| dt, by steps
  static auto fields(auto& s, auto&& visit) {
    return visit("supply", "J", s.supply, "copper", "J", s.copper, "bridge", "J", s.bridge, "conversion", "J", s.conversion,
                 "viscous", "J", s.viscous, "motor_friction", "J", s.motor_friction, "shaft_friction", "J", s.shaft_friction,
                 "tendon_friction", "J", s.tendon_friction, "delivered", "J", s.delivered, "integrator", "J", s.integrator,
                 "pending", "J", s.pending, "coupling", "J", s.coupling, "kinetic", "J", s.kinetic, "magnetic", "J", s.magnetic,
                 "elastic", "J", s.elastic, "bristle", "J", s.bristle, "shaft_bristle", "J", s.shaft_bristle, "tendon_bristle", "J",
                 s.tendon_bristle, "stored_at_start", "J", s.stored_at_start, "supply_moved", "J", s.supply_moved,
                 "delivered_moved", "J", s.delivered_moved);
  }

  /// Sum of what is stored now.
  [[nodiscard]] T stored() const noexcept { return kinetic + magnetic + elastic + bristle + shaft_bristle + tendon_bristle; }
  /// Left side less right side of the balance, J: rounding only.
  [[nodiscard]] T imbalance() const noexcept {
    return supply - (copper + bridge + conversion + viscous + motor_friction + shaft_friction + tendon_friction +
                     (stored() - stored_at_start) + delivered + pending + integrator + coupling);
  }
  /// ∫|P_supply| + ∫|P_shaft|, J: what the balance is measured against.
  [[nodiscard]] T moved() const noexcept { return supply_moved + delivered_moved; }

  LedgerOf& operator+=(const LedgerOf& other) noexcept;  ///< entry by entry
};
using Ledger = LedgerOf<double>;  ///< of one unit

}  // namespace vsa::actuator
