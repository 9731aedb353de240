// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "vsa/device/unit.hpp"

namespace vsa::device {

/// ẋ of the pulleys where the equilibrium moves with the shaft: the law's own slope, which is 1 for most.
[[nodiscard]] inline std::array<double, 2> pulley_speeds(const elastic::Transmission& law, const UnitPlace& at) noexcept {
  constexpr double kSmall_rad = 1e-4;
  const auto ahead = law.references({at.equilibrium + kSmall_rad, at.preset});
  const auto behind = law.references({at.equilibrium - kSmall_rad, at.preset});
  return {(ahead[0] - behind[0]) / (2 * kSmall_rad) * at.speed, (ahead[1] - behind[1]) / (2 * kSmall_rad) * at.speed};
}

}  // namespace vsa::device
