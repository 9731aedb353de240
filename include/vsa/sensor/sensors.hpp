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

/// Position within the turn in raw units (65536 per turn), as a signed 16-bit number: −32768…32767.
[[nodiscard]] inline std::int32_t encoder_sample(const EncoderParams& p, double angle_rad) noexcept {
  constexpr double kFarthest = 1e15;  // counts; beyond it a double has no counts left to tell
  const double counts = (angle_rad + p.zero_rad) * (static_cast<double>(1 << p.bits) / (2.0 * kPi));
  const double near = std::abs(counts) < kFarthest ? counts : 0.0;
  const auto cut = static_cast<std::int64_t>(near);
  const std::int64_t floored = cut - (static_cast<double>(cut) > near ? 1 : 0);
  const auto count = static_cast<std::int32_t>(floored & ((std::int64_t{1} << p.bits) - 1));
  const std::int32_t raw = count << (16 - p.bits);
  return raw >= 32768 ? raw - 65536 : raw;
}

inline constexpr int kAdcMax = 4095;     ///< of 12 bits
inline constexpr int kAdcOffset = 1638;  ///< of both sensors, at no current and no voltage

namespace detail {
[[nodiscard]] inline int to_counts(double milli, double counts_per_milli) noexcept {
  const bool finite = std::abs(milli) <= std::numeric_limits<double>::max();
  const int counts = static_cast<int>(std::clamp(finite ? milli * counts_per_milli : 1e6, -1e6, 1e6));
  return std::clamp(counts + kAdcOffset, 0, kAdcMax);
}
}  // namespace detail

/// Counts, cut at the ends of the scale.
[[nodiscard]] inline int current_adc(double magnitude_A) noexcept {
  return detail::to_counts(std::abs(magnitude_A) * 1e3, 8192.0 / 25771.0);
}
[[nodiscard]] MilliAmp current_from_adc(int counts) noexcept;  ///< as the program reads them, mA
/// Counts, cut at the ends of the scale.
[[nodiscard]] inline int supply_adc(double volts) noexcept { return detail::to_counts(volts * 1e3, 128.0 / 1952.0); }
[[nodiscard]] MilliVolt supply_from_adc(int counts) noexcept;  ///< as the program reads them, mV

}  // namespace vsa::sensor
