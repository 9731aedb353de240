// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "module.hpp"

#include <cmath>
#include <utility>

#include "vsa/units.hpp"

namespace vsa::generate {
namespace {

void write_material(Xml& xml, const Color& c) {
  xml.open("material");
  xml.leaf("ambient", numbers({c.r, c.g, c.b, 1}));
  xml.leaf("diffuse", numbers({c.r, c.g, c.b, 1}));
  xml.leaf("specular", numbers({0.2, 0.2, 0.2, 1}));
  xml.close();
}

std::array<double, 6> along(Axis axis, const Vec& at) {
  const double quarter = kPi / 2;
  return {at[0], at[1], at[2], axis == Axis::y ? quarter : 0, axis == Axis::x ? quarter : 0, 0};
}

}  // namespace

Inertial housing(const ModuleSpec& m) { return solid_box(m.mass_kg - m.flange_mass_kg, {m.edge_m, m.edge_m, m.edge_m}, {}); }

void write_inertial(Xml& xml, const Inertial& inertial) {
  const auto& c = inertial.center_m;
  const auto& i = inertial.inertia_kgm2;
  xml.open("inertial");
  xml.pose({c[0], c[1], c[2], 0, 0, 0});
  xml.leaf("mass", inertial.mass_kg);
  xml.open("inertia");
  xml.leaf("ixx", i[0]).leaf("ixy", i[3]).leaf("ixz", i[4]).leaf("iyy", i[1]).leaf("iyz", i[5]).leaf("izz", i[2]);
  xml.close().close();
}

void write_surface(Xml& xml, double friction) {
  xml.open("surface").open("friction").open("ode");
  xml.leaf("mu", friction).leaf("mu2", friction);
  xml.close().close().close();
}

void box_visual(Xml& xml, const std::string& name, std::array<double, 6> pose, const Vec& size_m, const Color& color) {
  xml.open("visual", {{"name", name}});
  xml.pose({pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]});
  xml.open("geometry").open("box").leaf("size", numbers({size_m[0], size_m[1], size_m[2]})).close().close();
  write_material(xml, color);
  xml.close();
}

void cylinder_visual(Xml& xml, const std::string& name, const Vec& at, Axis axis, double radius_m, double length_m,
                     const Color& color, double yaw_rad) {
  auto pose = along(axis, at);
  pose[5] = yaw_rad;
  xml.open("visual", {{"name", name}});
  xml.pose({pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]});
  xml.open("geometry").open("cylinder").leaf("radius", radius_m).leaf("length", length_m).close().close();
  write_material(xml, color);
  xml.close();
}

void sphere_visual(Xml& xml, const std::string& name, const Vec& at, double radius_m, const Color& color) {
  xml.open("visual", {{"name", name}});
  xml.pose({at[0], at[1], at[2], 0, 0, 0});
  xml.open("geometry").open("sphere").leaf("radius", radius_m).close().close();
  write_material(xml, color);
  xml.close();
}

void box_contact(Xml& xml, const std::string& name, std::array<double, 6> pose, const Vec& size_m, double friction) {
  xml.open("collision", {{"name", name}});
  xml.pose({pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]});
  xml.open("geometry").open("box").leaf("size", numbers({size_m[0], size_m[1], size_m[2]})).close().close();
  write_surface(xml, friction);
  xml.close();
}

void sphere_contact(Xml& xml, const std::string& name, const Vec& at, double radius_m, double friction) {
  xml.open("collision", {{"name", name}});
  xml.pose({at[0], at[1], at[2], 0, 0, 0});
  xml.open("geometry").open("sphere").leaf("radius", radius_m).close().close();
  write_surface(xml, friction);
  xml.close();
}

void housing_visuals(Xml& xml, const ModuleSpec& m, Axis shaft, const Color& color, const Seat& seat) {
  // An octagonal prism about the shaft as four boxes: two upright, two turned by 45 degrees.
  const double e = m.edge_m, c = m.chamfer_m;
  const double across = (e - c) * std::sqrt(2.0), strip = c * std::sqrt(2.0);
  const Vec& at = seat.at;
  const auto turned = [&](double angle) -> std::array<double, 6> {
    return {at[0],
            at[1],
            at[2],
            shaft == Axis::x ? angle : 0,
            shaft == Axis::y ? angle : 0,
            seat.yaw_rad + (shaft == Axis::z ? angle : 0)};
  };
  const auto size = [&](double u, double v) -> Vec {
    if (shaft == Axis::z) return {u, v, e};
    return shaft == Axis::y ? Vec{u, e, v} : Vec{e, u, v};
  };
  box_visual(xml, seat.prefix + "housing_a", turned(0), size(e, e - 2 * c), color);
  box_visual(xml, seat.prefix + "housing_b", turned(0), size(e - 2 * c, e), color);
  box_visual(xml, seat.prefix + "housing_c", turned(kPi / 4), size(across, strip), color);
  box_visual(xml, seat.prefix + "housing_d", turned(-kPi / 4), size(across, strip), color);
  cylinder_visual(xml, seat.prefix + "pulleys", at, shaft, 0.30 * e, e + 0.003, kPulley, seat.yaw_rad);
  cylinder_visual(xml, seat.prefix + "shaft_end", at, shaft, 0.10 * e, e + 0.005, kBody, seat.yaw_rad);
}

void contact_box(Xml& xml, const ModuleSpec& m) { box_contact(xml, "contact", {}, {m.edge_m, m.edge_m, m.edge_m}, m.friction); }

void contact_spheres(Xml& xml, const ModuleSpec& m) {
  const double r = m.contact_radius_m;
  const std::array<std::pair<double, double>, 4> places{{{r, r}, {r, -r}, {-r, r}, {-r, -r}}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    sphere_contact(xml, "contact_" + std::to_string(i), {0, places[i].first, places[i].second}, r, m.friction);
  }
}

}  // namespace vsa::generate
