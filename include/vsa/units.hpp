// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vsa {

/// A position as the device counts it: 65536 per turn. The device's integer units are distinct types, so that a tick can't be taken
/// for a milliampere.
struct Raw {
  std::int32_t value = 0;  ///< raw, of one turn in 65536
  constexpr bool operator==(const Raw&) const = default;
};

/// A position as the bus carries it: raw >> resolution, 32768 per turn by default, 16 bits.
struct Ticks {
  std::int16_t value = 0;  ///< of that encoder
  constexpr bool operator==(const Ticks&) const = default;
};

/// A current as the device reports it.
struct MilliAmp {
  std::int32_t value = 0;  ///< mA
  constexpr bool operator==(const MilliAmp&) const = default;
};

/// A voltage as the device reports it.
struct MilliVolt {
  std::int32_t value = 0;  ///< mV
  constexpr bool operator==(const MilliVolt&) const = default;
};

inline constexpr double kPi = 3.14159265358979323846;  ///< half a turn, rad
inline constexpr double kRawPerTurn = 65536.0;         ///< a turn

/// A time in s, as people write it: 3 000 000 ns is the double that "0.003" reads as. Times 1e-9 it is another in four of ten.
[[nodiscard]] constexpr double seconds_of(std::int64_t ns) noexcept { return static_cast<double>(ns) / 1e9; }

/// Words of a turning shaft as a sliding one has them: "torque [N·m]" → "force [N]", "load_torque_Nm" → "load_force_N", "N·m/rad" →
/// "N/m", "deflection_rad" → "deflection_m", "rad/s" → "m/s". What has nothing of that stays.
[[nodiscard]] std::string sliding(std::string_view words);

/// A unit as a column or an attribute ends in it: "N·m/rad" → "Nm_per_rad", "N/m" → "N_per_m", "rad" as it is.
[[nodiscard]] std::string_view unit_word(std::string_view unit);

constexpr double radians(Raw raw) { return raw.value * (2.0 * kPi / kRawPerTurn); }  ///< of that encoder

}  // namespace vsa
