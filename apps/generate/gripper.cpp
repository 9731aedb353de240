// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "gripper.hpp"

#include "generate.hpp"

namespace vsa::generate {
namespace {

constexpr double kPlate = 0.005;
constexpr double kBend = 0.060;    // where a finger turns inwards, from the axis
constexpr double kCheek = 0.0095;  // from the housing to the moving finger's cheek's outer face

double fixed_face(const GripperSpec& g) { return g.opening_m / 2 + g.approach_m; }
double moving_face(const GripperSpec& g) { return g.opening_m / 2 - g.approach_m; }

/// Rows of spheres whose tops are the pad's face: boxes that lie flat on each other now and then get a contact from nowhere in
/// MuJoCo 2.2.2 (seen: 795 N on a baton at rest).
void pad_contacts(Xml& xml, const GripperSpec& g, double side, double face, double z) {
  const auto& [thick, wide, tall] = g.pad_size_m;
  const double across = wide / 2 - thick / 2, along = tall / 2 - thick / 2;
  constexpr int kRows = 9;
  for (int i = 0; i < kRows; ++i) {
    for (const double x : {-across, across}) {
      const double at = z - g.pad_at_m - along + 2 * along * i / (kRows - 1);
      sphere_contact(xml, "pad_" + std::to_string(i) + (x < 0 ? "a" : "b"), {x, side * (face + thick / 2), at}, thick / 2,
                     g.friction);
    }
  }
}

/// Pad and what carries it, on one side; its face is at `face` from the middle.
void pad_shapes(Xml& xml, const GripperSpec& g, double side, double face, double z) {
  const auto& [thick, wide, tall] = g.pad_size_m;
  const double y = side * (face + thick / 2);
  box_visual(xml, "pad", {0, y, z - g.pad_at_m, 0, 0, 0}, {wide, thick, tall}, kRubber);
  box_visual(xml, "finger", {0, y + side * (thick / 2 + 0.002), z - g.pad_at_m, 0, 0, 0}, {wide, 0.004, tall}, kMark);
  pad_contacts(xml, g, side, face, z);
}

}  // namespace

double hand_front_m(const Description& d) { return d.module.edge_m / 2 + kCheek; }

Vec closing_axis(double side) { return {side, 0, 0}; }

void palm_shapes(Xml& xml, const Description& d, double side, double z) {
  const ModuleSpec& m = d.module;
  const double e = m.edge_m, outer = e / 2 + 0.004, inner = fixed_face(d.gripper) + d.gripper.pad_size_m[0];
  housing_visuals(xml, m, Axis::x, kBody, {{0, 0, z}, 0, ""});
  box_visual(xml, "finger_root", {0, side * outer, z - kBend / 2 + 0.008, 0, 0, 0}, {0.026, kPlate, kBend + 0.016}, kMark);
  box_visual(xml, "finger_bend", {0, side * (outer + inner) / 2, z - kBend, 0, 0, 0}, {0.026, outer - inner + kPlate, kPlate},
             kMark);
  box_contact(xml, "housing", {0, 0, z, 0, 0, 0}, {e, e, e}, m.friction);
  pad_shapes(xml, d.gripper, side, fixed_face(d.gripper), z);
}

Inertial palm(const Description& d, double side, double z) {
  Inertial box = housing(d.module);
  box.center_m[2] = z;
  const auto& [thick, wide, tall] = d.gripper.pad_size_m;
  const double y = side * (fixed_face(d.gripper) + thick);
  return combine({box, solid_box(d.gripper.finger_mass_kg, {wide, thick, tall}, {0, y, z - d.gripper.pad_at_m * 0.7})});
}

void write_finger_link(Xml& xml, const Description& d, const std::string& name, double side, const Vec& at, double yaw_rad) {
  const ModuleSpec& m = d.module;
  const double e = m.edge_m, cheek = e / 2 + kCheek - kPlate / 2, inner = moving_face(d.gripper) + d.gripper.pad_size_m[0];
  begin_link(xml, name, at, yaw_rad);
  const Inertial flange = solid_cylinder(m.flange_mass_kg, m.flange_radius_m, m.flange_thickness_m, Axis::x, {});
  write_inertial(xml, combine({flange, solid_box(d.gripper.finger_mass_kg, {e, d.gripper.pad_size_m[0], d.gripper.pad_size_m[2]},
                                                 {0, -side * inner, -d.gripper.pad_at_m * 0.7})}));
  for (const double end : {-1.0, 1.0}) {
    const std::string which = end < 0 ? "_a" : "_b";
    cylinder_visual(xml, "hub" + which, {end * cheek, 0, 0}, Axis::x, 0.019, kPlate, kFlange);
    box_visual(xml, "cheek" + which, {end * cheek, -side * inner / 2, -kBend / 2, 0, 0, 0}, {kPlate, inner + 0.008, kBend + kPlate},
               kFlange);
    box_contact(xml, "cheek" + which, {end * cheek, 0, -0.005, 0, 0, 0}, {kPlate, 0.038, 0.048}, m.friction);
  }
  box_visual(xml, "bar", {0, -side * (inner + 0.002), -kBend, 0, 0, 0}, {2 * cheek + kPlate, 0.012, kPlate}, kFlange);
  pad_shapes(xml, d.gripper, -side, moving_face(d.gripper), 0);
  xml.close();
}

}  // namespace vsa::generate
