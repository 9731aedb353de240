// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sensor/sensors.hpp"

#include "vsa/checks.hpp"

namespace vsa::sensor {

void validate(const EncoderParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  check.within("encoder_bits", p.bits, 1, 16);
  check.within("encoder_zero_rad", p.zero_rad, -1e3, 1e3);
}

MilliAmp current_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 25771) >> 13}; }

MilliVolt supply_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 1952) >> 7}; }

}  // namespace vsa::sensor
