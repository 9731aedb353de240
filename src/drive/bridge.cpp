// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/bridge.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::drive {
namespace {

/// |shape(u)|
double shaped(const BridgeParams& p, double output) noexcept {
  const double magnitude = std::min(std::abs(output), 1.0);
  return magnitude > p.dead_band ? (magnitude - p.dead_band) / (1.0 - p.dead_band) : 0.0;
}

}  // namespace

double bridge_duty(const BridgeParams& p, double output, double full_duty) noexcept {
  return std::copysign(shaped(p, output) * full_duty, output);
}

double bridge_voltage(const BridgeParams& p, double supply_V, double output, double full_duty) noexcept {
  const double shape = shaped(p, output);
  return shape > 0 ? std::copysign(shape * full_duty * supply_V, output) : 0.0;
}

}  // namespace vsa::drive
