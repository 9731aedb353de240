// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Faults on purpose, of one unit. Plain values; nothing here means a unit as it should be.
//
//   powered         false: the program is dead, silent, and has forgotten all but its EEPROM; the motors' enable pins are low. true
//                   again: a power-up, motors off (unless its start-up activation says otherwise), references and turns 0
//   lost, flipped   bytes on this unit's connection, heard or said, each with this probability; a flip is of one bit
//   late            answers come this much later; a master with a time table then talks into them
//   stuck           the encoder keeps the last word it gave;  noise: uniform within ± that angle before it is quantised
//   supply          another voltage at bridge and supply sensor; the program's limit and the power of the motors follow
//   unplugged       the motor's terminals hang open: no current, no brake
// Chance comes from `seed` alone: the same faults on the same run give the same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "vsa/device/chain.hpp"
#include "vsa/errors.hpp"

namespace vsa::device {

/// What one encoder has.
struct EncoderFault {
  bool stuck = false;    ///< keeps its last word
  double noise_rad = 0;  ///< 0 … π
  static auto fields(auto& s, auto&& visit) { return visit("stuck", "", s.stuck, "noise", "rad", s.noise_rad); }
  bool operator==(const EncoderFault&) const = default;
};

/// All that may be broken of one unit; the default is a unit as it should be.
struct Faults {
  bool powered = true;                    ///< false: no supply at the logic
  double lost_byte = 0;                   ///< 0 … 1
  double flipped_byte = 0;                ///< 0 … 1
  double late_s = 0;                      ///< 0 … 60
  std::array<EncoderFault, 3> encoder{};  ///< motor 1, motor 2, shaft
  std::optional<double> supply_V;         ///< 0 … 100; none: as configured
  std::array<bool, 2> motor_unplugged{};  ///< of each motor
  std::uint64_t seed = 1;                 ///< of bytes and noise
  bool operator==(const Faults&) const = default;
  static constexpr double kLatest_s = 60,  ///< of late_s
      kMostSupply_V = 100;                 ///< of supply_V

  [[nodiscard]] Wiring wiring() const noexcept;  ///< what of it concerns the line
  static auto fields(auto& s, auto&& visit) {
    return visit("powered", "", s.powered, "lost_byte", "", s.lost_byte, "flipped_byte", "", s.flipped_byte, "late", "s", s.late_s,
                 "encoder", "", s.encoder, "supply", "V", s.supply_V, "motor_unplugged", "", s.motor_unplugged, "seed", "", s.seed);
  }
  [[nodiscard]] const char* impossible() const noexcept;  ///< what validate() would find, without words
};

/// Adds what is out of bounds, each with its key behind `where`.
void validate(const Faults& faults, std::string_view where, Problems& problems);

}  // namespace vsa::device
