// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the shaft coupling makes of a swing that a step resolves well or badly (host/robot.hpp). One undamped spring σ on one
// inertia 1/B, x = ω·dt, ω² = B σ, in units of dt and 1/B:
//     τ = −K (y + (½ + w) v),   K = x²/(1 + x² (¼ + ¾ w)),   w of actuator::lead_weight()
//     y' = y + v + τ/2,   v' = v + τ
// The two eigenvalues have the product 1 − K w and the sum 2 − K (1 + w). They are a complex pair at every x: the square of half
// their sum stays below their product.
#pragma once

#include <cmath>

#include "vsa/actuator/actuator.hpp"

namespace vsa::host {

/// How the coupling renders one undamped swing: 1 and 1 where the step resolves it.
struct Resolution {
  double radius = 1;     ///< of the swing's amplitude from one step to the next
  double frequency = 1;  ///< over the true one
};

/// x = ω·dt ≥ 0.
[[nodiscard]] inline Resolution resolution(double x) noexcept {
  if (!(x > 0)) return {};
  constexpr double kEndless = 1e150;  // its square is finite, and nothing is left of such a swing after a step
  const double k = std::fmin(x * x, kEndless), w = actuator::lead_weight(k), gain = k / (1.0 + k * (0.25 + 0.75 * w));
  const double product = 1.0 - gain * w, half_sum = 1.0 - 0.5 * gain * (1.0 + w);
  const double rest = std::fmax(product - half_sum * half_sum, 0.0);
  return {std::sqrt(product), std::atan2(std::sqrt(rest), half_sum) / x};
}

}  // namespace vsa::host
