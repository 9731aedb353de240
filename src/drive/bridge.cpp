// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/bridge.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::drive {

double bridge_voltage(const BridgeParams& p, double output, double full_duty) noexcept {
  const double magnitude = std::min(std::abs(output), 1.0);
  if (!(magnitude > p.dead_band)) return 0.0;
  const double shaped = (magnitude - p.dead_band) / (1.0 - p.dead_band);
  return std::copysign(shaped * full_duty * p.supply_V, output);
}

}  // namespace vsa::drive
