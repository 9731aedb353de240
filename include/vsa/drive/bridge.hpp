// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Supply and H-bridge, averaged over the PWM period (19.8 kHz, far above the motor's bandwidth).
//
//   u      controller output, 1 = the full voltage that the firmware's limit allows
//   shape  0 for |u| ≤ dead_band, else sign(u)·(min(|u|, 1) − dead_band)/(1 − dead_band)
//   V      = shape(u) · full_duty · supply
//
// The dead band is in controller-output units, and full output gives full voltage: so the authors' program has it.
// Their duty inside (0.3, 1) comes out with reversed sign; that defect is not repeated.
#pragma once

namespace vsa::drive {

struct BridgeParams {
  double supply_V = 12.0;      ///< ≥ 0; source of the default unknown, 24 V on one published robot
  double dead_band = 0.3;      ///< [0, 1)
  bool brake_when_off = true;  ///< off: terminals shorted (true) or open (false). UNKNOWN for the maker pro.
  bool operator==(const BridgeParams&) const = default;
};

/// Mean terminal voltage, V. `full_duty` is the bridge duty at full controller output (0…1).
[[nodiscard]] double bridge_voltage(const BridgeParams& p, double output, double full_duty) noexcept;

}  // namespace vsa::drive
