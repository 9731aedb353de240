// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sensor/sensors.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::sensor {

std::int32_t encoder_sample(const EncoderParams& p, double angle_rad) noexcept {
  const double counts_per_turn = static_cast<double>(1 << p.bits);
  const double turns = (angle_rad + p.zero_rad) / (2.0 * kPi);
  if (!std::isfinite(turns)) return 0;
  // Within the turn first: the count must not overflow for a shaft that has turned for hours.
  const double within = turns - std::floor(turns);
  const auto count = static_cast<std::int32_t>(within * counts_per_turn) & ((1 << p.bits) - 1);
  const std::int32_t raw = count << (16 - p.bits);
  return raw >= 32768 ? raw - 65536 : raw;
}

namespace {

int to_counts(double milli, double milli_per_count) noexcept {
  if (!std::isfinite(milli)) return kAdcMax;
  return std::clamp(static_cast<int>(std::clamp(milli / milli_per_count, -1e6, 1e6)) + kAdcOffset, 0, kAdcMax);
}

}  // namespace

int current_adc(double magnitude_A) noexcept { return to_counts(std::abs(magnitude_A) * 1e3, 25771.0 / 8192.0); }

MilliAmp current_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 25771) >> 13}; }

int supply_adc(double volts) noexcept { return to_counts(volts * 1e3, 1952.0 / 128.0); }

MilliVolt supply_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 1952) >> 7}; }

}  // namespace vsa::sensor
