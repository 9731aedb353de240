// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// description::World → MuJoCo's XML, in memory. Names are generated (b3, j5, h0), or the description's own, for files that people
// read. Numbers are written so that they read back the same.
//
// Choices
//   contact        elliptic cones; solref 0.004 s (MuJoCo keeps it ≥ 2 dt), critically damped
//   friction       a pair has the smaller coefficient of its two shapes, as with Gazebo's ODE and DART. MuJoCo would take the
//                  larger one, but where priorities differ the higher one's: a lower coefficient gets a higher priority. Spin
//                  friction is that of the same shape.
//   collisions     links joined by a joint never collide; links of one model only where one of them has self_collide
//   joints         no armature; limits, dry friction and joints that follow others as constraints with solref 0.004 s. A limit
//                  gives way by a share 1 − d of torque times mobility, and an actuator would press a light finger far beyond it:
//                  d is 0.9999 everywhere, for where it grows with depth a stop under load is as stiff as that growth times torque
//                  times mobility, more than a step of 2 ms can take
//   loops          Joint::closes as connects (hinge: two, ball: one) or a weld, solref 0.002 s: MuJoCo's constraints know nothing of
//                  their own curvature, so that a loop gapes by its acceleration times the square of that time
#pragma once

#include <array>
#include <string>
#include <vector>

#include "physics/mujoco/model.hpp"
#include "physics/tree.hpp"
#include "vsa/physics/mjcf.hpp"

namespace vsa::physics {

inline constexpr double kSmallestMu = 1e-5;  ///< MuJoCo's own lower bound; below it a contact has no friction at all

struct Capacity {
  int contacts = 0, rows = 0;
};

struct Mjcf {
  std::string xml;
  std::vector<VirtualFile> parts;  ///< included by xml and each other: the XML reader takes only so many elements in each other
  std::vector<std::shared_ptr<const Heightmap>> heightmaps;  ///< h0, h1 …: their data are filled in after compiling
};

/// Room to begin with: it grows where it must, and a world that needs little is made and cloned in little time.
[[nodiscard]] Capacity capacity_for(const description::World& world);

[[nodiscard]] Mjcf write_mjcf(const description::World& world, const std::vector<TreeNode>& tree, double step_s, Capacity capacity);

/// The same with the description's names, for a file NAME.xml: parts and heightmaps are files beside it, NAME.part0.xml, NAME.h0.bin.
[[nodiscard]] Mjcf write_mjcf_file(const description::World& world, const std::vector<TreeNode>& tree, double step_s,
                                   Capacity capacity, const std::string& name);

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

/// A shape whose friction has a direction.
struct FrictionDirection {
  std::size_t link = 0, collision = 0;
  std::optional<std::size_t> of;  ///< link in whose axes `along` is; none: the world
  std::array<double, 3> along{};  ///< unit vector
  double mu = 0, mu2 = 0;         ///< along, across
};
[[nodiscard]] std::vector<FrictionDirection> directions_of(const description::World& world);

/// Heights are stored as fractions of this.
[[nodiscard]] double heightmap_scale(const Heightmap& map);

/// MuJoCo's names, the generated ones or, with `own`, the description's.
struct MjcfNames {
  const description::World& world;
  bool own = false;
  [[nodiscard]] std::string body(std::size_t link) const;
  [[nodiscard]] std::string joint(std::size_t joint, std::size_t axis = 0) const;
  [[nodiscard]] std::string free_joint(std::size_t link) const;
  [[nodiscard]] std::string geom(std::size_t link, std::size_t collision) const;
  [[nodiscard]] std::string part(std::size_t link, std::size_t collision) const;  ///< a body of a static link's shape
};

}  // namespace vsa::physics
