// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every parameter of an actuator type but the elastic law's own: one table, from which files are checked, listings are printed and
// docs/reference/config.md is tested. A law's keys are its own (vsa/elastic/law.hpp).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "vsa/device/unit.hpp"

namespace vsa::config {

/// What kind of value a parameter has.
enum class Kind {
  number,   ///< finite, within bounds
  integer,  ///< a whole number within bounds
  toggle,   ///< true or false
  word,     ///< one of `words`, in the file as a string, or as a number where the words are numbers
  file      ///< the name of a file, seen from the type's own; only laws have such
};

/// What a parameter's setter gets: the number, 0 or 1 for a switch, or the index of the word.
using Setter = void (*)(device::UnitConfig& unit, double value);
/// The same for one of the two sides.
using SideSetter = void (*)(device::UnitConfig& unit, std::size_t side, double value);

/// Whether a file must have it; defaulted: else `default_value` counts.
enum class Need { required, optional, defaulted };

/// A row of the schema.
struct Parameter {
  std::string_view key;             ///< "drive.friction_Nm"
  std::string_view unit;            ///< "N·m"; "1" where it has none; kPresetUnit: the law's; empty for words and switches
  Kind kind = Kind::number;         ///< of its value
  double min = 0,                   ///< number, integer: least that is allowed
      max = 0;                      ///< most that is allowed
  std::string_view words;           ///< word: "brake|coast"
  std::string_view meaning;         ///< one line for listings
  Need need = Need::required;       ///< whether a file must have it
  std::string_view default_value;   ///< defaulted: as text
  std::string_view default_source;  ///< defaulted: where that came from
  Setter set = nullptr;             ///< null: `set_side` of both sides
  SideSetter set_side = nullptr;    ///< not null: the second side may have a value of its own, "drive_2.friction_Nm"
  bool second = false;              ///< this is that value: optional, in the place of what the first key gave both
  std::string_view controllers{};   ///< which controllers have it: "position_servo|torque_servo"; empty: all
  std::string_view shaft{};         ///< whose shaft's unit this is: "rad" or, of linear actuators, "m"; empty: all

  void apply(device::UnitConfig& to,
             double value) const;  ///< by `set`, or by `set_side`: on both sides, or on the second where it is that one's
};

/// A type's controllers (`control.kind`): "qbmove|position_servo|…". Keys of firmware.… are of the first.
inline constexpr std::string_view kControllers = "qbmove|position_servo|torque_servo|motor_voltages";
/// Those that have this parameter.
[[nodiscard]] std::string_view controllers_of(const Parameter& parameter) noexcept;

/// Stands for the unit of the law's preset; a law without a preset has no such parameter.
inline constexpr std::string_view kPresetUnit = "preset unit";

/// Those of the second side follow the group that they are of, made from its rows.
[[nodiscard]] std::span<const Parameter> parameters() noexcept;

/// Why an actuator with this law has no such parameter; empty: it may have it.
[[nodiscard]] std::string why_absent(const Parameter& parameter, const device::UnitConfig& unit);

/// The firmware's 16.16 fixed point of a gain, truncated toward zero as its C cast does: 0.1 → 6553, −0.8 → −52428.
[[nodiscard]] std::int32_t fixed_16_16(double gain) noexcept;

}  // namespace vsa::config
