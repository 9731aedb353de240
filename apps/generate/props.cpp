// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the robots meet: Frank's table and baton, the ball on a cord, the gripper bench and the objects it squeezes.
#include <cmath>

#include "generate.hpp"
#include "gripper.hpp"
#include "vsa/units.hpp"

namespace vsa::generate {
namespace {

constexpr double kFoot = 0.003;  // radius of the baton's feet

std::string table_model(const Description& d) {
  const double side = d.table.size_m, top = d.table.top_height_m, thick = 0.012;
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "frank_table"}}).leaf("static", "true");
  begin_link(xml, "link", {}, 0);
  box_contact(xml, "top", {0, 0, top - thick / 2, 0, 0, 0}, {side, side, thick}, d.gripper.friction);
  box_visual(xml, "top", {0, 0, top - thick / 2, 0, 0, 0}, {side, side, thick}, kWood);
  cylinder_visual(xml, "leg", {0, 0, (top - thick) / 2}, Axis::z, 0.012, top - thick, kSteel);
  cylinder_visual(xml, "foot", {0, 0, 0.005}, Axis::z, 0.045, 0.010, kSteel);
  xml.close().close().close();
  return xml.text();
}

/// A hexagonal prism is three boxes: each reaches from one face to the opposite one and is as wide as a side. It stands on a small
/// sphere at each corner, not on the boxes (see pad_contacts).
std::string baton_model(const Description& d) {
  const TableSpec& t = d.table;
  const double across = t.baton_across_m, side = across / std::sqrt(3.0), h = t.baton_height_m;
  const double polar = 5.0 / 12 * t.baton_mass_kg * side * side;
  const double other = polar / 2 + t.baton_mass_kg * h * h / 12;
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "baton"}});
  begin_link(xml, "link", {}, 0);
  write_inertial(xml, {t.baton_mass_kg, {}, {other, other, polar, 0, 0, 0}});
  for (int i = 0; i < 3; ++i) {
    const double turn = (i - 1) * kPi / 3;
    box_contact(xml, "hexagon_" + std::to_string(i), {0, 0, kFoot / 2, 0, 0, turn}, {side, across, h - kFoot}, d.gripper.friction);
    for (const double end : {-1.0, 1.0}) {
      const double corner = turn + end * kPi / 2 + kPi / 6, r = side - kFoot;
      sphere_contact(xml, "foot_" + std::to_string(i) + (end < 0 ? "a" : "b"),
                     {r * std::cos(corner), r * std::sin(corner), -h / 2 + kFoot}, kFoot, d.gripper.friction);
    }
    box_visual(xml, "hexagon_" + std::to_string(i), {0, 0, 0, 0, 0, turn}, {side, across, h}, kSignal);
    for (const double end : {-1.0, 1.0}) {
      const std::string name = "ring_" + std::to_string(i) + (end < 0 ? "_low" : "_high");
      box_visual(xml, name, {0, 0, end * (h / 2 - 0.010), 0, 0, turn}, {side + 0.0005, across + 0.001, 0.008}, kShell);
    }
  }
  xml.close().close().close();
  return xml.text();
}

/// Frame: the pivot, the ball's way along x; at 0 rad the ball is raised towards +x, at `raised` it hangs straight down.
std::string pendulum_model(const Description& d) {
  const PendulumSpec& p = d.pendulum;
  const double post = -0.22;  // the post stands beside the arm
  const double up = d.frank.shoulder_height_m - d.frank.upper_arm_m - d.frank.forearm_m + p.cord_m;
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "pendulum"}});
  write_mount(xml, "frame");
  xml.open("link", {{"name", "ball"}});
  xml.pose({0, 0, 0, 0, -p.raised_deg * kPi / 180, 0});
  const double inertia = 0.4 * p.ball_mass_kg * p.ball_radius_m * p.ball_radius_m;
  write_inertial(xml, {p.ball_mass_kg, {0, 0, -p.cord_m}, {inertia, inertia, inertia, 0, 0, 0}});
  sphere_contact(xml, "ball", {0, 0, -p.cord_m}, p.ball_radius_m, 0);
  sphere_visual(xml, "ball", {0, 0, -p.cord_m}, p.ball_radius_m, kMark);
  cylinder_visual(xml, "cord", {0, 0, -p.cord_m / 2}, Axis::z, 0.002, p.cord_m, kSteel);
  xml.close();
  begin_link(xml, "frame", {}, 0);
  write_inertial(xml, solid_box(1.0, {0.03, 0.03, up}, {0, post, -up / 2}));
  box_visual(xml, "post", {0, post, -up / 2, 0, 0, 0}, {0.024, 0.024, up}, kPulley);
  box_visual(xml, "beam", {0, post / 2, 0.012, 0, 0, 0}, {0.024, -post + 0.024, 0.024}, kPulley);
  box_visual(xml, "foot", {0, post, -up + 0.006, 0, 0, 0}, {0.16, 0.10, 0.012}, kPulley);
  xml.close();
  write_joint(xml, "cord", "frame", "ball", {}, {0, 1, 0});
  xml.close().close();
  return xml.text();
}

std::string gripper_model(const Description& d) {
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "qbmove_gripper"}});
  write_mount(xml, "palm");
  write_finger_link(xml, d, "finger", -1, {}, 0);
  begin_link(xml, "palm", {}, 0);
  write_inertial(xml, palm(d, -1, 0));
  palm_shapes(xml, d, -1, 0);
  xml.close();
  write_joint(xml, "gripper", "palm", "finger", {}, closing_axis(-1));
  write_plugin(xml, d.actuator, "bus", d.actuator.initial_preset_rad, {{"gripper", "gripper"}});
  xml.close().close();
  return xml.text();
}

/// Lies against the fixed finger; its other face touches the moving one at 0 rad, at +y.
std::string hard_model(const Description& d) {
  const double wide = 0.030, w = d.gripper.opening_m;
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "object_hard"}}).leaf("static", "true");
  begin_link(xml, "block", {}, 0);
  box_contact(xml, "block", {}, {wide, w, wide}, 0.0);
  box_visual(xml, "block", {}, {wide, w, wide}, kSteel);
  xml.close().close().close();
  return xml.text();
}

std::string soft_model(const Description& d) {
  const double wide = 0.030, w = d.gripper.opening_m, back = w - kFaceThickness - d.bench_object.travel_m;
  const BenchObjectSpec& o = d.bench_object;
  Xml xml = begin_sdf();
  xml.open("model", {{"name", "object_soft"}});
  write_mount(xml, "back");
  begin_link(xml, "back", {}, 0);
  write_inertial(xml, solid_box(0.1, {wide, back, wide}, {0, (back - w) / 2, 0}));
  box_visual(xml, "back", {0, (back - w) / 2, 0, 0, 0, 0}, {wide, back, wide}, kWood);
  xml.close();
  begin_link(xml, "face", {}, 0);
  const Vec middle{0, (w - kFaceThickness) / 2, 0};
  write_inertial(xml, solid_box(o.face_mass_kg, {wide, kFaceThickness, wide}, middle));
  box_contact(xml, "face", {0, middle[1], 0, 0, 0, 0}, {wide, kFaceThickness, wide}, 0.0);
  box_visual(xml, "face", {0, middle[1], 0, 0, 0, 0}, {wide, kFaceThickness, wide}, kMark);
  xml.close();
  xml.open("joint", {{"name", "spring"}, {"type", "prismatic"}});
  xml.leaf("parent", "back").leaf("child", "face");
  xml.open("axis").leaf("xyz", "0 1 0");
  xml.open("limit").leaf("lower", -o.travel_m).leaf("upper", 0.0).close();
  xml.open("dynamics").leaf("damping", o.damping_Ns_per_m).leaf("friction", 0.0);
  xml.leaf("spring_reference", 0.0).leaf("spring_stiffness", o.stiffness_N_per_m).close();
  xml.close().close();
  xml.close().close();
  return xml.text();
}

}  // namespace

void add_props(Files& files, const Description& d) {
  add_model(files, "frank_table", "A pedestal in front of Frank's right hand", table_model(d));
  add_model(files, "baton", "A hexagonal prism to pick up and hand over", baton_model(d));
  add_model(files, "pendulum", "A ball on a cord that falls against Frank's hand", pendulum_model(d));
  add_model(files, "qbmove_gripper", "A gripper of one module on a bench", gripper_model(d));
  add_model(files, "object_hard", "A block that doesn't give", hard_model(d));
  add_model(files, "object_soft", "A block whose face rests on a spring", soft_model(d));
}

}  // namespace vsa::generate
