// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world of many actuators about a point at which it stands still, as a linear system: the units of linear/linear.hpp on the
// bodies of the world's joints (linear/robot.hpp).
//
// THE POINT: every joint where the world has it now, or where it is said to stand; each actuator with the preset that it has attained
// now, or is given, and the equilibrium that carries its joint's weight there (elastic::equilibrium_for), or is given. What then is
// missing is held by a torque from outside, which the result names. Speeds, commands and what firmware and frictions do now don't
// count: the world itself isn't changed.
//
// IN IT: all joints of one axis that move with a driven one through the mass matrix or gravity; those without an actuator are states
// like the others, with their springs and dampers. M is the engine's. K = ∂/∂q of its gravity torques g(q), by differences of fourth
// order over steps of 1 mrad (mm), then made symmetric: off by less than 1e-10 of the largest |g|, in N·m/rad.
//
// NOT IN IT, with a notice: joints and free bodies that nothing here moves; contacts, hands and a limit that a joint stands at; dry
// friction of the file's joints; an MJCF's tendons, fluid, and actuators of MuJoCo's own that pull at control 0. REFUSED: a robot on
// links that fly free, joints of several axes, joints that follow another (`<mimic>`) or that another <equality> of an MJCF holds, all
// where they move with a driven joint. What an MJCF's <flag> switches off counts for nothing.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vsa/engine/world.hpp"
#include "vsa/linear/robot.hpp"

namespace vsa::linear_world {

using Named = std::vector<std::pair<std::string, double>>;  ///< name and value, each name once

/// Where the world's joints stand, and what its actuators have.
struct WorldPoint {
  Named angles{};                  ///< joints that stand elsewhere, by their or their actuator's name; rad or m
  std::optional<double> preset{};  ///< of all actuators; none: as attained now
  Named presets{},                 ///< of single actuators, in their laws' units
      equilibria_rad{};            ///< of single actuators
};

/// A world of actuators about a point: the system, and what carries its weights there.
struct WorldModel {
  linear::RobotModel model;            ///< joints go by their actuators' names, those without by their own
  std::vector<double> gravity_torque;  ///< of each joint of the model: what its weight asks for, N·m or N
  std::vector<double> outside_torque;  ///< what has to be given from outside that it stays; 0 where an actuator carries it
};

/// Throws InputError: a world without actuators, names that aren't there, angles beyond a joint's limits, a weight that no equilibrium
/// carries, what is refused above, and what linear::linearize() refuses. SimulationError: the engine can't step from that pose.
[[nodiscard]] WorldModel linearize(const engine::World& world, const WorldPoint& point, linear::Firmware firmware,
                                   linear::DryFriction friction = linear::DryFriction::sliding);

}  // namespace vsa::linear_world
