// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The bodies of a world and what they look like: what stays the same while it moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/scene/pose.hpp"

namespace vsa::scene {

/// Geometry for pictures; primitive kinds as in SDF.
struct Shape {
  /// As in SDF.
  enum class Kind { box, sphere, cylinder, capsule, plane, mesh, heightmap } kind = Kind::box;  ///< which one
  Pose pose;                                                                                    ///< in its link
  std::array<double, 3> size{};  ///< box x y z; sphere r; cylinder/capsule r, length; plane x y; mesh: scale; heightmap: extent
  std::array<float, 4> rgba{0.7f, 0.7f, 0.7f, 1};  ///< 0 … 1 each
  std::vector<float> vertices;                     ///< mesh and heightmap: triangles' corners, xyz each, link frame
  std::vector<std::uint32_t> indices;              ///< three a triangle, into `vertices`
};

/// A body of the world, as pages and recordings name it.
struct LinkInfo {
  std::string name;            ///< scoped: "model::link"
  std::string model;           ///< top-level model
  double mass_kg = 0;          ///< as its file has it
  bool is_static = false;      ///< it never moves
  std::vector<Shape> visuals;  ///< the SDF's visuals (collisions where a link has none)
};

/// The bodies that an actuator's joint belongs to, for highlighting: the links in the joint's own scope ("module_1::shaft" → all of
/// "MODEL::module_1::…"). A joint without a scope says nothing of its bodies; then the robot's n-th moving link stands for its n-th
/// actuator, as in a serial chain.
[[nodiscard]] std::vector<std::size_t> links_of_joint(std::string_view model, std::string_view joint, std::size_t actuator_index,
                                                      const std::vector<LinkInfo>& links);

}  // namespace vsa::scene
