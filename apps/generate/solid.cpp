// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "solid.hpp"

namespace vsa::generate {

Inertial solid_box(double mass_kg, const Vec& size_m, const Vec& center_m) {
  const double xx = size_m[0] * size_m[0], yy = size_m[1] * size_m[1], zz = size_m[2] * size_m[2];
  const double f = mass_kg / 12;
  return {mass_kg, center_m, {f * (yy + zz), f * (xx + zz), f * (xx + yy), 0, 0, 0}};
}

Inertial solid_cylinder(double mass_kg, double radius_m, double length_m, Axis axis, const Vec& center_m) {
  const double across = mass_kg / 12 * (3 * radius_m * radius_m + length_m * length_m);
  Inertial result{mass_kg, center_m, {across, across, across, 0, 0, 0}};
  result.inertia_kgm2[static_cast<std::size_t>(axis)] = mass_kg * radius_m * radius_m / 2;
  return result;
}

Inertial combine(const std::vector<Inertial>& parts) {
  Inertial whole;
  for (const Inertial& part : parts) {
    whole.mass_kg += part.mass_kg;
    for (std::size_t i = 0; i < 3; ++i) whole.center_m[i] += part.mass_kg * part.center_m[i];
  }
  for (double& c : whole.center_m) c /= whole.mass_kg;
  for (const Inertial& part : parts) {
    const double x = part.center_m[0] - whole.center_m[0];
    const double y = part.center_m[1] - whole.center_m[1];
    const double z = part.center_m[2] - whole.center_m[2];
    const std::array<double, 6> steiner{y * y + z * z, x * x + z * z, x * x + y * y, -x * y, -x * z, -y * z};
    for (std::size_t i = 0; i < 6; ++i) whole.inertia_kgm2[i] += part.inertia_kgm2[i] + part.mass_kg * steiner[i];
  }
  return whole;
}

}  // namespace vsa::generate
