// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a unit is made of: physics, and its controller, the qbmove's program or a servo.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "vsa/actuator/actuator.hpp"
#include "vsa/control/servo.hpp"
#include "vsa/errors.hpp"
#include "vsa/firmware/program.hpp"

namespace vsa::device {

/// All parameters of one unit. `memory` and `program` count only without a servo.
struct UnitConfig {
  actuator::ActuatorParams actuator;  ///< motors, springs, shaft, encoders
  firmware::ProgramParams program;    ///< what isn't in the EEPROM: model, dialect, generation
  firmware::Memory memory = firmware::initial_memory(firmware::Model::maker_pro);  ///< both EEPROM pages; the ID is the robot's
  double preset_max = 0.785;                                                       ///< accepted |preset| of a command in SI units
  double substep_max_s = 1e-3;                                                     ///< longest physics segment, (0, 1 ms]
  /// The controller instead of the qbmove's program; none: `program` with `memory`, which else count for nothing.
  std::optional<control::ServoParams> servo = std::nullopt;

  /// Whether the program limits the duty by the supply.
  [[nodiscard]] bool supply_limited() const noexcept {
    return !servo && program.supply_table.value_or(program.model == firmware::Model::maker_pro);
  }
  /// Whether the motors' references are clamped to reference_range_raw().
  [[nodiscard]] bool references_limited() const noexcept {
    return servo ? is(control::ServoKind::position_servo) : memory.limits_on != 0;
  }
  /// Whether it has this servo.
  [[nodiscard]] bool is(control::ServoKind kind) const noexcept { return servo && servo->kind == kind; }
  /// Of the preset that the unit takes as a command: N·m/rad with a torque servo, else the law's; empty: it takes none.
  [[nodiscard]] std::string_view preset_unit() const noexcept;
  /// The references that the controller lets motor i have, raw, in the sense of the wire; the widest that it can hold if it doesn't
  /// limit.
  [[nodiscard]] std::array<std::int32_t, 2> reference_range_raw(int i) const noexcept;
  bool operator==(const UnitConfig&) const = default;
};

/// A linear actuator (ActuatorParams::linear()) that turns a joint by a rack on a pinion of this radius: what was m, N and kg at its
/// shaft is rad, N·m and kg·m² at the joint, q = ρ ψ, τ = ρ F, J = ρ² m.
[[nodiscard]] UnitConfig at_pinion(UnitConfig unit, double radius_m);

/// Adds what no unit could have: numbers that aren't finite or outside what the models need, no transmission, what doesn't go
/// together. `where` leads each key. A file's own bounds are checked where it is read.
void validate(const UnitConfig& config, std::string_view where, Problems& problems);
/// Whether two units are alike, laws compared by value (elastic::Transmission::equals).
[[nodiscard]] bool alike(const UnitConfig& a, const UnitConfig& b) noexcept;

}  // namespace vsa::device
