// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "parts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vsa::generate {
namespace {

constexpr double kPlate = 0.005;  // thickness
constexpr double kTubeRadius = 0.013;

Vec across(Axis axis, double along_axis, double other, double z) {
  return axis == Axis::y ? Vec{other, along_axis, z} : Vec{along_axis, other, z};
}

std::array<double, 6> at(const Vec& v) { return {v[0], v[1], v[2], 0, 0, 0}; }

}  // namespace

void write_joint(Xml& xml, const std::string& name, const std::string& parent, const std::string& child, const Vec& place,
                 const Vec& axis) {
  xml.open("joint", {{"name", name}, {"type", "revolute"}});
  xml.pose({place[0], place[1], place[2], 0, 0, 0});
  xml.leaf("parent", parent).leaf("child", child);
  xml.open("axis");
  xml.leaf("xyz", numbers({axis[0], axis[1], axis[2]}));
  // No stop: the unit's motors are limited to ±30000 raw (±2.88 rad) and the springs yield beyond.
  xml.open("limit").leaf("lower", "-1e16").leaf("upper", "1e16").close();
  xml.open("dynamics").leaf("damping", "0").leaf("friction", "0").close();
  xml.close().close();
}

void write_mount(Xml& xml, const std::string& child) {
  xml.open("joint", {{"name", "mount"}, {"type", "fixed"}}).leaf("parent", "world").leaf("child", child).close();
}

void write_plugin(Xml& xml, const ActuatorSpec& a, const std::string& bus, double initial_preset,
                  const std::vector<PluginEntry>& list) {
  xml.open("plugin", {{"name", "vsa::Robot"}, {"filename", a.plugin_file}});
  for (std::size_t i = 0; i < list.size(); ++i) {
    xml.open("actuator", {{"name", list[i].name}});
    xml.leaf("joint", list[i].joint);
    xml.leaf("type", a.type);
    xml.leaf("bus", bus, {{"id", std::to_string(i + 1)}});
    xml.empty("initial", {{"equilibrium_rad", "0"}, {"preset_rad", number(initial_preset)}});
    xml.close();
  }
  xml.empty("bus", {{"name", bus}, {"baud", fmt::format("{:.0f}", a.baud_Hz)}, {"cycle_s", "auto"}});
  xml.leaf("state_rate_Hz", a.state_rate_Hz);
  xml.close();
}

void begin_link(Xml& xml, const std::string& name, const Vec& place, double yaw_rad) {
  xml.open("link", {{"name", name}});
  xml.pose({place[0], place[1], place[2], 0, 0, yaw_rad});
}

void bracket_visuals(Xml& xml, const ModuleSpec& m, Axis axis, double reach) {
  const double e = m.edge_m, way = reach < 0 ? -1 : 1, plate = e / 2 + 0.006;
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0 ? "_a" : "_b";
    cylinder_visual(xml, "hub" + which, across(axis, side * plate, 0, 0), axis, 0.019, kPlate, kFlange);
    box_visual(xml, "cheek" + which, at(across(axis, side * plate, 0, way * kTurningRoom / 2)),
               axis == Axis::y ? Vec{0.030, kPlate, kTurningRoom} : Vec{kPlate, 0.030, kTurningRoom}, kFlange);
  }
  const double width = 2 * plate + kPlate, depth = 0.034;
  box_visual(xml, "back", at({0, 0, way * kTurningRoom}), axis == Axis::y ? Vec{depth, width, kPlate} : Vec{width, depth, kPlate},
             kFlange);
  const double end = std::abs(reach) - e / 2;
  cylinder_visual(xml, "tube", {0, 0, way * (kTurningRoom + end) / 2}, Axis::z, kTubeRadius, end - kTurningRoom, kSteel);
  cylinder_visual(xml, "collar", {0, 0, way * (end - 0.003)}, Axis::z, 0.022, 0.006, kFlange);
}

Inertial bracket(const ModuleSpec& m, Axis axis, double reach, double mass_kg) {
  const Inertial flange = solid_cylinder(m.flange_mass_kg, m.flange_radius_m, m.flange_thickness_m, axis, {});
  const double end = (reach < 0 ? -1 : 1) * (std::abs(reach) - m.edge_m / 2);
  return combine({flange, solid_box(mass_kg, {0.03, 0.03, std::abs(end)}, {0, 0, end / 2})});
}

Inertial upright_module(const ModuleSpec& m, double reach) {
  constexpr double kTubeRadius_m = 0.02;
  const double top = m.edge_m / 2, bottom = reach - top;
  const Inertial flange =
      solid_cylinder(m.flange_mass_kg, m.flange_radius_m, m.flange_thickness_m, Axis::z, {0, 0, top + m.flange_thickness_m / 2});
  const Inertial tube = solid_cylinder(m.bracket_mass_kg, kTubeRadius_m, bottom - top, Axis::z, {0, 0, (top + bottom) / 2});
  Inertial box = housing(m);
  box.center_m[2] = reach;
  return combine({flange, tube, box});
}

}  // namespace vsa::generate
