// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A law read backwards: which command gives this torque at this angle, with this stiffness. Every controller of a variable
// stiffness actuator begins with it.
//
//   τ(q; e, p) = −∂H/∂q,   σ(q; e, p) = ∂²H/∂q²   with the inputs at the law's references for (equilibrium e, preset p)
//
// equilibrium_for solves τ = τ* for e at a given p: τ grows with e for every convex law, so that a bracket around q holds the one
// solution; a lever's grows up to a peak, and the solution before it is taken. command_for looks for p in [0, preset_max] with σ = σ*
// along that curve, up to the borders of what reaches τ*; where several give it, the first that steps of preset_max/16 from 0
// show. TwoSinh with a₁ = a₂ = a and c = 0 is solved in closed form: with u_i = exp(a δ_i)
//     k₁u₁ + k₂u₂ = σ*/a − τ*,   k₁/u₁ + k₂/u₂ = σ*/a + τ*            a quadratic equation
// rest_under solves τ(q, x) + load = 0 for q with the inputs held: what a free shaft does.
// All are static: friction, and what the position loop gives way, come on top. A solution is good to about 1e-9 of τ* and σ*.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "vsa/elastic/transmission.hpp"

namespace vsa::elastic {

/// The equilibrium, rad; none where the torque isn't reached within `reach_rad` of q, or an argument isn't finite.
[[nodiscard]] std::optional<double> equilibrium_for(const Transmission& law, double q, double torque_Nm, double preset,
                                                    double reach_rad = 6.283185307179586) noexcept;

/// Where a free shaft comes to rest under an external torque about +q with the inputs held at x, rad: the first place found to the side
/// to which law and load push it from attained(x).equilibrium. Without load it rests there if the springs are alike, elsewhere if they
/// aren't. none: nothing stops it within `reach_rad`, or an argument isn't finite.
[[nodiscard]] std::optional<double> rest_under(const Transmission& law, const std::array<double, 2>& x, double load_Nm = 0,
                                               double reach_rad = 6.283185307179586) noexcept;

/// Whether the references of (e, p) are (e + p, e − p), as antagonists have them; software for the qbmove takes it for granted.
[[nodiscard]] bool antagonistic(const Transmission& law) noexcept;

/// What a command is to bring about at a standing shaft: τ(q; e, p) and σ(q; e, p).
struct Wanted {
  double q = 0;                     ///< where the shaft is, rad
  double torque_Nm = 0;             ///< that the actuator is to give it, about +q
  double stiffness_Nm_per_rad = 0;  ///< > 0
};

/// What command_for() found: equilibrium and preset, or why there are none.
struct Command {
  /// Why there is no command, if there is none.
  enum class Outcome {
    found,
    too_soft,            ///< wanted is less than the least stiffness at this torque
    too_stiff,           ///< wanted is more than the largest
    torque_unreachable,  ///< no preset allowed reaches the torque within a turn
    not_a_number         ///< an argument isn't finite, or is negative where it can't be
  };
  Outcome outcome = Outcome::not_a_number;  ///< whether `command` gives what was wanted
  EquilibriumPreset command;                ///< where found; else that of the nearest stiffness, if there is one
  double stiffness_min = 0,                 ///< the least that the presets 0 … preset_max reach at this torque, N·m/rad
      stiffness_max = 0;                    ///< the largest, N·m/rad
  [[nodiscard]] bool found() const noexcept { return outcome == Outcome::found; }  ///< `command` gives torque and stiffness, both
  [[nodiscard]] std::string text() const;                                          ///< the outcome in words, with the range
};

/// `preset_max`: largest preset allowed, ≥ 0, in the law's unit (UnitConfig::preset_max); 0 for a law without presets.
[[nodiscard]] Command command_for(const Transmission& law, const Wanted& wanted, double preset_max) noexcept;

}  // namespace vsa::elastic
