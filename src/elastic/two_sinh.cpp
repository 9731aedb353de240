// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/two_sinh.hpp"

#include <cmath>

namespace vsa::elastic {
namespace {

/// sinh, cosh and cosh − 1 from one expm1, accurate near zero too.
struct Hyperbolic {
  double sinh, cosh, cosh_less_1;
};

Hyperbolic hyperbolic(double u) noexcept {
  const double e = std::expm1(std::abs(u));  // e^|u| − 1
  const double f = e / (1.0 + e);            // 1 − e^−|u|
  const double less_1 = 0.5 * e * f;
  return {std::copysign(0.5 * (e + f), u), 1.0 + less_1, less_1};
}

/// sinhc z = sinh z / z and its derivative.
struct Sinhc {
  double value, slope;
};

Sinhc sinhc(double z) noexcept {
  const double z2 = z * z;
  if (z2 < 0.01) {                                                               // Taylor to z⁸: below 1 ulp of 1 for |z| < 0.1
    constexpr double c3 = 1.0 / 6, c5 = 1.0 / 20, c7 = 1.0 / 42, c9 = 1.0 / 72;  // ratios of successive terms
    constexpr double d1 = 1.0 / 3, d3 = 1.0 / 10, d5 = 1.0 / 28, d7 = 1.0 / 54;
    return {1 + z2 * c3 * (1 + z2 * c5 * (1 + z2 * c7 * (1 + z2 * c9))), z * d1 * (1 + z2 * d3 * (1 + z2 * d5 * (1 + z2 * d7)))};
  }
  const Hyperbolic h = hyperbolic(z);
  const double value = h.sinh / z;
  return {value, (h.cosh - value) / z};
}

}  // namespace

TwoSinh::TwoSinh(const TwoSinhParams& params) noexcept : params_(params) {}

Response TwoSinh::evaluate(const Positions& at) const noexcept {
  Response r{};
  for (int i = 0; i < 2; ++i) {
    const double k = params_.k_Nm[i];
    const double a = params_.a_per_rad[i];
    const Hyperbolic h = hyperbolic(a * (at.q - at.x[i]));
    const double stiffness = a * k * h.cosh;
    r.energy += k / a * h.cosh_less_1;
    r.torque -= k * h.sinh;
    r.load[i] = k * h.sinh;
    r.curvature.qq += stiffness;
    r.curvature.qx[i] = -stiffness;
    (i == 0 ? r.curvature.x0x0 : r.curvature.x1x1) = stiffness;
  }
  return r;
}

double TwoSinh::energy(const Positions& at) const noexcept {
  double energy = 0;
  for (int i = 0; i < 2; ++i) {
    const double a = params_.a_per_rad[i];
    energy += params_.k_Nm[i] / a * hyperbolic(a * (at.q - at.x[i])).cosh_less_1;
  }
  return energy;
}

SegmentMean TwoSinh::mean_over(const Positions& from, const Positions& to) const noexcept {
  SegmentMean mean;
  for (int i = 0; i < 2; ++i) {
    const double k = params_.k_Nm[i];
    const double a = params_.a_per_rad[i];
    const double begin = from.q - from.x[i];
    const double end = to.q - to.x[i];
    const Hyperbolic h = hyperbolic(0.5 * a * (begin + end));
    const Sinhc c = sinhc(0.5 * a * (end - begin));
    const double torque = k * h.sinh * c.value;
    const double slope = 0.5 * a * k * (h.cosh * c.value + h.sinh * c.slope);
    mean.torque -= torque;
    mean.load[i] = torque;
    mean.slope.qq += slope;
    mean.slope.qx[i] = -slope;
    (i == 0 ? mean.slope.x0x0 : mean.slope.x1x1) = slope;
  }
  return mean;
}

std::array<double, 2> TwoSinh::references(const EquilibriumPreset& command) const noexcept {
  return {command.equilibrium + command.preset, command.equilibrium - command.preset};
}

EquilibriumPreset TwoSinh::attained(const std::array<double, 2>& x) const noexcept {
  return {0.5 * (x[0] + x[1]), 0.5 * (x[0] - x[1])};
}

}  // namespace vsa::elastic
