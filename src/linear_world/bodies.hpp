// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The bodies' part: which joints belong to it, mass matrix, gravity's torques and stiffness.
#pragma once

#include "vsa/linear_world/linear_world.hpp"

namespace vsa::linear_world {

struct WorldBodies {
  linear::Bodies bodies;
  std::vector<std::size_t> joint;  ///< of each: an index into World::joints()
  std::vector<double> gravity;     ///< what its weight asks for
  std::vector<std::string> notices;
};

/// At the angles that `world` has now; its speeds are 0. Leaves it elsewhere.
[[nodiscard]] WorldBodies find_bodies(engine::World& world);

/// What the joint's actuator is called among all of the world: its name, or model/name where several have it.
[[nodiscard]] std::string actuator_name(const engine::World& world, std::size_t actuator);

}  // namespace vsa::linear_world
