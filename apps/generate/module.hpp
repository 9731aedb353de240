// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One qbmove module as parts of a link: inertia, contact spheres, looks. The link's frame is at the housing's centre.
#pragma once

#include <string>

#include "description.hpp"
#include "solid.hpp"
#include "xml.hpp"

namespace vsa::generate {

struct Color {
  double r, g, b;
};
inline constexpr Color kBody{0.13, 0.14, 0.16};
inline constexpr Color kBodyAlternate{0.16, 0.24, 0.36};
inline constexpr Color kFlange{0.80, 0.81, 0.83};
inline constexpr Color kPulley{0.45, 0.47, 0.50};
inline constexpr Color kMark{0.93, 0.48, 0.10};
inline constexpr Color kSteel{0.55, 0.57, 0.60};
inline constexpr Color kShell{0.92, 0.92, 0.90};
inline constexpr Color kRubber{0.20, 0.20, 0.20};
inline constexpr Color kWood{0.72, 0.55, 0.36};
inline constexpr Color kSignal{0.10, 0.45, 0.70};

/// Housing without its flange, centred on the origin.
[[nodiscard]] Inertial housing(const ModuleSpec& m);
void write_inertial(Xml& xml, const Inertial& inertial);
void write_surface(Xml& xml, double friction);

/// Visual primitives; poses are x y z roll pitch yaw in the link.
void box_visual(Xml& xml, const std::string& name, std::array<double, 6> pose, const Vec& size_m, const Color& color);
void cylinder_visual(Xml& xml, const std::string& name, const Vec& at, Axis axis, double radius_m, double length_m,
                     const Color& color, double yaw_rad = 0);
void sphere_visual(Xml& xml, const std::string& name, const Vec& at, double radius_m, const Color& color);
void box_contact(Xml& xml, const std::string& name, std::array<double, 6> pose, const Vec& size_m, double friction);
void sphere_contact(Xml& xml, const std::string& name, const Vec& at, double radius_m, double friction);

/// Where a housing sits in its link; the prefix tells several of one link apart.
struct Seat {
  Vec at{};
  double yaw_rad = 0;
  std::string prefix;
};

/// The housing: a cube with its four edges along the shaft chamfered, pulleys showing on both sides.
void housing_visuals(Xml& xml, const ModuleSpec& m, Axis shaft, const Color& color, const Seat& seat = {});
/// A lone module rests on its faces.
void contact_box(Xml& xml, const ModuleSpec& m);
/// Four spheres at (0, ±r, ±r), x the direction of a chain, whose neighbours keep it from rolling.
void contact_spheres(Xml& xml, const ModuleSpec& m);

}  // namespace vsa::generate
