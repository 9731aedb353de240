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
  sum.x0x0 += w * h.x0x0;
  sum.x0x1 += w * h.x0x1;
  sum.x1x1 += w * h.x1x1;
}

}  // namespace

Tangent Transmission::tangent_of(const Origin& here) const noexcept {
  const Response r = evaluate(here.at);
  return {r.curvature.qq, {std::abs(r.load[0]), std::abs(r.load[1])}};
}

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
  return mean;
}

}  // namespace vsa::elastic
