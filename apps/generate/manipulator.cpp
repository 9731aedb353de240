// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Three modules in series on a bench: the first axis upright, the other two horizontal and parallel, so the tip moves in space. At
// 0 rad the arm stands straight up; positive angles of the second and third joint lean it forward (+x).
#include "generate.hpp"
#include "parts.hpp"

namespace vsa::generate {
namespace {

void write_base(Xml& xml, const Description& d) {
  const double z = d.manipulator.base_height_m, low = z - d.module.edge_m / 2;
  Inertial box = housing(d.module);
  box.center_m[2] = z;
  begin_link(xml, "base", {}, 0);
  write_inertial(xml, box);
  housing_visuals(xml, d.module, Axis::z, kBody, {{0, 0, z}, 0, ""});
  box_visual(xml, "plate", {0, 0, 0.006, 0, 0, 0}, {0.16, 0.16, 0.012}, kBody);
  cylinder_visual(xml, "post", {0, 0, (low + 0.012) / 2}, Axis::z, 0.026, low - 0.012, kSteel);
  xml.close();
}

/// Turns on the first module's flange and carries the second module.
void write_turret(Xml& xml, const Description& d) {
  const ModuleSpec& m = d.module;
  const double top = m.edge_m / 2, reach = d.manipulator.shoulder_m, bottom = reach - top;
  begin_link(xml, "turret", {0, 0, d.manipulator.base_height_m}, 0);
  write_inertial(xml, upright_module(m, reach));
  cylinder_visual(xml, "flange", {0, 0, top + 0.004}, Axis::z, m.flange_radius_m, 0.006, kFlange);
  cylinder_visual(xml, "tube", {0, 0, (top + bottom) / 2}, Axis::z, 0.018, bottom - top, kSteel);
  box_visual(xml, "mark", {0.024, 0, top + 0.006, 0, 0, 0}, {0.012, 0.006, 0.006}, kMark);
  housing_visuals(xml, m, Axis::y, kBodyAlternate, {{0, 0, reach}, 0, ""});
  xml.close();
}

void write_upper_arm(Xml& xml, const Description& d) {
  const ModuleSpec& m = d.module;
  const double reach = d.manipulator.upper_arm_m, e = m.edge_m;
  Inertial box = housing(m);
  box.center_m[2] = reach;
  begin_link(xml, "upper_arm", {0, 0, d.manipulator.base_height_m + d.manipulator.shoulder_m}, 0);
  write_inertial(xml, combine({bracket(m, Axis::y, reach, d.module.bracket_mass_kg), box}));
  box_contact(xml, "elbow", {0, 0, reach, 0, 0, 0}, {e, e, e}, m.friction);
  bracket_visuals(xml, m, Axis::y, reach);
  housing_visuals(xml, m, Axis::y, kBody, {{0, 0, reach}, 0, ""});
  xml.close();
}

void write_forearm(Xml& xml, const Description& d) {
  const ManipulatorSpec& s = d.manipulator;
  const double radius = 0.018;
  begin_link(xml, "forearm", {0, 0, s.base_height_m + s.shoulder_m + s.upper_arm_m}, 0);
  write_inertial(xml, combine({bracket(d.module, Axis::y, s.forearm_m, d.module.bracket_mass_kg),
                               solid_cylinder(s.tip_mass_kg, radius, 2 * radius, Axis::z, {0, 0, s.forearm_m})}));
  bracket_visuals(xml, d.module, Axis::y, s.forearm_m);
  sphere_visual(xml, "tip", {0, 0, s.forearm_m}, radius, kMark);
  cylinder_visual(xml, "neck", {0, 0, s.forearm_m - radius}, Axis::z, 0.010, 0.040, kSteel);
  sphere_contact(xml, "tip", {0, 0, s.forearm_m}, radius, d.module.friction);
  xml.close();
}

}  // namespace

void add_manipulator(Files& files, const Description& d) {
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "qbmove_manipulator_3r"}});
  write_mount(xml, "base");
  write_turret(xml, d);
  write_upper_arm(xml, d);
  write_forearm(xml, d);
  write_base(xml, d);
  write_joint(xml, "joint_1", "base", "turret", {}, kUp);
  write_joint(xml, "joint_2", "turret", "upper_arm", {}, {0, 1, 0});
  write_joint(xml, "joint_3", "upper_arm", "forearm", {}, {0, 1, 0});
  write_plugin(xml, d.actuator, d.manipulator.bus, d.manipulator.initial_preset_rad,
               {{"joint_1", "joint_1"}, {"joint_2", "joint_2"}, {"joint_3", "joint_3"}});
  xml.close().close();
  add_model(files, "qbmove_manipulator_3r", "Manipulator of three qbmove modules in series", xml.text());
}

}  // namespace vsa::generate
