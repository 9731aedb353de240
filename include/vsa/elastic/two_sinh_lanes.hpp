// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The law along a simulation's steps, for one unit or several side by side (vsa/lanes.hpp). Nearly always a spring moves little
// within a step: short series serve all lanes. The others, one in 64 steps and after jumps, are worked out one by one.
#pragma once

#include "vsa/elastic/two_sinh.hpp"

namespace vsa::elastic {

namespace series {

inline constexpr double kShort = 0.1;  // of an argument
inline constexpr int kMoves = 64;      // origins from each other: rounding grows by an ulp or two each

/// sinh and cosh − 1.
template <class T>
struct HyperbolicOf {
  T sinh,           ///< sinh u
      cosh,         ///< cosh u
      cosh_less_1;  ///< cosh u − 1
};

/// sinhc z = sinh z / z and its derivative.
template <class T>
struct SinhcOf {
  T value,    ///< sinhc z
      slope;  ///< d sinhc/dz
};

/// By Taylor to z⁸: below 1 ulp of 1 for |z| < 0.1.
template <class T>
[[nodiscard]] SinhcOf<T> sinhc(T z) noexcept {
  constexpr double c3 = 1.0 / 6, c5 = 1.0 / 20, c7 = 1.0 / 42, c9 = 1.0 / 72;  // ratios of successive terms
  constexpr double d1 = 1.0 / 3, d3 = 1.0 / 10, d5 = 1.0 / 28, d7 = 1.0 / 54;
  const T z2 = z * z;
  return {1.0 + z2 * c3 * (1.0 + z2 * c5 * (1.0 + z2 * c7 * (1.0 + z2 * c9))),
          z * d1 * (1.0 + z2 * d3 * (1.0 + z2 * d5 * (1.0 + z2 * d7)))};
}

/// cosh z − 1, as above.
template <class T>
[[nodiscard]] T cosh_less_1(T z) noexcept {
  constexpr double c2 = 1.0 / 2, c4 = 1.0 / 12, c6 = 1.0 / 30, c8 = 1.0 / 56, c10 = 1.0 / 90;
  const T z2 = z * z;
  return z2 * c2 * (1.0 + z2 * c4 * (1.0 + z2 * c6 * (1.0 + z2 * c8 * (1.0 + z2 * c10))));
}

/// At u + z from u.
template <class T>
[[nodiscard]] HyperbolicOf<T> moved(T sinh, T less_1, T sinh_z, T z) noexcept {
  const T up = cosh_less_1(z);
  const T moved_sinh = sinh + (sinh * up + (1.0 + less_1) * sinh_z);
  const T moved_less_1 = less_1 + (up + less_1 * up + sinh * sinh_z);
  return {moved_sinh, 1.0 + moved_less_1, moved_less_1};
}

}  // namespace series

template <class T>
void TwoSinh::add(std::size_t i, const MeanOf<T>& m, SegmentMeanOf<T>& to) noexcept {
  to.torque -= m.torque;
  to.load[i] = m.torque;
  to.slope.qq += m.slope;
  to.slope.qx[i] = -m.slope;
  (i == 0 ? to.slope.x0x0 : to.slope.x1x1) = m.slope;
}

/// Whether the addition theorems' short series hold.
template <class T>
lanes::Truth<T> TwoSinh::near(std::size_t i, T begin, T move) const noexcept {
  const double d = params_.linear_beyond_rad;
  return (lanes::abs(params_.a_per_rad[i] * move) < series::kShort) & (lanes::abs(begin) <= d) & (lanes::abs(begin + move) <= d);
}

template <class T>
OriginOf<T> TwoSinh::moved_lanes(const OriginOf<T>& from, const PositionsOf<T>& to) const noexcept {
  OriginOf<T> here{to, {}, from.moves + 1};
  lanes::Truth<T> anew = here.moves >= series::kMoves;
  for (std::size_t i = 0; i < 2; ++i) {
    const T begin = from.at.q - from.at.x[i], move = (to.q - to.x[i]) - begin;
    anew = anew | !near(i, begin, move);
    const T z = params_.a_per_rad[i] * move;
    const auto h = series::moved(from.kept[2 * i], from.kept[2 * i + 1], z * series::sinhc(z).value, z);
    here.kept[2 * i] = h.sinh;
    here.kept[2 * i + 1] = h.cosh_less_1;
  }
  if (!lanes::any(anew)) return here;
  if constexpr (lanes::kScalar<T>) {
    return origin(to);
  } else {
    for (int lane = 0; lane < T::kWidth; ++lane) {
      if (!anew.lane(lane)) continue;
      const Origin one = origin({to.q.lane(lane), {to.x[0].lane(lane), to.x[1].lane(lane)}});
      for (std::size_t k = 0; k < 4; ++k) here.kept[k].set_lane(lane, one.kept[k]);
      here.moves.set_lane(lane, one.moves);
    }
    return here;
  }
}

template <class T>
TwoSinh::MeanOf<T> TwoSinh::mean_near(std::size_t i, const OriginOf<T>& from, T begin, T move, T ahead) const noexcept {
  const double k = params_.k_Nm[i], a = params_.a_per_rad[i], half_c = 0.5 * params_.c_Nm_per_rad[i];
  const T half = 0.5 * a * move;
  const auto s = series::sinhc(half);
  T middle = half, sinh_middle = half * s.value;
  if (lanes::any(ahead != 0.0)) {  // adding 0 changes no bit
    middle += a * ahead;
    sinh_middle = middle * series::sinhc(middle).value;
    begin += ahead;
  }
  const auto h = series::moved(from.kept[2 * i], from.kept[2 * i + 1], sinh_middle, middle);
  return {k * h.sinh * s.value + half_c * (begin + begin + move), 0.5 * a * k * (h.cosh * s.value + h.sinh * s.slope) + half_c};
}

template <class T>
SegmentMeanOf<T> TwoSinh::mean_lanes(const OriginOf<T>& from, const PositionsOf<T>& to, T ahead) const noexcept {
  SegmentMeanOf<T> mean;
  for (std::size_t i = 0; i < 2; ++i) {
    const T begin = from.at.q - from.at.x[i], end = to.q - to.x[i], move = end - begin;
    const lanes::Truth<T> close = near(i, begin, move) & ((ahead == 0.0) | (near(i, begin, ahead) & near(i, begin, move + ahead)));
    if constexpr (lanes::kScalar<T>) {
      add(i, close ? mean_near(i, from, begin, move, ahead) : this->mean(i, begin + ahead, end + ahead), mean);
    } else {
      MeanOf<T> m = mean_near(i, from, begin, move, ahead);
      for (int lane = 0; !lanes::all(close) && lane < T::kWidth; ++lane) {
        if (close.lane(lane)) continue;
        const Mean one = this->mean(i, begin.lane(lane) + ahead.lane(lane), end.lane(lane) + ahead.lane(lane));
        m.torque.set_lane(lane, one.torque);
        m.slope.set_lane(lane, one.slope);
      }
      add(i, m, mean);
    }
  }
  return mean;
}

template <class T>
TangentOf<T> TwoSinh::tangent_lanes(const OriginOf<T>& here) const noexcept {
  TangentOf<T> t;
  for (std::size_t i = 0; i < 2; ++i) {
    const double k = params_.k_Nm[i], a = params_.a_per_rad[i], c = params_.c_Nm_per_rad[i];
    const T deflection = here.at.q - here.at.x[i], beyond = lanes::abs(deflection) - params_.linear_beyond_rad;
    const lanes::Truth<T> past = beyond > 0.0;
    const T stiffness = a * k * (1.0 + here.kept[2 * i + 1]) + c, tension = lanes::abs(k * here.kept[2 * i] + c * deflection);
    t.stiffness += lanes::select(past, T(edge_[i].stiffness), stiffness);
    t.tension[i] = lanes::select(past, edge_[i].torque + beyond * edge_[i].stiffness, tension);
  }
  return t;
}

template <class T>
T TwoSinh::energy_of(std::size_t i, const OriginOf<T>& here) const noexcept {
  const T deflection = here.at.q - here.at.x[i], beyond = lanes::abs(deflection) - params_.linear_beyond_rad;
  const lanes::Truth<T> past = beyond > 0.0;
  const T inside =
      params_.k_Nm[i] / params_.a_per_rad[i] * here.kept[2 * i + 1] + 0.5 * params_.c_Nm_per_rad[i] * deflection * deflection;
  if (!lanes::any(past)) return inside;
  return lanes::select(past, edge_[i].energy + beyond * (edge_[i].torque + 0.5 * beyond * edge_[i].stiffness), inside);
}

template <class T>
std::array<T, 2> TwoSinh::signed_energies_lanes(const OriginOf<T>& here) const noexcept {
  return {lanes::copysign(energy_of(0, here), here.at.q - here.at.x[0]),
          lanes::copysign(energy_of(1, here), here.at.q - here.at.x[1])};
}

}  // namespace vsa::elastic
