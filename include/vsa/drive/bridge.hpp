// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// H-bridge: from the controller's output to a duty, and to the mean voltage where the inputs are modulated.
//
//   u      controller output, 1 = the full voltage that the firmware's limit allows
//   shape  0 for |u| ≤ dead_band, else sign(u)·(min(|u|, 1) − dead_band)/(1 − dead_band)
//   d      = shape(u) · full_duty, signed duty of the bridge; V̄ = d · supply
//
// The dead band is in controller-output units, and full output gives full voltage: so the authors' program has it.
// Their duty inside (0.3, 1) comes out with reversed sign; that defect is not repeated.
//
// What a period of the PWM does with d is drive/pwm_cycle.hpp: with modulated inputs the winding is shorted for the rest of the
// period and sees V̄; with a modulated enable pin it is left open.
#pragma once

#include <string_view>

namespace vsa {
class Problems;
}

namespace vsa::drive {

/// Which pin of the bridge the PWM modulates: what the winding sees while it is low.
enum class PwmPin {
  input,  ///< shorted through two switches: slow decay, the bridge brakes at duty 0
  enable  ///< open: the current runs out through the diodes against the supply (fast decay), the motor coasts at duty 0
};

/// An H-bridge and its PWM: from a controller's output to a duty d, and to the mean voltage V̄ = d · supply where the inputs are
/// modulated.
struct BridgeParams {
  double dead_band = 0;        ///< [0, 1); none, as in the published firmware (the paper's Table I has 0.3)
  bool brake_when_off = true;  ///< off, inputs modulated: terminals shorted (true) or open (false). UNKNOWN for the maker pro.
  PwmPin pin = PwmPin::input;  ///< which pin the PWM modulates
  double period_s = 0;         ///< of the PWM, ≥ 0; 0: far below the winding's time constant, no ripple
  double switch_Ohm = 0;       ///< both switches that the current passes, ≥ 0
  double diode_V = 0;          ///< drop of one of the two diodes that it passes, ≥ 0
  bool operator==(const BridgeParams&) const = default;
};
/// Dead band 0 … 0.99, period 0 … 1 s, all else ≥ 0.
void validate(const BridgeParams& params, std::string_view where, Problems& problems);

/// What a bridge with a modulated enable pin holds between two ticks.
struct PwmHold {
  double duty = 0;      ///< signed, −1…1
  double supply_V = 0;  ///< 0: none, and no current whatever the motor does
};

/// Signed duty, −1…1. `full_duty` is the bridge duty at full controller output (0…1).
[[nodiscard]] double bridge_duty(const BridgeParams& p, double output, double full_duty) noexcept;

/// Mean terminal voltage with modulated inputs, V.
[[nodiscard]] double bridge_voltage(const BridgeParams& p, double supply_V, double output, double full_duty) noexcept;

}  // namespace vsa::drive
