// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A series elastic actuator with a second spring beside the first that a clutch engages: two stiffnesses, k and k + k₂, with
// k = 0 a joint that the clutch lets go.
//
//   H = ½ (k + k₂ s(u)) δ²,   δ = q − x₀,   u = x₁/w
//   s = u⁴ (35 − 84 u + 70 u² − 20 u³) from u = 0 (open) to 1 (engaged), 0 before and 1 after, smooth to its third derivative
//   σ = k + k₂ s,   load₁ = −½ k₂ s'(u) δ²/w
//
// The preset is the mover's angle x₁. At rest engaging is free. A deflected second spring is bent by whoever engages it: the
// mover pays ½ k₂ δ², and gets it back on the way out; between, the joint pushes the clutch open.
//
// What that isn't: a clutch that latches where the shaft is, so that its spring rests there, holds what it stores and lets it go at
// will (the switch-and-hold of bi-stiffness actuation). Where it latched is a state, which no potential has; here the second spring
// rests where the first does. Nor does anything slip, lose energy, or engage at once.
//
// Sources: D. Ossadnik and others, BSA: bi-stiffness actuation for optimally exploiting intrinsic compliance, IROS 2022, and
// E. P. Fortunić and others, Optimally controlling the timing of energy transfer in elastic joints, RA-L 8 (2023) 8106, for the idea; this law and its smooth clutch: ours.
#include <algorithm>

#include "elastic/laws/shapes.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kParameters[] = {
    {"stiffness_Nm_per_rad", "N·m/rad", 0, 1e7, "stiffness with the clutch open, k; 0: the joint is let go"},
    {"engaged_Nm_per_rad", "N·m/rad", 1e-6, 1e7, "what the clutch adds, k₂"},
    {"clutch_rad", "rad", 1e-3, 100, "the mover's way from open to engaged, w"},
};

struct Clutched {
  double first, second, way;
  bool operator==(const Clutched&) const = default;
  [[nodiscard]] Potential at(double d, double mover) const noexcept {
    const double u = std::clamp(mover / way, 0.0, 1.0), left = u * (1 - u),
                 in = u * u * u * u * (35 + u * (u * (70 - 20 * u) - 84));
    const double slope = 140 * left * left * left / way, bend = 420 * left * left * (1 - 2 * u) / (way * way);
    const double rate = first + second * in, half = 0.5 * second * d * d;
    return {0.5 * rate * d * d, rate * d, half * slope, rate, second * slope * d, half * bend};
  }
};

}  // namespace

extern const Law kBiStiffness{
    .name = "bi_stiffness",
    .title = "series elastic with a second spring on a clutch",
    .equation = "H = (k + k₂ s(x₁/w)) δ²/2,  s = u⁴ (35 − 84u + 70u² − 20u³), 0 … 1",
    .source = "D. Ossadnik and others, IROS 2022 (BSA), for the idea; the law: derived here, its clutch doesn't latch",
    .parameters = kParameters,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<Clutched>>(Clutched{v[0], v[1], v[2]});
    },
};

}  // namespace vsa::elastic
