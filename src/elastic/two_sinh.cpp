// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/two_sinh.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::elastic {
namespace {

constexpr double kShort = 0.1;  // of a series' argument
constexpr int kMoves = 64;      // origins from each other: rounding grows by an ulp or two each

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

/// By Taylor to z⁸: below 1 ulp of 1 for |z| < 0.1.
Sinhc short_sinhc(double z) noexcept {
  constexpr double c3 = 1.0 / 6, c5 = 1.0 / 20, c7 = 1.0 / 42, c9 = 1.0 / 72;  // ratios of successive terms
  constexpr double d1 = 1.0 / 3, d3 = 1.0 / 10, d5 = 1.0 / 28, d7 = 1.0 / 54;
  const double z2 = z * z;
  return {1 + z2 * c3 * (1 + z2 * c5 * (1 + z2 * c7 * (1 + z2 * c9))), z * d1 * (1 + z2 * d3 * (1 + z2 * d5 * (1 + z2 * d7)))};
}

Sinhc sinhc(double z) noexcept {
  if (std::abs(z) < kShort) return short_sinhc(z);
  const Hyperbolic h = hyperbolic(z);
  const double value = h.sinh / z;
  return {value, (h.cosh - value) / z};
}

/// cosh z − 1 for |z| < 0.1, as above.
double short_cosh_less_1(double z) noexcept {
  constexpr double c2 = 1.0 / 2, c4 = 1.0 / 12, c6 = 1.0 / 30, c8 = 1.0 / 56, c10 = 1.0 / 90;
  const double z2 = z * z;
  return z2 * c2 * (1 + z2 * c4 * (1 + z2 * c6 * (1 + z2 * c8 * (1 + z2 * c10))));
}

/// At u + z from u, for |z| < 0.1.
Hyperbolic moved(double sinh, double less_1, double sinh_z, double z) noexcept {
  const double up = short_cosh_less_1(z);
  const double moved_sinh = sinh + (sinh * up + (1.0 + less_1) * sinh_z);
  const double moved_less_1 = less_1 + (up + less_1 * up + sinh * sinh_z);
  return {moved_sinh, 1.0 + moved_less_1, moved_less_1};
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
    (i == 0 ? r.curvature.x0x0 : r.curvature.x1x1) = s.stiffness;
  }
  return r;
}

double TwoSinh::energy(const Positions& at) const noexcept { return energy_of(origin(at)); }

std::array<double, 2> TwoSinh::signed_energies(const Positions& at) const noexcept { return signed_energies_of(origin(at)); }

inline void TwoSinh::add(std::size_t i, const Mean& m, SegmentMean& to) noexcept {
  to.torque -= m.torque;
  to.load[i] = m.torque;
  to.slope.qq += m.slope;
  to.slope.qx[i] = -m.slope;
  (i == 0 ? to.slope.x0x0 : to.slope.x1x1) = m.slope;
}

SegmentMean TwoSinh::mean_over(const Positions& from, const Positions& to) const noexcept {
  SegmentMean mean;
  for (std::size_t i = 0; i < 2; ++i) add(i, this->mean(i, from.q - from.x[i], to.q - to.x[i]), mean);
  return mean;
}

/// Whether the addition theorems' short series hold.
inline bool TwoSinh::near(std::size_t i, double begin, double move) const noexcept {
  const double d = params_.linear_beyond_rad;
  return std::abs(params_.a_per_rad[i] * move) < kShort && std::abs(begin) <= d && std::abs(begin + move) <= d;
}

bool TwoSinh::near_ahead(std::size_t i, double begin, double move, double ahead) const noexcept {
  return near(i, begin, ahead) && near(i, begin, move + ahead);
}

Origin TwoSinh::origin(const Positions& at) const noexcept {
  Origin here{at};
  for (std::size_t i = 0; i < 2; ++i) {
    const double deflection = at.q - at.x[i];
    if (std::abs(deflection) > params_.linear_beyond_rad) continue;  // the tangent needs none
    const Hyperbolic h = hyperbolic(params_.a_per_rad[i] * deflection);
    here.kept[2 * i] = h.sinh;
    here.kept[2 * i + 1] = h.cosh_less_1;
  }
  return here;
}

Origin TwoSinh::moved(const Origin& from, const Positions& to) const noexcept {
  Origin here{to, {}, from.moves + 1};
  for (std::size_t i = 0; i < 2; ++i) {
    const double begin = from.at.q - from.at.x[i], move = (to.q - to.x[i]) - begin;
    if (here.moves >= kMoves || !near(i, begin, move)) return origin(to);
    const double z = params_.a_per_rad[i] * move;
    const Hyperbolic h = elastic::moved(from.kept[2 * i], from.kept[2 * i + 1], z * short_sinhc(z).value, z);
    here.kept[2 * i] = h.sinh;
    here.kept[2 * i + 1] = h.cosh_less_1;
  }
  return here;
}

inline TwoSinh::Mean TwoSinh::mean_near(std::size_t i, const Origin& from, double begin, double move, double ahead) const noexcept {
  const double k = params_.k_Nm[i], a = params_.a_per_rad[i], half_c = 0.5 * params_.c_Nm_per_rad[i];
  const double half = 0.5 * a * move;
  const Sinhc s = short_sinhc(half);
  double middle = half, sinh_middle = half * s.value;
  if (ahead != 0.0) {
    middle += a * ahead;
    sinh_middle = middle * short_sinhc(middle).value;
    begin += ahead;
  }
  const Hyperbolic h = elastic::moved(from.kept[2 * i], from.kept[2 * i + 1], sinh_middle, middle);
  return {k * h.sinh * s.value + half_c * (begin + begin + move), 0.5 * a * k * (h.cosh * s.value + h.sinh * s.slope) + half_c};
}

SegmentMean TwoSinh::mean_from(const Origin& from, const Positions& to, double ahead) const noexcept {
  SegmentMean mean;
  for (std::size_t i = 0; i < 2; ++i) {
    const double begin = from.at.q - from.at.x[i], end = to.q - to.x[i];
    const bool close = near(i, begin, end - begin) && (ahead == 0.0 || near_ahead(i, begin, end - begin, ahead));
    add(i, close ? mean_near(i, from, begin, end - begin, ahead) : this->mean(i, begin + ahead, end + ahead), mean);
  }
  return mean;
}

Tangent TwoSinh::tangent_of(const Origin& here) const noexcept {
  Tangent t;
  for (std::size_t i = 0; i < 2; ++i) {
    const double k = params_.k_Nm[i], a = params_.a_per_rad[i], c = params_.c_Nm_per_rad[i];
    const double deflection = here.at.q - here.at.x[i], beyond = std::abs(deflection) - params_.linear_beyond_rad;
    if (beyond > 0) {
      t.stiffness += edge_[i].stiffness;
      t.tension[i] = edge_[i].torque + beyond * edge_[i].stiffness;
    } else {
      t.stiffness += a * k * (1.0 + here.kept[2 * i + 1]) + c;
      t.tension[i] = std::abs(k * here.kept[2 * i] + c * deflection);
    }
  }
  return t;
}

inline double TwoSinh::energy_of(std::size_t i, const Origin& here) const noexcept {
  const double deflection = here.at.q - here.at.x[i];
  const double beyond = std::abs(deflection) - params_.linear_beyond_rad;
  if (beyond > 0) return edge_[i].energy + beyond * (edge_[i].torque + 0.5 * beyond * edge_[i].stiffness);
  return params_.k_Nm[i] / params_.a_per_rad[i] * here.kept[2 * i + 1] + 0.5 * params_.c_Nm_per_rad[i] * deflection * deflection;
}

double TwoSinh::energy_of(const Origin& here) const noexcept { return energy_of(0, here) + energy_of(1, here); }

std::array<double, 2> TwoSinh::signed_energies_of(const Origin& here) const noexcept {
  return {std::copysign(energy_of(0, here), here.at.q - here.at.x[0]), std::copysign(energy_of(1, here), here.at.q - here.at.x[1])};
}

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

EquilibriumPreset TwoSinh::attained(const std::array<double, 2>& x) const noexcept {
  return {0.5 * (x[0] + x[1]), 0.5 * (x[0] - x[1])};
}

}  // namespace vsa::elastic
