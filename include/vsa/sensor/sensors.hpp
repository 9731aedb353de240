// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the unit's electronics read.
//
// Encoder  magnetic rotary sensor (AS5045): B bits a turn, sampled, floor quantisation, wraps each turn. The firmware keeps the
//          sample in the upper bits of 16, so one count of 12 bits is 16 raw = 1.534 mrad; counting turns is its business.
// Current  12-bit ADC, offset 1638 counts, 25771/8192 mA a count (firmware; the paper: 5/1638 of its unit).
// Supply   12-bit ADC, offset 1638 counts, 1952/128 mV a count.
#pragma once

#include <cstdint>

#include "vsa/units.hpp"

namespace vsa::sensor {

struct EncoderParams {
  int bits = 12;        ///< 1…16
  double zero_rad = 0;  ///< reading = angle + zero
  bool operator==(const EncoderParams&) const = default;
};

/// Position within the turn in raw units (65536 a turn), as a signed 16-bit number: −32768…32767.
[[nodiscard]] std::int32_t encoder_sample(const EncoderParams& p, double angle_rad) noexcept;

inline constexpr int kAdcMax = 4095;
inline constexpr int kAdcOffset = 1638;

[[nodiscard]] int current_adc(double magnitude_A) noexcept;
[[nodiscard]] MilliAmp current_from_adc(int counts) noexcept;
[[nodiscard]] int supply_adc(double volts) noexcept;
[[nodiscard]] MilliVolt supply_from_adc(int counts) noexcept;

}  // namespace vsa::sensor
