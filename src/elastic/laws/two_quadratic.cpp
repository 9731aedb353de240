// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Antagonists with quadratic springs that only pull (AMASC): stiffness linear in the preset.
//
//   e₁ = x₀ − q + e₀,  e₂ = q − x₁ + e₀
//   V_i = ⅓ K_i max(e_i, 0)³,   T_i = K_i max(e_i, 0)²,   S_i = 2 K_i max(e_i, 0)
//
// Equal springs, both taut: τ = −4K (p + e₀)(q − θ), a straight line of slope σ = 4K (p + e₀). Any deflection.
//
// Source: J. W. Hurst, J. Chestnutt, A. Rizzi, An actuator with physically variable stiffness for highly dynamic legged locomotion, ICRA
// 2004, for the idea; σ = 4Kp in every review; the potential: ours.
#include <algorithm>

#include "elastic/laws/shapes.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kParameters[] = {
    {"K1_Nm_per_rad2", "N·m/rad²", 1e-6, 1e6, "quadratic rate of the spring to motor 1"},
    {"K2_Nm_per_rad2", "N·m/rad²", 1e-6, 1e6, "quadratic rate of the spring to motor 2"},
    {"pretension_rad", "rad", 0, 10, "elongation of both at preset 0, e₀"},
};

struct Quadratic {
  double k, before;
  bool operator==(const Quadratic&) const = default;

  struct At {
    double energy, torque, stiffness;
  };
  [[nodiscard]] At at(double elongation) const noexcept {
    const double e = std::max(elongation + before, 0.0);
    return {k / 3 * e * e * e, k * e * e, 2 * k * e};
  }
  struct Mean {
    double torque, slope;
  };
  [[nodiscard]] Mean mean(double from, double to) const noexcept {
    const double a = from + before, b = to + before;
    if (a >= 0 && b >= 0) return {k / 3 * (a * a + a * b + b * b), k / 3 * (a + 2 * b)};
    if (a <= 0 && b <= 0) return {0, 0};
    // It goes slack or taut on the way: exact by the energy.
    const At begin = at(from), end = at(to);
    const double torque = (end.energy - begin.energy) / (to - from);
    return {torque, (end.torque - torque) / (to - from)};
  }
};

}  // namespace

extern const Law kTwoQuadratic{
    .name = "two_quadratic",
    .title = "two quadratic springs against each other, which only pull",
    .equation = "H = Σ K/3 max(e, 0)³,  e₁ = x₀ − q + e₀, e₂ = q − x₁ + e₀",
    .source = "J. W. Hurst and others, ICRA 2004 (AMASC)",
    .parameters = kParameters,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<TwoSprings<Quadratic>>(std::array{Quadratic{v[0], v[2]}, Quadratic{v[1], v[2]}});
    },
};

}  // namespace vsa::elastic
