// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whether a state's parameters are those of the unit that it is given to, told by one number.
#pragma once

#include <cstdint>

#include "vsa/device/unit_config.hpp"

namespace vsa::device {

/// Of all of a unit's parameters but its ID, which is the robot's: units that are alike() have the same. A law's own parameters count by
/// what it answers at some places, so the number is that of one machine's mathematical library. `config` has a law.
[[nodiscard]] std::uint64_t parameter_hash(const UnitConfig& config);

}  // namespace vsa::device
