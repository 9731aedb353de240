// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "record/fake_snake.hpp"

#include <cmath>
#include <cstdint>

namespace vsa::record::fake {
namespace {

constexpr int kModules = 12;
constexpr double kPitch = 0.08;
constexpr double kGait = 4.71;  // rad/s

using scene::LinkInfo;
using scene::Pose;
using scene::Shape;
using Kind = scene::Shape::Kind;

Shape shape(Kind kind, std::array<double, 3> size, std::array<float, 4> rgba, Pose pose = {}) {
  Shape s;
  s.kind = kind;
  s.size = size;
  s.rgba = rgba;
  s.pose = pose;
  return s;
}

LinkInfo module(int i) {
  LinkInfo l{
      "snake::module_" + std::to_string(i + 1) + "::body", "snake", 0.45, false, {},
  };
  l.visuals.push_back(shape(Kind::box, {0.066, 0.066, 0.066}, {0.85f, 0.86f, 0.88f, 1}));
  const double s = std::sqrt(0.5);
  const Pose up{{0.0, 0.0, 0.034}, {1, 0, 0, 0}};
  const Pose side{{0.0, 0.034, 0.0}, {s, -s, 0, 0}};
  l.visuals.push_back(shape(Kind::cylinder, {0.022, 0.006, 0}, {0.16f, 0.18f, 0.22f, 1}, i % 2 == 0 ? up : side));
  l.visuals.push_back(shape(Kind::box, {0.014, 0.04, 0.04}, {0.16f, 0.18f, 0.22f, 1}, Pose{{0.04, 0, 0}, {1, 0, 0, 0}}));
  return l;
}

/// A rolling patch of ground as triangles.
LinkInfo hill() {
  LinkInfo l{"hill::ground", "hill", 0, true, {}};
  Shape s = shape(Kind::heightmap, {2, 2, 0.1}, {0.55f, 0.6f, 0.5f, 1});
  constexpr std::uint32_t n = 33;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const float x = static_cast<float>(i) / (n - 1) * 2 - 1;
      const float y = static_cast<float>(k) / (n - 1) * 2 - 1;
      s.vertices.insert(s.vertices.end(), {x, y, 0.12f * (1 - x * x) * (1 - y * y) - 0.002f});
      if (i + 1 < n && k + 1 < n) {
        const std::uint32_t a = i * n + k;
        s.indices.insert(s.indices.end(), {a, a + n, a + 1, a + 1, a + n, a + n + 1});
      }
    }
  }
  l.visuals.push_back(s);
  return l;
}

double swing(int i, double t) { return (i % 2 == 1 ? 1.05 : 0.35) * std::sin(kGait * t + i * 0.6283); }

}  // namespace

RunInfo snake() {
  RunInfo info{"fake_snake", 1e-3, {{"snake", {}}}, {}};
  LinkInfo ground{"ground_plane::link", "ground_plane", 0, true, {shape(Kind::plane, {20, 20, 0}, {0.8f, 0.8f, 0.8f, 1})}};
  info.links.push_back(ground);
  info.links.push_back(hill());
  for (int i = 0; i < 9; ++i) {
    LinkInfo box{"rubble::box_" + std::to_string(i), "rubble", 0, true, {}};
    const double h = 0.02 + 0.004 * i;
    box.visuals.push_back(shape(Kind::box, {0.12, 0.1 + 0.01 * i, h}, {0.62f, 0.58f, 0.52f, 1}));
    info.links.push_back(box);
  }
  for (int i = 0; i < kModules; ++i) info.links.push_back(module(i));
  for (int i = 0; i < kModules; ++i) {
    const std::string joint = "module_" + std::to_string(i + 1) + "::shaft";
    ActuatorInfo a{"joint_" + std::to_string(i + 1), joint, "qbmove_maker_pro_6_1", "rad", 2, {}};
    a.links = links_of_joint("snake", joint, static_cast<std::size_t>(i), info.links);
    info.robots[0].actuators.push_back(a);
  }
  return info;
}

Sample snake_at(std::int64_t time_ns) {
  const double t = static_cast<double>(time_ns) / 1e9;
  Sample s;
  s.time_ns = time_ns;
  s.poses.push_back({});
  s.poses.push_back({{0.8, 1.6, 0}, {1, 0, 0, 0}});
  for (int i = 0; i < 9; ++i) {
    const double a = 0.7 * i;
    s.poses.push_back({{0.3 + 0.25 * i, -0.55 - 0.12 * std::sin(2.1 * i), 0.01}, {std::cos(a / 2), 0, 0, std::sin(a / 2)}});
  }
  double x = 0.2 * t + 0.45;
  double y = 0.06 * std::sin(0.5 * t);
  double yaw = 0.25 * std::sin(kGait * t);
  for (int i = 0; i < kModules; ++i) {
    yaw += i % 2 == 1 ? 0.6 * swing(i, t) : 0.0;
    const double z = 0.034 + 0.012 * (1 + std::sin(kGait * t + 0.9 * i));
    s.poses.push_back({{x, y, z}, {std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)}});
    x -= kPitch * std::cos(yaw);
    y -= kPitch * std::sin(yaw);
  }
  for (int i = 0; i < kModules; ++i) {
    host::ActuatorReading r;
    r.equilibrium_command_rad = swing(i, t);
    r.equilibrium_rad = 0.93 * swing(i, t - 0.05);
    r.shaft_rad = 0.86 * swing(i, t - 0.08);
    r.shaft_speed_rad_per_s = kGait * 0.86 * swing(i, t - 0.08 + 0.333);
    r.deflection_rad = r.shaft_rad - r.equilibrium_rad;
    r.preset_command = 0.611;
    r.preset = 0.611 * (1 - std::exp(-3 * t)) - 0.05 + 0.01 * std::sin(3 * t + i);
    r.stiffness_Nm_per_rad = 0.3 * std::cosh(6.85 * r.preset) * std::cosh(6.85 * r.deflection_rad);
    r.torque_Nm = -0.044 * std::cosh(6.85 * r.preset) * std::sinh(6.85 * r.deflection_rad);
    r.motor_rad = {r.equilibrium_rad + r.preset, r.equilibrium_rad - r.preset};
    r.current_A = {0.5 * std::sin(kGait * t + i), 0.4 * std::cos(kGait * t + i)};
    s.actuators.push_back(r);
  }
  s.ledger.supply = 9.1 * t;
  s.ledger.copper = 5.2 * t;
  s.ledger.viscous = 0.4 * t;
  s.ledger.motor_friction = 2.9 * t;
  s.ledger.shaft_friction = 0.2 * t;
  s.ledger.delivered = 0.35 * t;
  s.ledger.elastic = 0.6 + 0.2 * std::sin(2 * kGait * t);
  s.bodies = scene::Energy{0.12 + 0.05 * std::sin(2 * kGait * t), 2.3 + 0.1 * std::sin(kGait * t), 0};
  return s;
}

RunInfo tiny() {
  RunInfo info{"bench", 1e-3, {{"arm", {{"elbow", "elbow", "qbmove_maker_pro_6_1", "rad", 2, {1}}}}}, {}};
  info.links.push_back({"wall::link", "wall", 0, true, {shape(Kind::box, {1, 1, 1}, {0.5f, 0.5f, 0.5f, 1})}});
  info.links.push_back({"arm::lever", "arm", 0.2, false, {shape(Kind::sphere, {0.1, 0, 0}, {1, 0, 0, 1})}});
  return info;
}

Sample tiny_at(std::int64_t time_ns) {
  Sample s;
  s.time_ns = time_ns;
  host::ActuatorReading r;
  r.shaft_rad = 0.1;
  r.shaft_speed_rad_per_s = -2;
  r.equilibrium_command_rad = 0.25;
  r.equilibrium_rad = 0.2;
  r.preset_command = 0.611;
  r.preset = 0.6;
  r.deflection_rad = -0.1;
  r.stiffness_Nm_per_rad = 1.0 / 3;
  r.torque_Nm = 1e-7;
  r.motor_rad = {0.8, -0.4};
  r.current_A = {1.5, -1e22};
  s.actuators.push_back(r);
  s.poses = {{{5, 5, 5}, {1, 0, 0, 0}}, {{0.5, 0, -1}, {1, 0, 0, 0}}};
  s.ledger.supply = 2;
  s.ledger.copper = 1.5;
  s.bodies = scene::Energy{0.25, -9.81, 0.5};
  return s;
}

}  // namespace vsa::record::fake
