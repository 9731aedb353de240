// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/actuator/ledger.hpp"

namespace vsa::actuator {

/// What an actuator turned to heat, J: copper, bridge, conversion, and all frictions.
[[nodiscard]] inline double heat(const Ledger& l) noexcept {
  return l.copper + l.bridge + l.conversion + l.viscous + l.motor_friction + l.shaft_friction + l.tendon_friction;
}

}  // namespace vsa::actuator
