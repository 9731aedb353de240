// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Antagonists with exponential springs, unlike if need be, each stronger to one side (DLR's BAVS).
//
//   e₁ = x₀ − q,  e₂ = q − x₁
//   V_i = (k_i/a) (eᵃᵉ + r e⁻ᵃᵉ − 2√r),   T_i = k_i (eᵃᵉ − r e⁻ᵃᵉ),   S_i = a k_i (eᵃᵉ + r e⁻ᵃᵉ)
//
// r = 0: springs that only pull. Then the shaft rests at (x₀ + x₁)/2 + ½ ln(k₁/k₂)/a whatever the preset, with stiffness
// 2 a √(k₁k₂) eᵃᵖ. r = 1: two_sinh with twice the k. Range: a |e| < 700.
//
// Source: the public NMMI/ROS-Gazebo-compliant-actuators-plugin (2021) for BAVS: τ₁ = −k(a e⁻ᶜᵈ − b eᶜᵈ) with k = 1.6e5,
// a = 1.21e-6, b = 2.38e-6, c = 8.71; as a potential: ours.
#include <algorithm>
#include <cmath>

#include "elastic/laws/shapes.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kParameters[] = {
    {"k1_Nm", "N·m", 1e-9, 1e3, "torque scale of the spring to motor 1"},
    {"k2_Nm", "N·m", 1e-9, 1e3, "torque scale of the spring to motor 2"},
    {"a_per_rad", "1/rad", 1e-3, 100, "hardening rate of both"},
    {"slack_ratio", "1", 0, 1, "torque scale to the slack side over that to the taut one, r; 0: springs that only pull"},
};

/// sinh(z)/z and its derivative.
struct Sinhc {
  double value, slope;
};
Sinhc sinhc(double z) noexcept {
  constexpr double kShort = 0.1;  // z⁸/362880 is below rounding
  const double s = z * z;
  if (std::abs(z) < kShort) return {1 + s / 6 * (1 + s / 20 * (1 + s / 42)), z / 3 * (1 + s / 10 * (1 + s / 28))};
  const double value = std::sinh(z) / z;
  return {value, (std::cosh(z) - value) / z};
}

struct Exponential {
  double k, a, r;
  bool operator==(const Exponential&) const = default;

  struct At {
    double energy, torque, stiffness;
  };
  [[nodiscard]] At at(double e) const noexcept {
    const double up = std::exp(a * e), down = r * std::exp(-a * e);
    return {k / a * (up + down - 2 * std::sqrt(r)), k * (up - down), a * k * (up + down)};
  }
  struct Mean {
    double torque, slope;
  };
  [[nodiscard]] Mean mean(double from, double to) const noexcept {
    const double m = 0.5 * a * (from + to), up = std::exp(m), down = r * std::exp(-m);
    const Sinhc s = sinhc(0.5 * a * (to - from));
    return {k * (up - down) * s.value, 0.5 * a * k * ((up + down) * s.value + (up - down) * s.slope)};
  }
};

}  // namespace

extern const Law kTwoExp{
    .name = "two_exp",
    .title = "two exponential springs against each other",
    .equation = "H = Σ k/a (eᵃᵉ + r e⁻ᵃᵉ − 2√r),  e₁ = x₀ − q, e₂ = q − x₁",
    .source = "NMMI/ROS-Gazebo-compliant-actuators-plugin, 2021 (BAVS)",
    .parameters = kParameters,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<TwoSprings<Exponential>>(std::array{Exponential{v[0], v[2], v[3]}, Exponential{v[1], v[2], v[3]}});
    },
};

}  // namespace vsa::elastic
