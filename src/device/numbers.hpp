// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "vsa/device/unit.hpp"

namespace vsa::device {

inline constexpr int kFull = 100;  ///< % of duty

[[nodiscard]] inline double seconds(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }

/// The advanced program turns the motors' words round.
[[nodiscard]] inline bool inverted(const UnitConfig& c) noexcept {
  return !c.servo && c.program.model == firmware::Model::advanced;
}

}  // namespace vsa::device
