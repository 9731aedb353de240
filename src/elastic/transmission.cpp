// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/transmission.hpp"

#include <cmath>

namespace vsa::elastic {
namespace {

Positions between(const Positions& from, const Positions& to, double s) noexcept {
  return {from.q + s * (to.q - from.q), {from.x[0] + s * (to.x[0] - from.x[0]), from.x[1] + s * (to.x[1] - from.x[1])}};
}

void add_scaled(Hessian& sum, const Hessian& h, double w) noexcept {
  sum.qq += w * h.qq;
  sum.qx[0] += w * h.qx[0];
  sum.qx[1] += w * h.qx[1];
  sum.xx[0] += w * h.xx[0];
  sum.x0x1 += w * h.x0x1;
  sum.xx[1] += w * h.xx[1];
}

}  // namespace

Tangent Transmission::tangent_of(const Origin& here) const noexcept {
  const Response r = evaluate(here.at);
  return {r.curvature.qq, {std::abs(r.load[0]), std::abs(r.load[1])}};
}

// The quadrature misses what the law's sixth derivative along the segment has; the discrete gradient of O. Gonzalez (J. Nonlinear Sci. 6
// (1996) 449) puts that where the segment goes, so that the means do the work of the energies' difference:
//   ḡ ← ḡ + Δz (ΔH − ḡ·Δz)/|Δz|²
SegmentMean Transmission::mean_over(const Positions& from, const Positions& to) const noexcept {
  // Gauss–Legendre on [0, 1], exact for laws up to fifth order along the segment.
  constexpr double kOffset = 0.3872983346207417;  // √(3/5)/2
  constexpr std::array<double, 3> nodes{0.5 - kOffset, 0.5, 0.5 + kOffset};
  constexpr std::array<double, 3> weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  SegmentMean mean;
  for (int i = 0; i < 3; ++i) {
    const Response r = evaluate(between(from, to, nodes[i]));
    mean.torque += weights[i] * r.torque;
    mean.load[0] += weights[i] * r.load[0];
    mean.load[1] += weights[i] * r.load[1];
    add_scaled(mean.slope, r.curvature, weights[i] * nodes[i]);
  }
  constexpr double kShort = 1e-3;  // rad: below, what is missed is less than the energies' rounding over the way
  const double dq = to.q - from.q, d0 = to.x[0] - from.x[0], d1 = to.x[1] - from.x[1], way = dq * dq + d0 * d0 + d1 * d1;
  if (way < kShort * kShort) return mean;
  const double work = mean.torque * dq + mean.load[0] * d0 + mean.load[1] * d1;
  const double missing = (energy(from) - energy(to) - work) / way;
  mean.torque += missing * dq;
  mean.load[0] += missing * d0;
  mean.load[1] += missing * d1;
  return mean;
}

}  // namespace vsa::elastic
