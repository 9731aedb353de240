// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// MACCEPA: a motor turns a lever of length B to the equilibrium x₀; a spring pulls the output's pivot, at distance C, towards it
// over a cable that a second motor shortens by r x₁.
//
//   δ = q − x₀,   ℓ(δ) = √(B² + C² − 2BC cos δ),   e = ℓ − (C − B) + r x₁         spring's elongation, m
//   H = ½ κ max(e, 0)²                                                          a cable can't push
//   ℓ' = BC sin δ/ℓ,   ℓ'' = (BC cos δ − ℓ'²)/ℓ
//
// The preset is the winch's angle x₁: at rest σ = κ r x₁ BC/(C − B). Valid for 0 < B < C, any δ.
//
// Source: R. Van Ham and others, MACCEPA, the mechanically adjustable compliance and controllable equilibrium position actuator,
// Robotics and Autonomous Systems 55 (2007) 761.
#include <cmath>

#include "elastic/laws/shapes.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/units.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kParameters[] = {
    {"spring_N_per_m", "N/m", 1e-3, 1e7, "spring rate, κ"},
    {"arm_m", "m", 1e-4, 10, "lever from the motor to the cable's guide, B"},
    {"pivot_m", "m", 1e-4, 10, "distance of the cable's fixation on the output, C"},
    {"winch_m", "m", 1e-5, 1, "radius of the pretension winch, r"},
};

struct Cable {
  double rate, arm, pivot, winch;
  bool operator==(const Cable&) const = default;
  [[nodiscard]] Potential at(double deflection, double mover) const noexcept {
    const double bc = arm * pivot, l = std::sqrt(arm * arm + pivot * pivot - 2 * bc * std::cos(deflection));
    const double slope = bc * std::sin(deflection) / l, bend = (bc * std::cos(deflection) - slope * slope) / l;
    return pulled(rate, {l - (pivot - arm) + winch * mover, slope, winch, bend, 0, 0});
  }
};

}  // namespace

extern const Law kMaccepa{
    .name = "maccepa",
    .title = "MACCEPA: cable over a lever",
    .equation = "H = κ/2 max(ℓ(δ) − (C − B) + r x₁, 0)²,  ℓ² = B² + C² − 2BC cos δ",
    .source = "R. Van Ham and others, Robotics and Autonomous Systems 55 (2007) 761",
    .parameters = kParameters,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<Cable>>(Cable{v[0], v[1], v[2], v[3]});
    },
    .fault = [](std::span<const double> v) -> std::optional<LawFault> {
      if (v[1] < v[2]) return std::nullopt;
      return LawFault{"arm_m", "must be shorter than elastic.pivot_m", "below elastic.pivot_m"};
    },
};

}  // namespace vsa::elastic
