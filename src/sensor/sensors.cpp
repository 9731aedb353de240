// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sensor/sensors.hpp"

namespace vsa::sensor {

MilliAmp current_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 25771) >> 13}; }

MilliVolt supply_from_adc(int counts) noexcept { return {((counts - kAdcOffset) * 1952) >> 7}; }

}  // namespace vsa::sensor
