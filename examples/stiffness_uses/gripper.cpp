// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "gripper.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/engine/world.hpp"
#include "vsa/units.hpp"

namespace vsa::stiffness_uses {
namespace {

using engine::World;

constexpr double kOpen_rad = -0.3, kSettle_s = 2.5, kRest_s = 1.5, kMean_s = 0.2;
constexpr double kTouch_N = 0.05;

/// What the last step's contacts do to the finger: the axis is the world's z through the gripper's place.
void add_contacts(const World& world, std::vector<engine::Contact>& contacts, const std::array<double, 3>& axis_at, GripPoint& p,
                  double share) {
  world.contacts(contacts);
  for (const engine::Contact& c : contacts) {
    const bool finger = world.links()[c.link].name == "qbmove_gripper::finger";
    if (!finger && world.links()[c.other].name != "qbmove_gripper::finger") continue;
    const double sign = finger ? 1 : -1;
    const double x = c.position[0] - axis_at[0], y = c.position[1] - axis_at[1];
    const double fx = sign * c.force_N[0], fy = sign * c.force_N[1];
    p.force_N += share * std::hypot(fx, fy);
    p.moment_Nm += share * (x * fy - y * fx);
  }
}

}  // namespace

double GripRun::slope_N_per_deg() const {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const GripPoint& p : points) {
    if (p.force_N < kTouch_N) continue;
    n += 1, sx += p.command_deg, sy += p.force_N, sxx += p.command_deg * p.command_deg, sxy += p.command_deg * p.force_N;
  }
  const double below = n * sxx - sx * sx;
  return below > 0 ? (n * sxy - sx * sy) / below : 0;
}

GripRun run_gripper(const std::string& object, double preset_rad, const std::vector<double>& commands_deg) {
  World world = World::load("gripper_" + object + ".sdf");
  GripRun run{object, preset_rad, 0, {}};
  world.command("gripper", kOpen_rad, preset_rad);
  world.run(kSettle_s);
  run.attained_rad = world.read("gripper").preset;
  std::vector<engine::Pose> poses(world.links().size());
  world.poses(poses);
  std::array<double, 3> axis_at{};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (world.links()[i].name == "qbmove_gripper::finger") axis_at = poses[i].position;
  }
  std::vector<engine::Contact> contacts;
  for (const double command_deg : commands_deg) {
    world.command("gripper", command_deg * kPi / 180, preset_rad);
    world.run(kRest_s);
    GripPoint p;
    p.command_deg = command_deg;
    const auto samples = std::llround(kMean_s / world.step_s());
    const double share = 1.0 / static_cast<double>(samples);
    for (std::int64_t i = 0; i < samples; ++i) {
      world.step();
      add_contacts(world, contacts, axis_at, p, share);
      p.torque_Nm += share * world.read("gripper").torque_Nm;
    }
    p.finger_deg = world.joint_angle("qbmove_gripper::gripper") * 180 / kPi;
    run.points.push_back(p);
  }
  return run;
}

}  // namespace vsa::stiffness_uses
