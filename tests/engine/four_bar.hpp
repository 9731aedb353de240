// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A four-bar linkage in the x–z plane, joints about +y, in closed form and as SDF. At angle 0 the crank points along +z.
//
//     A ──── coupler ──── B        crank O–A from the world at O, rocker P–B from the world at P
//     │ crank      rocker │
//     O ─ ─ ─ world ─ ─ ─ P
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "worlds.hpp"

namespace vsa::engine::testing {

using V = std::array<double, 3>;
inline V turned(const Pose& p, const V& v) {
  const auto& [w, x, y, z] = p.quaternion;
  const V t{2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])};
  return {v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]};
}
inline V point(const Pose& p, const V& v) {
  const V t = turned(p, v);
  return {p.position[0] + t[0], p.position[1] + t[1], p.position[2] + t[2]};
}
inline double distance(const V& a, const V& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

struct FourBar {
  double ground = 0.3, crank = 0.1, coupler = 0.28, rocker = 0.2;  ///< m
  double crank_kg = 0.2, coupler_kg = 0.3, rocker_kg = 0.25;       ///< centres of mass at the middles
  double g = 9.81;

  struct At {
    double x, z;
  };
  /// Of the bars, rad, counted about +y from +z; and the points A and B.
  struct Posture {
    double crank, coupler, rocker;
    At a, b;
  };
  [[nodiscard]] static double moment(double kg, double m) { return kg * m * m / 12; }

  /// B to the right of A → P: the branch of the assembly.
  [[nodiscard]] Posture at(double angle) const {
    const At a{crank * std::sin(angle), crank * std::cos(angle)};
    const double dx = ground - a.x, dz = -a.z, d = std::hypot(dx, dz),
                 along = (coupler * coupler - rocker * rocker + d * d) / (2 * d),
                 across = std::sqrt(coupler * coupler - along * along);
    const At b{a.x + (along * dx - across * dz) / d, a.z + (along * dz + across * dx) / d};
    return {angle, std::atan2(b.x - a.x, b.z - a.z), std::atan2(b.x - ground, b.z), a, b};
  }
  [[nodiscard]] Posture slope(double angle) const {
    const double h = 1e-6;
    const Posture p = at(angle + h), m = at(angle - h);
    const auto d = [&](double x, double y) { return std::remainder(x - y, 2 * M_PI) / (2 * h); };
    return {1,
            d(p.coupler, m.coupler),
            d(p.rocker, m.rocker),
            {(p.a.x - m.a.x) / (2 * h), (p.a.z - m.a.z) / (2 * h)},
            {(p.b.x - m.b.x) / (2 * h), (p.b.z - m.b.z) / (2 * h)}};
  }
  [[nodiscard]] double potential(double angle) const {
    const Posture p = at(angle);
    return g * (crank_kg * p.a.z / 2 + coupler_kg * (p.a.z + p.b.z) / 2 + rocker_kg * p.b.z / 2);
  }
  /// Of all of it at the crank.
  [[nodiscard]] double inertia(double angle) const {
    const Posture s = slope(angle);
    const double vx = (s.a.x + s.b.x) / 2, vz = (s.a.z + s.b.z) / 2;
    return moment(crank_kg, crank) + crank_kg * crank * crank / 4 + moment(coupler_kg, coupler) * s.coupler * s.coupler +
           coupler_kg * (vx * vx + vz * vz) + (moment(rocker_kg, rocker) + rocker_kg * rocker * rocker / 4) * s.rocker * s.rocker;
  }
  /// Where it hangs at rest.
  [[nodiscard]] double hanging(double near) const {
    for (int k = 0; k < 50; ++k) near -= torque(near) / stiffness(near);
    return near;
  }
  [[nodiscard]] double torque(double angle) const { return (potential(angle + 1e-4) - potential(angle - 1e-4)) / 2e-4; }
  [[nodiscard]] double stiffness(double angle) const {
    return (potential(angle + 1e-3) - 2 * potential(angle) + potential(angle - 1e-3)) / 1e-6;
  }
};

/// Its joints in order, what their axes hold, and in whose place another kind of joint stands.
struct FourBarFile {
  std::vector<std::string> order = {"o", "a", "b", "p"};
  std::map<std::string, std::string> of_axis = {};
  std::map<std::string, std::string> type = {};
  std::string gravity = "0 0 -9.81", more = {};
  std::string post = "world";  ///< what the rocker stands on
  double y = 0;                ///< all of it beside the world's plane
};

inline std::string bar(const std::string& name, const FourBar::At& from, const FourBar::At& to, double y, double kg) {
  const double dx = to.x - from.x, dz = to.z - from.z, l = std::hypot(dx, dz);

  char pose[200], moments[300];
  std::snprintf(pose, sizeof pose, "%.17g %.17g %.17g 0 0 0", from.x, y, from.z);
  // Slender, but with some thickness, or its own axis had no inertia.
  std::snprintf(moments, sizeof moments,
                "<inertial><pose>%.17g 0 %.17g 0 %.17g 0</pose><mass>%.17g</mass><inertia><ixx>%.17g</ixx>"
                "<iyy>%.17g</iyy><izz>%.17g</izz></inertia></inertial>",
                dx / 2, dz / 2, std::atan2(dx, dz), kg, FourBar::moment(kg, l), FourBar::moment(kg, l),
                FourBar::moment(kg, l) / 10);

  return "<link name='" + name + "'><pose>" + pose + "</pose>" + moments + "</link>";
}

inline std::string four_bar(const FourBar& f, const FourBarFile& file = {}) {
  const FourBar::Posture p = f.at(0);
  std::string out = "<model name='m'><pose>0 0 1 0 0 0</pose>" + bar("crank", {0, 0}, p.a, file.y, f.crank_kg) +
                    bar("coupler", p.a, p.b, file.y, f.coupler_kg) + bar("rocker", {f.ground, 0}, p.b, file.y, f.rocker_kg);
  const std::map<std::string, std::array<std::string, 2>> ends = {
      {"o", {"world", "crank"}}, {"a", {"crank", "coupler"}}, {"b", {"rocker", "coupler"}}, {"p", {file.post, "rocker"}}};
  for (const std::string& name : file.order) {
    const std::string type = file.type.contains(name) ? file.type.at(name) : "revolute";
    // b is where the rocker ends.
    char pose[100] = "";
    if (name == "b") std::snprintf(pose, sizeof pose, "<pose>%.17g 0 %.17g 0 0 0</pose>", p.b.x - p.a.x, p.b.z - p.a.z);
    out += "<joint name='" + name + "' type='" + type + "'>" + pose + "<parent>" + ends.at(name)[0] + "</parent><child>" +
           ends.at(name)[1] + "</child>" +
           (type == "ball" || type == "fixed"
                ? ""
                : "<axis><xyz>0 1 0</xyz>" + (file.of_axis.contains(name) ? file.of_axis.at(name) : std::string()) + "</axis>") +
           "</joint>";
  }
  std::string all = world(out + file.more + "</model>", file.gravity);
  all.replace(all.find("1.9"), 3, "1.11");
  return all;
}

}  // namespace vsa::engine::testing
