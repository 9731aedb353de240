// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/two_sinh.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/checks.hpp"
#include "vsa/elastic/exp_less_1.hpp"
#include "vsa/elastic/two_sinh_lanes.hpp"

namespace vsa::elastic {
namespace {

/// sinh, cosh and cosh − 1 from one eᵘ − 1, accurate near zero too.
using Hyperbolic = series::HyperbolicOf<double>;

Hyperbolic hyperbolic(double u) noexcept {
  const double e = exp_less_1(std::abs(u));
  const double f = e / (1.0 + e);  // 1 − e^−|u|
  const double less_1 = 0.5 * e * f;
  return {std::copysign(0.5 * (e + f), u), 1.0 + less_1, less_1};
}

using Sinhc = series::SinhcOf<double>;

Sinhc sinhc(double z) noexcept {
  if (std::abs(z) < series::kShort) return series::sinhc(z);
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
    r.curvature.xx[i] = s.stiffness;
  }
  return r;
}

double TwoSinh::energy(const Positions& at) const noexcept { return energy_of(origin(at)); }

std::array<double, 2> TwoSinh::signed_energies(const Positions& at) const noexcept { return signed_energies_of(origin(at)); }

SegmentMean TwoSinh::mean_over(const Positions& from, const Positions& to) const noexcept {
  SegmentMean mean;
  for (std::size_t i = 0; i < 2; ++i) {
    const Mean m = this->mean(i, from.q - from.x[i], to.q - to.x[i]);
    mean.load[i] = m.torque;
    mean.slope.qx[i] = -m.slope;
    mean.slope.xx[i] = m.slope;
  }
  sum(mean);
  return mean;
}

Origin TwoSinh::origin(const Positions& at) const noexcept {
  Origin here{at};
  for (std::size_t i = 0; i < 2; ++i) {
    const double deflection = at.q - at.x[i];
    if (std::abs(deflection) > params_.linear_beyond_rad) continue;  // the tangent needs none
    const Hyperbolic h = hyperbolic(params_.a_per_rad[i] * deflection);
    here.kept[i] = h.sinh;
    here.kept_too[i] = h.cosh_less_1;
  }
  return here;
}

Origin TwoSinh::moved(const Origin& from, const Positions& to) const noexcept {
  Origin here = from;
  move_lanes(here, to);
  return here;
}

SegmentMean TwoSinh::mean_from(const Origin& from, const Positions& to, double ahead) const noexcept {
  SegmentMean mean;
  mean_lanes(from, to, ahead, mean);
  return mean;
}

Tangent TwoSinh::tangent_of(const Origin& here) const noexcept { return tangent_lanes(here); }

double TwoSinh::energy_of(const Origin& here) const noexcept {
  const lanes::Both energy = energy_near(lanes::BothSides{}, here);
  return energy.lane(0) + energy.lane(1);
}

std::array<double, 2> TwoSinh::signed_energies_of(const Origin& here) const noexcept { return signed_energies_lanes(here); }

bool TwoSinh::equals(const Transmission& other) const noexcept {
  const auto* same = dynamic_cast<const TwoSinh*>(&other);
  return same != nullptr && same->params_ == params_;
}

std::optional<EquilibriumPreset> TwoSinh::command_exactly(double q, double torque, double stiffness) const noexcept {
  const double a = params_.a_per_rad[0], k1 = params_.k_Nm[0], k2 = params_.k_Nm[1], d = params_.linear_beyond_rad;
  if (a != params_.a_per_rad[1] || params_.c_Nm_per_rad[0] != 0 || params_.c_Nm_per_rad[1] != 0) return std::nullopt;
  // k₁u + k₂v = A, k₁/u + k₂/v = B for u, v = exp(a δ):  B k₁ u² − (A B + k₁² − k₂²) u + A k₁ = 0
  const double A = stiffness / a - torque, B = stiffness / a + torque;
  const double middle = 0.5 * (A * B + k1 * k1 - k2 * k2), square = middle * middle - A * B * k1 * k1;
  if (!(A > 0) || !(B > 0) || !(middle > 0) || !(square >= 0)) return std::nullopt;
  const double larger = middle + std::sqrt(square);
  std::optional<EquilibriumPreset> best;
  for (const double u : {A * k1 / larger, larger / (B * k1)}) {
    const double v = (A - k1 * u) / k2;
    if (!(v > 0)) continue;
    const double d1 = std::log(u) / a, d2 = std::log(v) / a, preset = 0.5 * (d2 - d1);
    if (preset < 0 || std::abs(d1) > d || std::abs(d2) > d || (best && best->preset <= preset)) continue;
    best = EquilibriumPreset{q - 0.5 * (d1 + d2), preset};
  }
  return best;
}

std::array<double, 2> TwoSinh::references(const EquilibriumPreset& command) const noexcept {
  return {command.equilibrium + command.preset, command.equilibrium - command.preset};
}

void validate(const TwoSinhParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string n = std::to_string(i + 1);
    check.positive('k' + n + "_Nm", p.k_Nm[i]);
    check.positive('a' + n + "_per_rad", p.a_per_rad[i]);
    check.not_negative('c' + n + "_Nm_per_rad", p.c_Nm_per_rad[i]);
  }
  // Infinite: no edge.
  if (!(p.linear_beyond_rad > 0))
    check.refuse("linear_beyond_rad", Checks::text(p.linear_beyond_rad), "is out of range", "above 0");
}

void TwoSinh::validate(std::string_view where, Problems& problems) const { elastic::validate(params_, where, problems); }

EquilibriumPreset TwoSinh::attained(const std::array<double, 2>& x) const noexcept {
  return {0.5 * (x[0] + x[1]), 0.5 * (x[0] - x[1])};
}

}  // namespace vsa::elastic
