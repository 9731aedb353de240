// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the unit's electronics read.
//
// Encoder  magnetic rotary sensor (AS5045): B bits per turn, sampled, floor quantisation, wraps each turn. The firmware keeps the
//          sample in the upper bits of 16, so one count of 12 bits is 16 raw = 1.534 mrad; counting turns is its business.
// Current  12-bit ADC, offset 1638 counts, 25771/8192 mA a count (firmware; the paper: 5/1638 of its unit).
// Supply   12-bit ADC, offset 1638 counts, 1952/128 mV a count.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "vsa/lanes.hpp"
#include "vsa/units.hpp"

namespace vsa {
class Problems;
}

namespace vsa::sensor {

/// An encoder on a motor's pulley or on the shaft.
struct EncoderParams {
  int bits = 12;        ///< 1…16
  double zero_rad = 0;  ///< reading = angle + zero
  bool operator==(const EncoderParams&) const = default;
};
void validate(const EncoderParams& params, std::string_view where, Problems& problems);  ///< 1 … 16 bits

/// Counts of an encoder's turn, from where it reads zero, not yet cut to whole ones; 0 beyond 1e15, where a double has none left to tell.
/// One angle, or several side by side (vsa/lanes.hpp).
template <class T>
[[nodiscard]] T encoder_counts(const EncoderParams& p, T angle_rad) noexcept {
  constexpr double kFarthest = 1e15;
  const T counts = (angle_rad + p.zero_rad) * (static_cast<double>(1 << p.bits) / (2.0 * kPi));
  return lanes::where<T>(lanes::abs(counts) < kFarthest, counts);
}
/// The raw word of |counts| < 1e15, floored, within its turn.
[[nodiscard]] inline std::int32_t encoder_word(const EncoderParams& p, double counts) noexcept {
  const auto cut = static_cast<std::int64_t>(counts);
  const std::int64_t floored = cut - (static_cast<double>(cut) > counts ? 1 : 0);
  // A turn's bits moved to the top: what overflows is other turns, and the first is the sign.
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(floored) << (32 - p.bits)) >> 16;
}

/// Position within the turn in raw units (65536 per turn), as a signed 16-bit number: −32768…32767.
[[nodiscard]] inline std::int32_t encoder_sample(const EncoderParams& p, double angle_rad) noexcept {
  return encoder_word(p, encoder_counts(p, angle_rad));
}

inline constexpr int kAdcMax = 4095;     ///< of 12 bits
inline constexpr int kAdcOffset = 1638;  ///< of both sensors, at no current and no voltage

namespace detail {
template <class T>
[[nodiscard]] T to_counts(T milli, double counts_per_milli) noexcept {
  const lanes::Truth<T> finite = lanes::abs(milli) <= std::numeric_limits<double>::max();
  return lanes::clamp(lanes::select(finite, milli * counts_per_milli, T(1e6)), -1e6, 1e6);
}
}  // namespace detail

/// An ADC's whole counts, its offset added, cut at the ends of its scale.
[[nodiscard]] inline int adc(double counts) noexcept { return std::clamp(static_cast<int>(counts) + kAdcOffset, 0, kAdcMax); }
/// Counts of a current, without the offset and not yet cut to whole ones. One current, or several side by side (vsa/lanes.hpp).
template <class T>
[[nodiscard]] T current_counts(T magnitude_A) noexcept {
  return detail::to_counts<T>(lanes::abs(magnitude_A) * 1e3, 8192.0 / 25771.0);
}
/// Counts, cut at the ends of the scale.
[[nodiscard]] inline int current_adc(double magnitude_A) noexcept { return adc(current_counts(magnitude_A)); }
[[nodiscard]] MilliAmp current_from_adc(int counts) noexcept;  ///< as the program reads them, mA
/// Counts, cut at the ends of the scale.
[[nodiscard]] inline int supply_adc(double volts) noexcept { return adc(detail::to_counts(volts * 1e3, 128.0 / 1952.0)); }
[[nodiscard]] MilliVolt supply_from_adc(int counts) noexcept;  ///< as the program reads them, mV

}  // namespace vsa::sensor
