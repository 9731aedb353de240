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

/// Whether the addition theorems' short series hold.
template <class Side>
auto TwoSinh::near(const Side& side, typename Side::Number begin, typename Side::Number move) const noexcept {
  const double d = params_.linear_beyond_rad;
  return (lanes::abs(side(params_.a_per_rad) * move) < series::kShort) & (lanes::abs(begin) <= d) & (lanes::abs(begin + move) <= d);
}

template <class T>
void TwoSinh::move_lanes(OriginOf<T>& here, const PositionsOf<T>& to) const noexcept {
  lanes::Truth<T> anew = here.moves + 1 >= series::kMoves;
  std::array<T, 2> sinh, less_1;
  lanes::each_side<T>([&](auto side) {
    using N = typename decltype(side)::Number;
    const N begin = here.at.q - side(here.at.x), move = (to.q - side(to.x)) - begin;
    if constexpr (lanes::kScalar<T>) {
      anew = anew | !lanes::all(near(side, begin, move));
    } else {
      anew = anew | !near(side, begin, move);
    }
    const N z = side(params_.a_per_rad) * move;
    const auto h = series::moved<N>(side(here.kept), side(here.kept_too), z * series::sinhc(z).value, z);
    side.put(sinh, h.sinh);
    side.put(less_1, h.cosh_less_1);
  });
  if constexpr (lanes::kScalar<T>) {
    if (anew) {
      here = origin(to);
      return;
    }
  }
  // Member by member, as in all that a step does: a copy of the whole would wait for numbers that were stored one by one.
  here.at.q = to.q;
  lanes::each_side<T>([&](auto side) {
    side.put(here.at.x, side(to.x));
    side.put(here.kept, side(sinh));
    side.put(here.kept_too, side(less_1));
  });
  here.moves = here.moves + 1;
  if constexpr (!lanes::kScalar<T>) {
    for (int lane = 0; lanes::any(anew) && lane < T::kWidth; ++lane) {
      if (!anew.lane(lane)) continue;
      const Origin one = origin({to.q.lane(lane), {to.x[0].lane(lane), to.x[1].lane(lane)}});
      for (std::size_t i = 0; i < 2; ++i) {
        here.kept[i].set_lane(lane, one.kept[i]);
        here.kept_too[i].set_lane(lane, one.kept_too[i]);
      }
      here.moves.set_lane(lane, one.moves);
    }
  }
}

template <class T, class Side>
auto TwoSinh::mean_near(const Side& side, const OriginOf<T>& from, typename Side::Number begin, typename Side::Number move,
                        T ahead) const noexcept -> MeanOf<typename Side::Number> {
  using N = typename Side::Number;
  const auto k = side(params_.k_Nm), a = side(params_.a_per_rad), half_c = 0.5 * side(params_.c_Nm_per_rad);
  const N half = 0.5 * a * move;
  const auto s = series::sinhc(half);
  N middle = half, sinh_middle = half * s.value;
  if (lanes::any(ahead != 0.0)) {  // adding 0 changes no bit
    middle += a * ahead;
    sinh_middle = middle * series::sinhc(middle).value;
    begin += ahead;
  }
  const auto h = series::moved<N>(side(from.kept), side(from.kept_too), sinh_middle, middle);
  return {k * h.sinh * s.value + half_c * (begin + begin + move), 0.5 * a * k * (h.cosh * s.value + h.sinh * s.slope) + half_c};
}

/// What the springs' own loads and slopes, xx, amount to.
template <class T>
void TwoSinh::sum(SegmentMeanOf<T>& mean) noexcept {
  mean.torque = 0.0 - mean.load[0] - mean.load[1];
  mean.slope.qq = mean.slope.xx[0] + mean.slope.xx[1];
  mean.slope.x0x1 = 0.0;
}

template <class T>
void TwoSinh::mean_lanes(const OriginOf<T>& from, const PositionsOf<T>& to, T ahead, SegmentMeanOf<T>& mean) const noexcept {
  lanes::each_side<T>([&](auto side) {
    using N = typename decltype(side)::Number;
    const N begin = from.at.q - side(from.at.x), end = to.q - side(to.x), move = end - begin;
    auto close = near(side, begin, move);
    if (lanes::any(ahead != 0.0)) {
      const auto led = near(side, begin, ahead) & near(side, begin, move + ahead);
      if constexpr (lanes::kScalar<T>) {
        close = close & led;
      } else {
        close = close & ((ahead == 0.0) | led);
      }
    }
    MeanOf<N> m = mean_near<T>(side, from, begin, move, ahead);
    if (!lanes::all(close)) mean_far(side, close, begin, end, ahead, m);
    side.put(mean.load, m.torque);
    side.put(mean.slope.qx, -m.slope);
    side.put(mean.slope.xx, m.slope);
  });
  sum(mean);
}

/// Those that went far, one by one.
template <class Side, class Mask, class T>
void TwoSinh::mean_far(const Side& side, Mask close, typename Side::Number begin, typename Side::Number end, T ahead,
                       MeanOf<typename Side::Number>& m) const noexcept {
  for (int lane = 0; lane < Side::Number::kWidth; ++lane) {
    if (close.lane(lane)) continue;
    Mean one;
    if constexpr (lanes::kScalar<T>) {
      one = this->mean(static_cast<std::size_t>(lane), begin.lane(lane) + ahead, end.lane(lane) + ahead);
    } else {
      one = this->mean(side.i, begin.lane(lane) + ahead.lane(lane), end.lane(lane) + ahead.lane(lane));
    }
    m.torque.set_lane(lane, one.torque);
    m.slope.set_lane(lane, one.slope);
  }
}

template <class T>
TangentOf<T> TwoSinh::tangent_lanes(const OriginOf<T>& here) const noexcept {
  TangentOf<T> t;
  std::array<T, 2> stiffnesses;
  lanes::each_side<T>([&](auto side) {
    using N = typename decltype(side)::Number;
    const auto k = side(params_.k_Nm), a = side(params_.a_per_rad), c = side(params_.c_Nm_per_rad);
    const N deflection = here.at.q - side(here.at.x), beyond = lanes::abs(deflection) - params_.linear_beyond_rad;
    const auto past = beyond > 0.0;
    N stiffness = a * k * (1.0 + side(here.kept_too)) + c, tension = lanes::abs(k * side(here.kept) + c * deflection);
    if (lanes::any(past)) {
      const auto edge = side(edge_[0].stiffness, edge_[1].stiffness);
      stiffness = lanes::select(past, N(edge), stiffness);
      tension = lanes::select(past, side(edge_[0].torque, edge_[1].torque) + beyond * edge, tension);
    }
    side.put(stiffnesses, stiffness);
    side.put(t.tension, tension);
  });
  t.stiffness = stiffnesses[0] + stiffnesses[1];
  return t;
}

template <class Side, class T>
auto TwoSinh::energy_near(const Side& side, const OriginOf<T>& here) const noexcept {
  using N = typename Side::Number;
  const N deflection = here.at.q - side(here.at.x), beyond = lanes::abs(deflection) - params_.linear_beyond_rad;
  const auto past = beyond > 0.0;
  const N inside = side(params_.k_Nm) / side(params_.a_per_rad) * side(here.kept_too) +
                   0.5 * side(params_.c_Nm_per_rad) * deflection * deflection;
  if (!lanes::any(past)) return inside;
  const N further = N(side(edge_[0].torque, edge_[1].torque)) + 0.5 * beyond * side(edge_[0].stiffness, edge_[1].stiffness);
  return lanes::select(past, side(edge_[0].energy, edge_[1].energy) + beyond * further, inside);
}

template <class T>
std::array<T, 2> TwoSinh::signed_energies_lanes(const OriginOf<T>& here) const noexcept {
  std::array<T, 2> w;
  lanes::each_side<T>([&](auto side) {
    using N = typename decltype(side)::Number;
    side.put(w, lanes::copysign(energy_near(side, here), N(here.at.q - side(here.at.x))));
  });
  return w;
}

}  // namespace vsa::elastic
