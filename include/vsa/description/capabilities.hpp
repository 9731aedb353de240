// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a physics engine can honour of a description, so that whoever makes one can refuse the rest by file, key and value. An engine
// may take it for granted that what it can't isn't there.
//
// Only what engines differ in. What no description can say (sensors, wind, a patch that grows with the depth …) is its reader's own
// limit.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "vsa/description/world.hpp"

namespace vsa::description {

/// What an engine can honour of a description, so that a reader refuses the rest. Default: nothing.
struct Capabilities {
  std::string engine;                  ///< its name, for messages
  std::vector<Geometry::Kind> shapes;  ///< that collide
  std::vector<Joint::Kind> joints;     ///< that it moves
  bool concave_meshes = false;         ///< collide as they are; else a mesh is taken for its convex hull
  bool moving_terrain = false;         ///< planes and heightmaps on links that move
  bool followers = false;              ///< World::couplings
  bool loops = false;                  ///< Joint::closes
  bool collision_masks = false;        ///< Surface::mask
  bool spin_friction = false;          ///< Surface::torsional_m
  bool directional_friction = false;   ///< Surface::mu2
  bool restitution = false;            ///< Surface::restitution
  bool contact_springs = false;        ///< Surface::stiffness, damping; without it the engine's own do for all
  bool stop_springs = false;           ///< Axis::stop_stiffness, stop_damping; likewise
  bool weightless_links = false;       ///< Link::weightless

  /// Shapes that collide.
  [[nodiscard]] bool takes(Geometry::Kind kind) const { return std::find(shapes.begin(), shapes.end(), kind) != shapes.end(); }
  /// Joints that it moves.
  [[nodiscard]] bool takes(Joint::Kind kind) const { return std::find(joints.begin(), joints.end(), kind) != joints.end(); }
};

}  // namespace vsa::description
