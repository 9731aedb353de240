// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A winding on a PWM bridge, averaged over the PWM's period: exact for a constant back-EMF, in closed form.
//
//   R, L     winding                          V     supply
//   r        the two switches in the path     v_d   one diode
//   T        period of the PWM                d     duty, 0…1 in the bridge's sense; a negative duty mirrors everything
//   e        = K_b ω, back-EMF
//
//   on,  d T:        L i̇ =  V − (R + r) i − e           through two switches, either way
//   off, (1 − d) T:
//     inputs:        L i̇ = −(R + r) i − e               shorted through two switches
//     enable:        L i̇ = −R i − e ∓ (V + 2 v_d)       through two diodes against the supply, for i ≷ 0, until i = 0; then open.
//                                                       At rest in the open phase the diodes conduct only for |e| > V + 2 v_d.
//
// The current is that of the periodic steady state, so the period must be short against all mechanical motion and L/R short
// against a firmware tick. With j = σ i, σ = sign(V − e) (current flows with the supply below e = V, against it above), j starts
// the period at
//   j₀ = w₁ σ(V − e)/(R + r) − w₂ (V + 2 v_d + σ e)/R,      w from the two phases' exponentials
// and if that is positive it never ends: continuous conduction, linear in e. Else j₀ = 0: discontinuous, it rises for d T and is
// gone after (L/R) ln(1 + ρ) more. The mean current falls with e everywhere (`conductance` ≥ 0), and
//   supply = e ī + winding + bridge,   winding, bridge ≥ 0:      the circuit is passive at every (d, e).
// T = 0 is the limit of fast switching: inputs (dV − e)/(R + r); enable ((2d − 1)V − 2(1 − d)v_d − e)/(R + d r) where that is
// positive, no current from there up to e = V. A bridge whose enable is modulated gives a standing motor nothing below d = 1/2.
#pragma once

#include "vsa/drive/bridge.hpp"

namespace vsa::drive {

/// Mean current, A, and −∂ī/∂e, 1/Ω.
struct PwmMean {
  double current = 0,   ///< ī, A
      conductance = 0;  ///< −∂ī/∂e, 1/Ω, ≥ 0
};

/// Mean powers, W: drawn from the supply (negative: fed back), heat of the winding, heat of switches and diodes.
struct PwmPower {
  double supply = 0,  ///< drawn; negative: fed back
      winding = 0,    ///< heat of the winding, ≥ 0
      bridge = 0;     ///< heat of switches and diodes, ≥ 0
};

/// One duty, prepared: two exponentials. Evaluating it costs a logarithm at most. Ranges: R > 0; |d| ≤ 1; L ≤ 0 means T = 0.
class PwmCycle {
 public:
  PwmCycle() = default;
  /// `supply_V`: now, whatever the parameters say.
  PwmCycle(const BridgeParams& bridge, double supply_V, double resistance_Ohm, double inductance_H, double duty) noexcept;

  [[nodiscard]] PwmMean mean(double emf_V) const noexcept;    ///< of the periodic steady state at this e
  [[nodiscard]] PwmPower power(double emf_V) const noexcept;  ///< at this e; what the supply gives less e ī is heat
  /// The supply that it was prepared for.
  [[nodiscard]] double supply_V() const noexcept { return supply_; }
  [[nodiscard]] double duty() const noexcept { return duty_; }  ///< as it was given, −1 … 1

 private:
  /// Integrals over one phase of j(t) = j_end + (j_begin − j_end)e^(−t/τ), as parts of the period.
  struct Phase {
    double resistance = 1;
    double rise = 0;                               // 1 − e^(−t/τ)
    double decay = 0, rest = 0;                    // ∫j = decay·j_begin + rest·j_end
    double begin2 = 0, mixed = 0, end2 = 0;        // ∫j² = begin2·j_begin² + 2 mixed·j_begin j_end + end2·j_end²
    void prepare(double part, double x) noexcept;  // x = t/τ; 0: the limit of fast switching
  };
  /// The period for one e. Open: j begins at 0.
  struct Solution {
    double sign = 1, target_on = 0, against = 0;  // σ, σ(V − e)/R₁, V + 2v_d + σe
    double begin = 0, peak = 0;
    bool continuous = true;
  };
  [[nodiscard]] Solution solve(double emf) const noexcept;

  PwmPin pin_ = PwmPin::input;
  double duty_ = 0, sense_ = 1, supply_ = 0, wall_ = 0;  // wall: V + 2 v_d
  double winding_ = 1, switch_ = 0, diode_ = 0;
  double slow_ = 0;  // α T of the off phase; 0: fast switching
  Phase on_, off_;
  double begin_on_ = 0, begin_off_ = 0, peak_on_ = 0, peak_off_ = 0;  // j at the phases' borders from the two targets
  double mean_on_ = 0, mean_off_ = 0;                                 // ī from the two targets, continuous
};

}  // namespace vsa::drive
