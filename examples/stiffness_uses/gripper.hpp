// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A gripper of one module closes on an object (worlds gripper_hard and gripper_soft): force against the closing command, at one
// stiffness preset. The soft object's face rests on a spring of 600 N/m ([bench_object] in models/robots.toml): an object on a
// compliant joint, not a soft body.
//
// At rest the contact's moment about the gripper's axis is the actuator's torque, but for the shaft's friction: what a test
// compares.
#pragma once

#include <string>
#include <vector>

namespace vsa::stiffness_uses {

struct GripPoint {
  double command_deg = 0;  ///< closing equilibrium; the pads touch the object at 0
  double force_N = 0;      ///< on the object, mean over the last 0.2 s
  double moment_Nm = 0;    ///< of the contact on the finger about the gripper's axis
  double torque_Nm = 0;    ///< of the actuator on the finger
  double finger_deg = 0;   ///< where the finger came to rest
};

struct GripRun {
  std::string object;
  double preset_rad = 0, attained_rad = 0;
  std::vector<GripPoint> points;
  /// Least-squares slope of force over command where the pads touch, N/deg.
  [[nodiscard]] double slope_N_per_deg() const;
};

[[nodiscard]] GripRun run_gripper(const std::string& object, double preset_rad, const std::vector<double>& commands_deg);

}  // namespace vsa::stiffness_uses
