// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/series_spring.hpp"

#include <cmath>

#include "vsa/checks.hpp"

namespace vsa::elastic {

Response SeriesSpring::evaluate(const Positions& at) const noexcept {
  const double torque = stiffness_ * (at.q - at.x[0]);
  Response r{};
  r.energy = 0.5 * torque * (at.q - at.x[0]);
  r.torque = -torque;
  r.load[0] = torque;
  r.curvature.qq = stiffness_;
  r.curvature.qx[0] = -stiffness_;
  r.curvature.xx[0] = stiffness_;
  return r;
}

SegmentMean SeriesSpring::mean_over(const Positions& from, const Positions& to) const noexcept {
  const double torque = stiffness_ * (0.5 * (from.q + to.q) - 0.5 * (from.x[0] + to.x[0]));
  SegmentMean mean;
  mean.torque = -torque;
  mean.load[0] = torque;
  mean.slope.qq = 0.5 * stiffness_;
  mean.slope.qx[0] = -0.5 * stiffness_;
  mean.slope.xx[0] = 0.5 * stiffness_;
  return mean;
}

std::array<double, 2> SeriesSpring::signed_energies(const Positions& at) const noexcept {
  const double deflection = at.q - at.x[0];
  return {0.5 * stiffness_ * deflection * std::abs(deflection), 0.0};
}

bool SeriesSpring::equals(const Transmission& other) const noexcept {
  const auto* same = dynamic_cast<const SeriesSpring*>(&other);
  return same != nullptr && same->stiffness_ == stiffness_;
}

void SeriesSpring::validate(std::string_view where, Problems& problems) const {
  Checks(where, problems).positive("stiffness_Nm_per_rad", stiffness_);
}

std::array<double, 2> SeriesSpring::references(const EquilibriumPreset& command) const noexcept {
  return {command.equilibrium, 0.0};
}

EquilibriumPreset SeriesSpring::attained(const std::array<double, 2>& x) const noexcept { return {x[0], 0.0}; }

}  // namespace vsa::elastic
