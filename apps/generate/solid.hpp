// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Mass, centre and inertia of solids of uniform density and of bodies made of them.
//
//   box       I_xx = m/12 (b² + c²) …              cylinder about its axis ½ m r², across m/12 (3 r² + h²)
//   shift     I' = I + m (d·d 1 − d dᵀ)            Steiner; d from the new point to the centre of mass
#pragma once

#include <array>
#include <vector>

namespace vsa::generate {

using Vec = std::array<double, 3>;

struct Inertial {
  double mass_kg = 0;
  Vec center_m{};
  /// About the centre of mass, along the link's axes: xx, yy, zz, xy, xz, yz.
  std::array<double, 6> inertia_kgm2{};
};

enum class Axis { x, y, z };

[[nodiscard]] Inertial solid_box(double mass_kg, const Vec& size_m, const Vec& center_m);
[[nodiscard]] Inertial solid_cylinder(double mass_kg, double radius_m, double length_m, Axis axis, const Vec& center_m);
[[nodiscard]] Inertial combine(const std::vector<Inertial>& parts);

}  // namespace vsa::generate
