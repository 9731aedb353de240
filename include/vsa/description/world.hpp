// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world as a physics engine needs it, whatever file it came from and whatever engine will run it. All poses and axes are in the
// world's frame at the start, where every joint is at zero (Axis::start comes on top); lengths in m, masses in kg, inertias in
// kg·m², angles in rad.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vsa/description/math.hpp"
#include "vsa/scene/link.hpp"

namespace vsa::description {

/// Triangles in the frame of the collision or visual, already scaled.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Heights above the geometry's origin, row 0 at the smallest y, column 0 at the smallest x. The grid spans
/// [−extent/2, extent/2] about `centre`.
struct Heightmap {
  std::size_t rows = 0, columns = 0;
  std::vector<double> heights;  ///< ≥ 0, rows × columns
  double extent_x = 0, extent_y = 0;
  Vec3 centre;
  [[nodiscard]] double highest() const;
};

struct Geometry {
  enum class Kind { box, sphere, cylinder, capsule, ellipsoid, plane, mesh, heightmap } kind = Kind::box;
  Vec3 size;  ///< box: full lengths; sphere: r; cylinder, capsule: r, length of the straight part; ellipsoid: radii; plane: lengths
  Pose3 offset;  ///< of the geometry in its collision or visual (a plane's normal is +z of this frame)
  std::shared_ptr<const Mesh> mesh;
  bool hull = false;                               ///< the mesh stands for its convex hull
  std::vector<std::shared_ptr<const Mesh>> parts;  ///< convex; where the mesh itself isn't, and was decomposed
  std::shared_ptr<const Heightmap> heightmap;
};

inline constexpr std::uint32_t kAllCollisions = 0xFFFF;  ///< SDF's default

struct Surface {
  double mu = 1;                        ///< Coulomb friction; a pair has the smaller of its two
  std::optional<double> mu2;            ///< across `first`, where it isn't mu
  Vec3 first;                           ///< the direction of mu, in the collision's frame; zero: the engine's choice
  double torsional_m = 0;               ///< spin torque per normal force
  double restitution = 0;               ///< of the normal speed, 0 … 1
  std::optional<double> stiffness;      ///< of the contact, N/m; none: the engine's own
  std::optional<double> damping;        ///< of the contact, N·s/m; none: the engine's own
  std::uint32_t mask = kAllCollisions;  ///< two shapes collide where their masks share a bit
};

struct Collision {
  std::string name;  ///< "model::link/collision"
  Pose3 pose;        ///< in the link
  Geometry geometry;
  Surface surface;
};

struct Link {
  std::string name;   ///< scoped
  std::string model;  ///< top-level
  bool is_static = false;
  bool self_collide = false;
  bool weightless = false;  ///< gravity leaves it alone
  Pose3 pose;
  double mass = 1;
  Vec3 com;      ///< in the link
  Mat3 inertia;  ///< about the centre of mass, link's axes
  std::vector<Collision> collisions;
};

struct Axis {
  Vec3 xyz;
  std::optional<std::array<double, 2>> range;
  double damping = 0;    ///< N·m·s/rad or N·s/m
  double friction = 0;   ///< Coulomb, N·m or N
  double stiffness = 0;  ///< N·m/rad or N/m about `rest`
  double rest = 0;
  std::optional<double> stop_stiffness, stop_damping;  ///< of the limits, N·m/rad and N·m·s/rad; none: the engine's own
  std::optional<double> start;                         ///< rad or m: where the joint stands at t = 0; none: at 0
};

struct Joint {
  enum class Kind { fixed, hinge, slide, ball, universal } kind = Kind::fixed;
  std::string name;                   ///< scoped
  std::optional<std::size_t> parent;  ///< none: the world
  std::optional<std::size_t> child;
  Pose3 pose;
  std::vector<Axis> axes;  ///< hinge, slide: 1; universal: 2, the first fixed in the parent
  [[nodiscard]] bool one_axis() const { return kind == Kind::hinge || kind == Kind::slide; }
};

/// One joint that follows another: q_follower = multiplier·q_leader + offset. Both have one axis.
struct Coupling {
  std::size_t follower = 0, leader = 0;  ///< into joints
  double multiplier = 1, offset = 0;
};

/// A <plugin> of ours, as text.
struct Plugin {
  std::string model;  ///< scoped name of the model that owns it
  std::string top_model;
  std::string xml;
};

/// What an engine has made of a file in its own format. It steps that; links, joints and couplings tell of it.
class Native {
 public:
  Native() = default;
  virtual ~Native() = default;
  Native(const Native&) = delete;
  Native& operator=(const Native&) = delete;
};

struct World {
  std::string name;
  Vec3 gravity{0, 0, -9.8};
  double step_s = 1e-3;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Coupling> couplings;
  std::vector<Plugin> plugins;
  std::vector<scene::LinkInfo> infos;    ///< one a link, with its visuals
  std::shared_ptr<const Native> native;  ///< none: all that an engine needs stands here
};

}  // namespace vsa::description
