// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a unit's state is tied to: it goes over to other parameters of the same kind, and to no others.
#pragma once

#include <array>

#include "vsa/device/unit_config.hpp"

namespace vsa::host {

/// Controller (−1: the qbmove's program), firmware's model and dialect, number of motors (0: it has no law).
[[nodiscard]] std::array<int, 4> kind_of(const device::UnitConfig& unit) noexcept;

}  // namespace vsa::host
