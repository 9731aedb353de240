// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the models need of a unit's parameters.
#include <string>

#include "vsa/checks.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::device {

void validate(const UnitConfig& c, std::string_view where, Problems& problems) {
  actuator::validate(c.actuator, where, problems);
  const std::string firmware = std::string(where) + "firmware.";
  firmware::validate(c.program, firmware, problems);
  firmware::validate(c.memory, firmware, problems);
  Checks check(where, problems);
  check.within("limits.preset_max", c.preset_max, 0, 100);
  check.within("physics.substep_max_s", c.substep_max_s, 1e-6, 1e-3);
}

bool alike(const UnitConfig& a, const UnitConfig& b) noexcept {
  if (!a.actuator.transmission || !b.actuator.transmission) return false;
  UnitConfig same_law = a;
  same_law.actuator.transmission = b.actuator.transmission;
  return same_law == b && a.actuator.transmission->equals(*b.actuator.transmission);
}

}  // namespace vsa::device
