// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a unit is doing, for whoever drives one without a host: host::ActuatorReading is made of it.
#pragma once

#include <array>
#include <cstdint>

#include "vsa/device/unit.hpp"

namespace vsa::device {

/// At the end of the unit's last step: physical truth.
struct UnitReading {
  double equilibrium_rad = 0,         ///< attained, from the pulleys
      preset = 0;                     ///< likewise, in the law's unit; a torque servo's: the stiffness that it makes, N·m/rad
  double shaft_rad = 0,               ///< q
      shaft_speed_rad_per_s = 0;      ///< q̇
  double torque_Nm = 0;               ///< on the shaft by springs and frictions
  double mean_torque_Nm = 0;          ///< the same as the host got it, over the last step
  double stiffness_Nm_per_rad = 0;    ///< σ at the present deflection
  std::array<double, 2> motor_rad{},  ///< of the pulleys
      motor_speed_rad_per_s{};        ///< of the pulleys
  std::array<double, 2> motor_torque_Nm{};  ///< on each pulley by its spring and tendon
  std::array<double, 2> current_A{};        ///< of each winding
};
/// Whether a reading has torque_Nm and motor_torque_Nm. Left out they are 0, and the springs' law is asked once instead of twice.
enum class Torques : std::uint8_t { told, left_out };

/// Nothing of its program's, which a port's thread may be at.
[[nodiscard]] UnitReading read(const Unit& unit, const UnitState& state, Torques torques = Torques::told) noexcept;

/// ∂(UnitReading::torque_Nm)/∂shaft with the pulleys held, N·m/rad. A friction's bristle adds its slope while
/// it only bends; at the edge where it begins to slide, the slope inside.
[[nodiscard]] double torque_slope(const Unit& unit, const UnitState& state) noexcept;

/// What the program would tell as the positions now: motor 1, motor 2, shaft.
[[nodiscard]] std::array<Ticks, 3> measured(const Unit& unit, const UnitState& state) noexcept;

}  // namespace vsa::device
