// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/two_sinh.hpp"

#include <algorithm>
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

TwoSinh::TwoSinh(const TwoSinhParams& params) noexcept : params_(params) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (std::isfinite(params_.linear_beyond_rad)) edge_[i] = inside(i, params_.linear_beyond_rad);
  }
}

TwoSinh::Spring TwoSinh::inside(std::size_t i, double deflection) const noexcept {
  const double k = params_.k_Nm[i], a = params_.a_per_rad[i], c = params_.c_Nm_per_rad[i];
  const Hyperbolic h = hyperbolic(a * deflection);
  return {k / a * h.cosh_less_1 + 0.5 * c * deflection * deflection, k * h.sinh + c * deflection, a * k * h.cosh + c};
}

TwoSinh::Spring TwoSinh::spring(std::size_t i, double deflection) const noexcept {
  const double beyond = std::abs(deflection) - params_.linear_beyond_rad;
  if (!(beyond > 0)) return inside(i, deflection);
  const Spring& e = edge_[i];
  return {e.energy + beyond * (e.torque + 0.5 * beyond * e.stiffness), std::copysign(e.torque + beyond * e.stiffness, deflection),
          e.stiffness};
}

double TwoSinh::spring_energy(std::size_t i, double deflection) const noexcept {
  const double beyond = std::abs(deflection) - params_.linear_beyond_rad;
  if (beyond > 0) return edge_[i].energy + beyond * (edge_[i].torque + 0.5 * beyond * edge_[i].stiffness);
  const double a = params_.a_per_rad[i];
  return params_.k_Nm[i] / a * hyperbolic(a * deflection).cosh_less_1 + 0.5 * params_.c_Nm_per_rad[i] * deflection * deflection;
}

TwoSinh::Mean TwoSinh::mean_inside(std::size_t i, double begin, double end) const noexcept {
  const double k = params_.k_Nm[i], a = params_.a_per_rad[i], half_c = 0.5 * params_.c_Nm_per_rad[i];
  const Hyperbolic h = hyperbolic(0.5 * a * (begin + end));
  const Sinhc s = sinhc(0.5 * a * (end - begin));
  return {k * h.sinh * s.value + half_c * (begin + end), 0.5 * a * k * (h.cosh * s.value + h.sinh * s.slope) + half_c};
}

TwoSinh::Mean TwoSinh::mean(std::size_t i, double begin, double end) const noexcept {
  const double d = params_.linear_beyond_rad;
  if (std::abs(begin) <= d && std::abs(end) <= d) return mean_inside(i, begin, end);
  if (std::abs(begin) >= d && std::abs(end) >= d && (begin < 0) == (end < 0)) {
    return {0.5 * (spring(i, begin).torque + spring(i, end).torque), 0.5 * edge_[i].stiffness};
  }
  // Across an edge or two: piece by piece, each exact; then d(mean)/d(end) = (T(end) − mean)/(end − begin).
  const double low = std::min(begin, end), high = std::max(begin, end);
  double work = 0;
  if (low < -d) work += 0.5 * (spring(i, low).torque - edge_[i].torque) * (-d - low);
  if (high > d) work += 0.5 * (spring(i, high).torque + edge_[i].torque) * (high - d);
  const double from = std::max(low, -d), to = std::min(high, d);
  work += mean_inside(i, from, to).torque * (to - from);
  const double torque = work / (high - low);
  return {torque, (spring(i, end).torque - torque) / (end - begin)};
}

Response TwoSinh::evaluate(const Positions& at) const noexcept {
  Response r{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Spring s = spring(i, at.q - at.x[i]);
    r.energy += s.energy;
    r.load[i] = s.torque;
    r.torque -= s.torque;
    r.curvature.qq += s.stiffness;
    r.curvature.qx[i] = -s.stiffness;
    (i == 0 ? r.curvature.x0x0 : r.curvature.x1x1) = s.stiffness;
  }
  return r;
}

double TwoSinh::energy(const Positions& at) const noexcept {
  return spring_energy(0, at.q - at.x[0]) + spring_energy(1, at.q - at.x[1]);
}

std::array<double, 2> TwoSinh::signed_energies(const Positions& at) const noexcept {
  std::array<double, 2> w{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double deflection = at.q - at.x[i];
    w[i] = std::copysign(spring_energy(i, deflection), deflection);
  }
  return w;
}

SegmentMean TwoSinh::mean_over(const Positions& from, const Positions& to) const noexcept {
  SegmentMean mean;
  for (std::size_t i = 0; i < 2; ++i) {
    const Mean m = this->mean(i, from.q - from.x[i], to.q - to.x[i]);
    mean.torque -= m.torque;
    mean.load[i] = m.torque;
    mean.slope.qq += m.slope;
    mean.slope.qx[i] = -m.slope;
    (i == 0 ? mean.slope.x0x0 : mean.slope.x1x1) = m.slope;
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
