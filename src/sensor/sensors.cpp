// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sensor/sensors.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::sensor {

std::int32_t encoder_sample(const EncoderParams& p, double angle_rad) noexcept {
  constexpr double kFarthest = 1e15;  // counts; beyond it a double has no counts left to tell
  const double counts = (angle_rad + p.zero_rad) * (static_cast<double>(1 << p.bits) / (2.0 * kPi));
  if (!(std::abs(counts) < kFarthest)) return 0;
  auto floored = static_cast<std::int64_t>(counts);
  if (static_cast<double>(floored) > counts) --floored;
  const auto count = static_cast<std::int32_t>(floored & ((std::int64_t{1} << p.bits) - 1));
  const std::int32_t raw = count << (16 - p.bits);
  return raw >= 32768 ? raw - 65536 : raw;
}

namespace {

int to_counts(double milli, double counts_per_milli) noexcept {
  if (!std::isfinite(milli)) return kAdcMax;
  return std::clamp(static_cast<int>(std::clamp(milli * counts_per_milli, -1e6, 1e6)) + kAdcOffset, 0, kAdcMax);
}

}  // namespace

int current_adc(double magnitude_A) noexcept { return to_counts(std::abs(magnitude_A) * 1e3, 8192.0 / 25771.0); }

MilliAmp current_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 25771) >> 13}; }

int supply_adc(double volts) noexcept { return to_counts(volts * 1e3, 128.0 / 1952.0); }

MilliVolt supply_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 1952) >> 7}; }

}  // namespace vsa::sensor
