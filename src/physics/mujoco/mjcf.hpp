// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// description::World → MuJoCo's XML, in memory. Names are generated (b3, j5, h0): users' names may hold anything. Numbers are written
// so that they read back the same.
//
// Choices
//   contact        elliptic cones; solref 0.004 s (MuJoCo keeps it ≥ 2 dt), critically damped
//   friction       a pair has the smaller coefficient of its two shapes, as with Gazebo's ODE and DART. MuJoCo would take the
//                  larger one, but where priorities differ the higher one's: a lower coefficient gets a higher priority. Spin
//                  friction is that of the same shape.
//   collisions     links joined by a joint never collide; links of one model only where one of them has self_collide
//   joints         no armature; limits, dry friction and joints that follow others as constraints with solref 0.004 s. A limit
//                  gives way by a share 1 − d of torque times mobility, so that an actuator would press a light finger far
//                  beyond it: d grows to 0.9999 within 1 mrad
#pragma once

#include <array>
#include <string>
#include <vector>

#include "physics/mujoco/model.hpp"
#include "physics/tree.hpp"

namespace vsa::physics {

struct Capacity {
  int contacts = 0, rows = 0;
};

struct Mjcf {
  std::string xml;
  std::vector<VirtualFile> parts;  ///< included by xml and each other: the XML reader takes only so many elements in each other
  std::vector<std::shared_ptr<const Heightmap>> heightmaps;  ///< h0, h1 …: their data are filled in after compiling
};

[[nodiscard]] Mjcf write_mjcf(const description::World& world, const std::vector<TreeNode>& tree, double step_s, Capacity capacity);

/// How MuJoCo is told of the shapes' frictions, see above.
struct ContactKind {
  int condim = 3, priority = 0;
};
class ContactKinds {
 public:
  /// All surfaces of the world.
  explicit ContactKinds(std::vector<std::array<double, 2>> mu_and_torsional);
  [[nodiscard]] ContactKind of(double mu, double torsional_m) const;

 private:
  std::vector<std::array<double, 2>> classes_;  // ascending, each once
};

/// Heights are stored as fractions of this.
[[nodiscard]] double heightmap_scale(const Heightmap& map);

/// MuJoCo's names.
[[nodiscard]] std::string body_name(std::size_t link);
[[nodiscard]] std::string joint_name(std::size_t joint, std::size_t axis = 0);
[[nodiscard]] std::string free_joint_name(std::size_t link);
[[nodiscard]] std::string geom_name(std::size_t link, std::size_t collision);

}  // namespace vsa::physics
