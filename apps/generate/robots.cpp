// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// qbmove, its benches and the snake. Joint angles grow right-handed about the joint's axis.
#include <fmt/format.h>

#include "generate.hpp"
#include "module.hpp"
#include "parts.hpp"

namespace vsa::generate {
namespace {

void write_housing_link(Xml& xml, const ModuleSpec& m) {
  xml.open("link", {{"name", "housing"}});
  write_inertial(xml, housing(m));
  contact_box(xml, m);
  housing_visuals(xml, m, Axis::z, kBody);
  xml.close();
}

/// The flange on the shaft; with a lever and a mass where a bench has one. Frame: the housing's centre, shaft about z.
void write_flange_link(Xml& xml, const ModuleSpec& m, const BenchSpec* load) {
  const double top = m.edge_m / 2 + m.flange_thickness_m / 2;
  std::vector<Inertial> parts{solid_cylinder(m.flange_mass_kg, m.flange_radius_m, m.flange_thickness_m, Axis::z, {0, 0, top})};
  if (load != nullptr) {
    parts.push_back(
        solid_cylinder(load->load_mass_kg, load->load_radius_m, load->load_length_m, Axis::z, {0, load->load_lever_m, top}));
  }
  xml.open("link", {{"name", "flange"}});
  write_inertial(xml, combine(parts));
  cylinder_visual(xml, "disc", {0, 0, top}, Axis::z, m.flange_radius_m, m.flange_thickness_m, kFlange);
  cylinder_visual(xml, "hub", {0, 0, top + 0.003}, Axis::z, m.flange_radius_m / 3, m.flange_thickness_m, kBody);
  const double mark = m.flange_radius_m * 0.72;
  box_visual(xml, "mark", {0, mark, top + 0.001, 0, 0, 0}, {0.004, m.flange_radius_m * 0.4, m.flange_thickness_m}, kMark);
  if (load != nullptr) {
    const double lever = load->load_lever_m;
    box_visual(xml, "lever", {0, lever / 2, top + 0.002, 0, 0, 0}, {0.016, lever, 0.006}, kSteel);
    cylinder_visual(xml, "load", {0, lever, top}, Axis::z, load->load_radius_m, load->load_length_m, kSteel);
  }
  xml.close();
}

/// A pole that stands on the lever's end, free to turn about the lever. Frame: its hinge.
void write_pole_link(Xml& xml, const ModuleSpec& m, const PoleSpec& p) {
  begin_link(xml, "pole", {0, p.bench.load_lever_m, m.edge_m / 2 + m.flange_thickness_m / 2}, 0);
  const Vec middle{0, 0, p.length_m / 2};
  write_inertial(xml, solid_cylinder(p.mass_kg, p.radius_m, p.length_m, Axis::z, middle));
  cylinder_visual(xml, "pole", middle, Axis::z, p.radius_m, p.length_m, kMark);
  xml.close();
}

std::string module_model(const Description& d, const std::string& name, bool fixed, const BenchSpec* load,
                         const PoleSpec* pole = nullptr) {
  Xml xml = begin_sdf();
  xml.open("model", {{"name", name}});
  if (fixed) xml.open("joint", {{"name", "mount"}, {"type", "fixed"}}).leaf("parent", "world").leaf("child", "housing").close();
  write_housing_link(xml, d.module);
  write_flange_link(xml, d.module, load);
  if (pole != nullptr) write_pole_link(xml, d.module, *pole);
  write_joint(xml, "shaft", "housing", "flange", {}, kUp);
  if (pole != nullptr) write_joint(xml, "hinge", "flange", "pole", {}, {0, 1, 0});
  write_plugin(xml, d.actuator, "bus", d.actuator.initial_preset_rad, {{"shaft", "shaft"}});
  xml.close().close();
  return xml.text();
}

Axis shaft_axis(int n) { return n % 2 == 0 ? Axis::y : Axis::z; }

/// Ears on the housing's front or back and the hinge between: looks only.
void hinge_visuals(Xml& xml, const ModuleSpec& m, double pitch, Axis axis) {
  const double e = m.edge_m, joint = -pitch / 2, start = -0.30 * e;
  const double ear = 0.46 * e, length = start - joint + 0.006;
  for (const double side : {-1.0, 1.0}) {
    const bool upright = axis == Axis::z;
    box_visual(xml, side < 0 ? "ear_a" : "ear_b", {start - length / 2, upright ? 0 : side * ear, upright ? side * ear : 0, 0, 0, 0},
               {length, upright ? 0.018 : 0.004, upright ? 0.004 : 0.018}, kPulley);
  }
}

void flange_visuals(Xml& xml, const ModuleSpec& m, double pitch, Axis axis) {
  const double e = m.edge_m, joint = pitch / 2, width = 0.84 * e;
  const bool upright = axis == Axis::z;
  const double neck = joint - e / 2 + 0.004;
  cylinder_visual(xml, "flange", {joint, 0, 0}, axis, 0.009, width, kFlange);
  box_visual(xml, "neck", {e / 2 - 0.004 + neck / 2, 0, 0, 0, 0, 0},
             {neck, upright ? 0.014 : width * 0.8, upright ? width * 0.8 : 0.014}, kFlange);
  box_visual(xml, "plate", {e / 2 + 0.0005, 0, 0, 0, 0, 0}, {0.003, 0.62 * e, 0.62 * e}, kFlange);
}

/// Body k of the chain: module k's housing with the flange of module k − 1; the last body is the tail.
void write_body(Xml& xml, const Description& d, int k) {
  const ModuleSpec& m = d.module;
  const double pitch = d.snake.pitch_m;
  const bool tail = k == d.snake.modules;
  Inertial body = tail ? solid_box(d.snake.tail_mass_kg, {m.edge_m, m.edge_m, m.edge_m}, {}) : housing(m);
  if (k > 0) {
    const Inertial flange =
        solid_cylinder(m.flange_mass_kg, m.flange_radius_m, m.flange_thickness_m, shaft_axis(k - 1), {pitch / 2, 0, 0});
    body = combine({body, flange});
  }
  xml.open("link", {{"name", tail ? "tail" : fmt::format("module_{}", k)}});
  xml.pose({(d.snake.modules / 2.0 - k) * pitch, 0, 0, 0, 0, 0});
  write_inertial(xml, body);
  contact_spheres(xml, m);
  housing_visuals(xml, m, shaft_axis(k), tail ? kPulley : (k % 2 == 0 ? kBody : kBodyAlternate));
  if (!tail) hinge_visuals(xml, m, pitch, shaft_axis(k));
  if (k > 0) flange_visuals(xml, m, pitch, shaft_axis(k - 1));
  if (k == 0) {
    for (const double side : {-1.0, 1.0}) {
      cylinder_visual(xml, side < 0 ? "eye_right" : "eye_left", {0.5 * m.edge_m, side * 0.24 * m.edge_m, 0.18 * m.edge_m}, Axis::x,
                      0.006, 0.004, kMark);
    }
  }
  xml.close();
}

std::string snake_model(const Description& d) {
  const int modules = d.snake.modules;
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "qbmove_snake"}});
  for (int k = 0; k <= modules; ++k) write_body(xml, d, k);
  std::vector<PluginEntry> entries;
  for (int n = 0; n < modules; ++n) {
    const std::string name = fmt::format("joint_{}", n), parent = fmt::format("module_{}", n);
    const std::string child = n + 1 == modules ? "tail" : fmt::format("module_{}", n + 1);
    write_joint(xml, name, parent, child, {d.snake.pitch_m / 2, 0, 0}, shaft_axis(n) == Axis::z ? kUp : Vec{0, 1, 0});
    entries.push_back({name, name});
  }
  write_plugin(xml, d.actuator, d.snake.bus, d.snake.initial_preset_rad, entries);
  xml.close().close();
  return xml.text();
}

}  // namespace

void add_robots(Files& files, const Description& d) {
  add_model(files, "qbmove", "qbmove maker pro: one module, free to move", module_model(d, "qbmove", false, nullptr));
  add_model(files, "qbmove_bench_free", "qbmove maker pro, held by its housing, flange free",
            module_model(d, "qbmove_bench_free", true, nullptr));
  add_model(files, "qbmove_bench_load", "qbmove maker pro, held by its housing, with a lever and a mass",
            module_model(d, "qbmove_bench_load", true, &d.bench));
  add_model(files, "qbmove_bench_throw", "qbmove maker pro, held by its housing, axis upright, with a ball on a lever",
            module_model(d, "qbmove_bench_throw", true, &d.throwing));
  add_model(files, "qbmove_bench_pole", "qbmove maker pro, held by its housing, axis upright, with a pole that stands on a lever",
            module_model(d, "qbmove_bench_pole", true, &d.pole.bench, &d.pole));
  add_model(files, "qbmove_snake", "Snake of qbmove modules in series", snake_model(d));
}

}  // namespace vsa::generate
