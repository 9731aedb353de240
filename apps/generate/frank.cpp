// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Frank: an upper body of eight modules. Model frame: x forward, y left, z up, the ground at z = 0. At 0 rad the arms hang straight
// down and the head looks ahead. Positive: shoulder and elbow raise the hand forward, a gripper closes, the head turns left and
// nods.
#include <cmath>

#include "generate.hpp"
#include "gripper.hpp"
#include "vsa/units.hpp"

namespace vsa::generate {
namespace {

constexpr Vec kForward{0, -1, 0};      // an arm's axes: right-handed about it raises the hand forward
constexpr double kColumnShare = 0.15;  // of the stand's mass

struct Arm {
  std::string name;
  double side = -1;  // −1 right, +1 left
  Vec shoulder{};
  double yaw = 0;
};

Arm arm(const FrankSpec& f, double side) {
  const double toe = f.toe_in_deg * kPi / 180;
  return {side < 0 ? "right" : "left", side, {0, side * f.shoulder_half_width_m, f.shoulder_height_m}, -side * toe};
}

void write_arm(Xml& xml, const Description& d, const Arm& a) {
  const FrankSpec& f = d.frank;
  const ModuleSpec& m = d.module;
  const double e = m.edge_m;
  Inertial elbow = housing(m);
  elbow.center_m[2] = -f.upper_arm_m;
  begin_link(xml, a.name + "_upper_arm", a.shoulder, a.yaw);
  write_inertial(xml, combine({bracket(m, Axis::y, -f.upper_arm_m, m.bracket_mass_kg), elbow}));
  box_contact(xml, "elbow", {0, 0, -f.upper_arm_m, 0, 0, 0}, {e, e, e}, m.friction);
  bracket_visuals(xml, m, Axis::y, -f.upper_arm_m);
  housing_visuals(xml, m, Axis::y, kBodyAlternate, {{0, 0, -f.upper_arm_m}, 0, ""});
  xml.close();

  const Vec at_elbow{a.shoulder[0], a.shoulder[1], a.shoulder[2] - f.upper_arm_m};
  begin_link(xml, a.name + "_forearm", at_elbow, a.yaw);
  write_inertial(xml, combine({bracket(m, Axis::y, -f.forearm_m, m.bracket_mass_kg), palm(d, a.side, -f.forearm_m)}));
  bracket_visuals(xml, m, Axis::y, -f.forearm_m);
  palm_shapes(xml, d, a.side, -f.forearm_m);
  xml.close();

  write_finger_link(xml, d, a.name + "_finger", a.side, {at_elbow[0], at_elbow[1], at_elbow[2] - f.forearm_m}, a.yaw);
}

void write_neck(Xml& xml, const Description& d) {
  const FrankSpec& f = d.frank;
  const ModuleSpec& m = d.module;
  begin_link(xml, "neck", {0, 0, f.head_pan_height_m}, 0);
  const double top = m.edge_m / 2, bottom = f.head_tilt_m - m.edge_m / 2;
  write_inertial(xml, upright_module(m, f.head_tilt_m));
  cylinder_visual(xml, "flange", {0, 0, top + 0.004}, Axis::z, m.flange_radius_m, 0.006, kFlange);
  cylinder_visual(xml, "tube", {0, 0, (top + bottom) / 2}, Axis::z, 0.018, bottom - top, kSteel);
  housing_visuals(xml, m, Axis::y, kBodyAlternate, {{0, 0, f.head_tilt_m}, 0, ""});
  xml.close();
}

void face_visuals(Xml& xml, const Vec& size, double z) {
  const double front = size[0] / 2;
  box_visual(xml, "shell", {0, 0, z, 0, 0, 0}, size, kShell);
  box_visual(xml, "crown", {0, 0, z + size[2] / 2 + 0.004, 0, 0, 0}, {size[0] * 0.8, size[1] * 0.8, 0.008}, kShell);
  box_visual(xml, "face", {front, 0, z + 0.004, 0, 0, 0}, {0.006, size[1] * 0.84, size[2] * 0.70}, kBody);
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0 ? "_right" : "_left";
    cylinder_visual(xml, "eye" + which, {front + 0.003, side * 0.024, z + 0.012}, Axis::x, 0.0135, 0.004, kShell);
    cylinder_visual(xml, "pupil" + which, {front + 0.005, side * 0.024, z + 0.012}, Axis::x, 0.0065, 0.004, kSignal);
    cylinder_visual(xml, "ear" + which, {0, side * (size[1] / 2 + 0.004), z}, Axis::y, 0.017, 0.010, kMark);
  }
  box_visual(xml, "mouth", {front + 0.003, 0, z - 0.017, 0, 0, 0}, {0.003, 0.034, 0.005}, kMark);
  cylinder_visual(xml, "antenna", {0, 0, z + size[2] / 2 + 0.022}, Axis::z, 0.0025, 0.034, kSteel);
  sphere_visual(xml, "antenna_tip", {0, 0, z + size[2] / 2 + 0.042}, 0.007, kMark);
}

void write_head(Xml& xml, const Description& d) {
  const FrankSpec& f = d.frank;
  const ModuleSpec& m = d.module;
  const double above = kTurningRoom + f.head_size_m[2] / 2;  // a housing's corner turns below the shell
  begin_link(xml, "head", {0, 0, f.head_pan_height_m + f.head_tilt_m}, 0);
  const Inertial flange = solid_cylinder(m.flange_mass_kg, m.flange_radius_m, m.flange_thickness_m, Axis::y, {});
  write_inertial(xml, combine({flange, solid_box(f.head_mass_kg, f.head_size_m, {0, 0, above})}));
  box_contact(xml, "shell", {0, 0, above, 0, 0, 0}, f.head_size_m, m.friction);
  bracket_visuals(xml, m, Axis::y, kTurningRoom + 0.003 + m.edge_m / 2);  // it ends within the shell
  face_visuals(xml, f.head_size_m, above);
  xml.close();
}

/// Of the body's frame above the ground: the middle of the torso, where one looks for Frank.
double body_height(const FrankSpec& f) { return f.shoulder_height_m + 0.04 - f.torso_size_m[2] / 2; }

void stand_shapes(Xml& xml, const Description& d) {
  const FrankSpec& f = d.frank;
  const Vec& plate = f.stand_size_m;
  const double floor = f.foot_radius_m - body_height(f), torso_low = -f.torso_size_m[2] / 2;
  box_visual(xml, "plate", {0, 0, floor + plate[2] / 2, 0, 0, 0}, plate, kBody);
  box_visual(xml, "plate_top", {0, 0, floor + plate[2] + 0.002, 0, 0, 0}, {plate[0] * 0.9, plate[1] * 0.9, 0.004}, kPulley);
  cylinder_visual(xml, "socket", {0, 0, floor + plate[2] + 0.015}, Axis::z, 0.038, 0.030, kBody);
  const double low = floor + plate[2];
  cylinder_visual(xml, "column", {0, 0, (low + torso_low) / 2}, Axis::z, 0.021, torso_low - low, kSteel);
  int foot = 0;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const std::string name = "foot_" + std::to_string(foot++);
      const Vec at{x * (plate[0] / 2 - 0.02), y * (plate[1] / 2 - 0.02), floor};
      sphere_visual(xml, name, at, f.foot_radius_m, kRubber);
      sphere_contact(xml, name, at, f.foot_radius_m, d.module.friction);
    }
  }
}

void torso_shapes(Xml& xml, const Description& d) {
  const FrankSpec& f = d.frank;
  const ModuleSpec& m = d.module;
  const Vec& size = f.torso_size_m;
  const double top = size[2] / 2, middle = 0, front = size[0] / 2;
  const double shoulders = f.shoulder_height_m - body_height(f), pan = f.head_pan_height_m - body_height(f);
  box_visual(xml, "torso", {0, 0, middle, 0, 0, 0}, size, kShell);
  box_visual(xml, "waist", {0, 0, middle - size[2] / 2 - 0.012, 0, 0, 0}, {size[0] * 0.8, size[1] * 0.62, 0.024}, kPulley);
  box_visual(xml, "chest", {front, 0, middle + 0.028, 0, 0, 0}, {0.006, size[1] * 0.72, size[2] * 0.46}, kBody);
  box_visual(xml, "belt", {front, 0, middle - size[2] * 0.36, 0, 0, 0}, {0.004, size[1], 0.008}, kMark);
  cylinder_visual(xml, "light", {front + 0.003, 0, middle + 0.028}, Axis::x, 0.014, 0.004, kSignal);
  box_visual(xml, "shoulders", {0, 0, shoulders, 0, 0, 0}, {0.044, 2 * f.shoulder_half_width_m, 0.036}, kSteel);
  cylinder_visual(xml, "collar", {0, 0, (top + pan - m.edge_m / 2) / 2}, Axis::z, 0.030, pan - m.edge_m / 2 - top, kPulley);
  box_contact(xml, "torso", {0, 0, middle, 0, 0, 0}, size, m.friction);
  for (const double side : {-1.0, 1.0}) {
    const Arm a = arm(f, side);
    housing_visuals(xml, m, Axis::y, kBody, {{a.shoulder[0], a.shoulder[1], shoulders}, a.yaw, a.name + "_"});
  }
  housing_visuals(xml, m, Axis::z, kBody, {{0, 0, pan}, 0, "pan_"});
}

void write_body(Xml& xml, const Description& d) {
  const FrankSpec& f = d.frank;
  const double origin = body_height(f), floor = f.foot_radius_m + f.stand_size_m[2] - origin, top = f.torso_size_m[2] / 2;
  std::vector<Inertial> parts{
      solid_box(f.stand_mass_kg * (1 - kColumnShare), f.stand_size_m, {0, 0, floor - f.stand_size_m[2] / 2}),
      solid_cylinder(f.stand_mass_kg * kColumnShare, 0.021, top - floor, Axis::z, {0, 0, (top + floor) / 2}),
      solid_box(f.torso_mass_kg, f.torso_size_m, {})};
  for (const Vec& at : {arm(f, -1).shoulder, arm(f, 1).shoulder, Vec{0, 0, f.head_pan_height_m}}) {
    Inertial box = housing(d.module);
    box.center_m = {at[0], at[1], at[2] - origin};
    parts.push_back(box);
  }
  begin_link(xml, "body", {0, 0, origin}, 0);
  write_inertial(xml, combine(parts));
  stand_shapes(xml, d);
  torso_shapes(xml, d);
  xml.close();
}

std::string frank_model(const Description& d) {
  Xml xml = begin_sdf();
  // The body is listed last, so that the n-th link is the one that the n-th actuator moves.
  xml.open("model", {{"name", "frank"}, {"canonical_link", "body"}});
  std::vector<PluginEntry> entries;
  const auto shaft = [&](const std::string& name, const std::string& parent, const std::string& child, const Vec& axis) {
    write_joint(xml, name, parent, child, {}, axis);
    entries.push_back({name, name});
  };
  for (const double side : {-1.0, 1.0}) write_arm(xml, d, arm(d.frank, side));
  write_neck(xml, d);
  write_head(xml, d);
  write_body(xml, d);
  for (const double side : {-1.0, 1.0}) {
    const std::string n = arm(d.frank, side).name;
    shaft(n + "_shoulder", "body", n + "_upper_arm", kForward);
    shaft(n + "_elbow", n + "_upper_arm", n + "_forearm", kForward);
    shaft(n + "_gripper", n + "_forearm", n + "_finger", closing_axis(side));
  }
  shaft("head_pan", "body", "neck", kUp);
  shaft("head_tilt", "neck", "head", {0, 1, 0});
  write_plugin(xml, d.actuator, d.frank.bus, d.frank.initial_preset_rad, entries);
  xml.close().close();
  return xml.text();
}

}  // namespace

void add_frank(Files& files, const Description& d) {
  add_model(files, "frank", "Frank: an upper body of eight qbmove modules", frank_model(d));
}

}  // namespace vsa::generate
