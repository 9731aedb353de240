// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// MACCEPA 2.0: the cable of a MACCEPA leaves its lever over a profile, which it wraps the farther the joint is deflected, so that
// its arm grows: stiffening where the plain one softens. Here the profile is an arc of radius R to either side, which begins at
// the lever's end B along the lever; the output's fixation is at C, a second motor shortens the cable by r x₁.
//
//   a = |δ|,  δ = q − x₀;  seen from the arc's middle (B, R) the fixation is at (I, J) = (C cos a − B, C sin a − R)
//   E = √(I² + J² − R²)                       straight part of the cable, m
//   λ = atan2(J, I) + atan2(R, E)             wrapped angle, which is the straight part's direction too
//   e = E + R λ − (C − B) + r x₁              spring's elongation, m;  H = ½ κ max(e, 0)²
//   e' = C sin(λ − a),   e'' = C cos(λ − a) (λ' − 1),   λ' = C cos(λ − a)/E
//
// R = 0 is the law maccepa; at rest any R has its stiffness, σ = κ r x₁ BC/(C − B). It stiffens up to some 0.5 to 1.5 rad, the
// farther the smaller B and R are beside C. The fixation must pass the arc: C > R + √(B² + R²). Beyond |δ| = π/2, where no
// profile goes on, e follows its tangent.
//
// Sources: B. Vanderborght and others, MACCEPA 2.0: compliant actuator used for energy efficient hopping robot Chobino1D,
// Autonomous Robots 31 (2011) 55, for the mechanism; I, J, E, λ and the torque as in the public l1va/maccepa_manipulator. The
// potential, λ' and e'' are ours; that program's force doesn't end where the cable goes slack.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "elastic/laws/shapes.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kParameters[] = {
    {"spring_N_per_m", "N/m", 1e-3, 1e7, "spring rate, κ"},
    {"arm_m", "m", 1e-4, 10, "lever from the motor to where the profile begins, B"},
    {"pivot_m", "m", 1e-4, 10, "distance of the cable's fixation on the output, C"},
    {"winch_m", "m", 1e-5, 1, "radius of the pretension winch, r"},
    {"profile_m", "m", 0, 10, "radius of the profile's arcs, R; 0: a plain MACCEPA"},
};

struct CableOverProfile {
  double rate, arm, pivot, winch, profile;
  bool operator==(const CableOverProfile&) const = default;

  struct Length {
    double value, slope, bend;  // by |δ|
  };
  [[nodiscard]] Length length(double a) const noexcept {
    const double along = pivot * std::cos(a) - arm, aside = pivot * std::sin(a) - profile;
    const double straight = std::sqrt(along * along + aside * aside - profile * profile);
    const double wrapped = std::atan2(aside, along) + std::atan2(profile, straight);
    const double slope = pivot * std::sin(wrapped - a), across = pivot * std::cos(wrapped - a);
    return {straight + profile * wrapped, slope, across * (across / straight - 1)};
  }
  [[nodiscard]] Potential at(double deflection, double mover) const noexcept {
    constexpr double kEnd = std::numbers::pi / 2;
    const double a = std::abs(deflection), beyond = a - std::min(a, kEnd);
    Length l = length(a - beyond);
    if (beyond > 0) l = {l.value + beyond * l.slope, l.slope, 0};
    return pulled(rate, {l.value - (pivot - arm) + winch * mover, std::copysign(l.slope, deflection), winch, l.bend, 0, 0});
  }
};

}  // namespace

extern const Law kMaccepa2{
    .name = "maccepa_2",
    .title = "MACCEPA 2.0: cable over a lever with a profile",
    .equation = "H = κ/2 max(E + R λ − (C − B) + r x₁, 0)²,  E: straight part of the cable, λ: angle of its wrapped part",
    .source = "B. Vanderborght and others, Autonomous Robots 31 (2011) 55; the arc as in l1va/maccepa_manipulator",
    .parameters = kParameters,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<CableOverProfile>>(CableOverProfile{v[0], v[1], v[2], v[3], v[4]});
    },
    .fault = [](std::span<const double> v) -> std::optional<LawFault> {
      if (v[2] > v[4] + std::hypot(v[1], v[4])) return std::nullopt;
      return LawFault{"pivot_m", "the cable's fixation doesn't pass the profile", "above R + √(B² + R²)"};
    },
};

}  // namespace vsa::elastic
