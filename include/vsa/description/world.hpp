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
  std::vector<Vec3> vertices;                           ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< three indices into `vertices` each
};

/// Heights above the geometry's origin, row 0 at the smallest y, column 0 at the smallest x. The grid spans
/// [−extent/2, extent/2] about `centre`.
struct Heightmap {
  std::size_t rows = 0,                  ///< of samples, along y
      columns = 0;                       ///< of samples, along x
  std::vector<double> heights;           ///< ≥ 0, rows × columns
  double extent_x = 0,                   ///< along x, m
      extent_y = 0;                      ///< along y, m
  Vec3 centre;                           ///< of the grid, in the geometry's frame
  [[nodiscard]] double highest() const;  ///< of the heights; 0 without any
};

/// A shape, to collide or to be looked at.
struct Geometry {
  /// As in SDF.
  enum class Kind { box, sphere, cylinder, capsule, ellipsoid, plane, mesh, heightmap } kind = Kind::box;  ///< which one
  Vec3 size;  ///< box: full lengths; sphere: r; cylinder, capsule: r, length of the straight part; ellipsoid: radii; plane: lengths
  Pose3 offset;                      ///< of the geometry in its collision or visual (a plane's normal is +z of this frame)
  std::shared_ptr<const Mesh> mesh;  ///< of a mesh
  bool hull = false;                 ///< the mesh stands for its convex hull
  std::vector<std::shared_ptr<const Mesh>> parts;  ///< convex; where the mesh itself isn't, and was decomposed
  std::shared_ptr<const Heightmap> heightmap;      ///< of a heightmap
};

inline constexpr std::uint32_t kAllCollisions = 0xFFFF;  ///< SDF's default

/// How a shape touches others: friction, restitution, the contact's spring.
struct Surface {
  double mu = 1;                        ///< Coulomb friction; a pair has the smaller of its two
  std::optional<double> mu2;            ///< across `first`, where it isn't mu
  Vec3 first;                           ///< where mu2 is given: the direction of mu, in the collision's frame or that of first_of
  std::optional<std::size_t> first_of;  ///< the link in whose frame that is
  double torsional_m = 0;               ///< spin torque per normal force
  double restitution = 0;               ///< of the normal speed, 0 … 1
  std::optional<double> stiffness;      ///< of the contact, N/m; none: the engine's own
  std::optional<double> damping;        ///< of the contact, N·s/m; none: the engine's own
  std::uint32_t mask = kAllCollisions;  ///< two shapes collide where their masks share a bit
};

/// What of a link collides.
struct Collision {
  std::string name;   ///< "model::link/collision"
  Pose3 pose;         ///< in the link
  Geometry geometry;  ///< in the collision's frame
  Surface surface;    ///< of this shape
};

/// A body: mass, inertia, place and what of it collides.
struct Link {
  std::string name;                   ///< scoped
  std::string model;                  ///< top-level
  bool is_static = false;             ///< never moves; its mass counts for nothing
  bool self_collide = false;          ///< collides with the other links of its model
  bool weightless = false;            ///< gravity leaves it alone
  Pose3 pose;                         ///< in the world, at the start
  double mass = 1;                    ///< kg
  Vec3 com;                           ///< in the link
  Mat3 inertia;                       ///< about the centre of mass, link's axes
  std::vector<Collision> collisions;  ///< its shapes
};

/// How a joint of one axis moves, or one of a universal joint's two.
struct Axis {
  Vec3 xyz;                                    ///< unit vector, world, at the start
  std::optional<std::array<double, 2>> range;  ///< lower and upper end, rad or m; none: without limits
  double damping = 0;                          ///< N·m·s/rad or N·s/m
  double friction = 0;                         ///< Coulomb, N·m or N
  double stiffness = 0;                        ///< N·m/rad or N/m about `rest`
  double rest = 0;                             ///< rad or m, where the spring gives nothing
  /// Of the limits, N·m/rad and N·m·s/rad (N/m, N·s/m); none: the engine's own.
  std::optional<double> stop_stiffness, stop_damping;  ///< of the limits, N·m/rad and N·m·s/rad; none: the engine's own
  std::optional<double> start;                         ///< rad or m: where the joint stands at t = 0; none: at 0
};

/// What ties two links together, or one to the world.
struct Joint {
  /// As in SDF; fixed: moves nothing.
  enum class Kind { fixed, hinge, slide, ball, universal } kind = Kind::fixed;  ///< how it moves
  std::string name;                                                             ///< scoped
  std::optional<std::size_t> parent;                                            ///< none: the world
  std::optional<std::size_t> child;                                             ///< the link that it moves; none: the world
  Pose3 pose;                                                                   ///< in the world, at the start: where the axes meet
  std::vector<Axis> axes;         ///< hinge, slide: 1; universal: 2, the first fixed in the parent
  std::vector<std::string> held,  ///< what else holds it with others or in its place, in words, but for couplings
      pulled;                     ///< what else of it acts on it, in words
  /// Closes a kinematic loop: the other joints form a tree, and this one, a hinge, ball or fixed one with nothing but its place and
  /// axis, is a constraint of the engine's that holds its ends together. It has no coordinate.
  bool closes = false;
  /// Hinge or slide that has a coordinate: what an actuator can drive.
  [[nodiscard]] bool one_axis() const { return !closes && (kind == Kind::hinge || kind == Kind::slide); }
};

/// One joint that follows another: q_follower = offset + multiplier·q + c2·q² + c3·q³ + c4·q⁴ with q of the leader; an SDF's and a
/// URDF's have no more than the first two terms. Both have one axis.
struct Coupling {
  std::size_t follower = 0,                                  ///< into World::joints
      leader = 0;                                            ///< into World::joints
  double multiplier = 1,                                     ///< rad or m of the follower per rad or m of the leader
      offset = 0;                                            ///< rad or m
  std::array<double, 3> higher{};                            ///< c2, c3, c4
  [[nodiscard]] double at(double leader_position) const;     ///< where the follower stands then, rad or m
  [[nodiscard]] double slope(double leader_position) const;  ///< how far it goes per rad or m of the leader there
};

/// A `<plugin>` of ours, as text.
struct Plugin {
  std::string model;      ///< scoped name of the model that owns it
  std::string top_model;  ///< of the model that has all of it, scoped
  std::string xml;        ///< of the whole element
};

/// What an engine has made of a file in its own format. It steps that; links, joints and couplings tell of it.
class Native {
 public:
  Native() = default;
  virtual ~Native() = default;
  Native(const Native&) = delete;
  Native& operator=(const Native&) = delete;
};

/// A world as a physics engine needs it, whatever file it came from and whatever engine will run it: m, kg, rad, all at the start.
struct World {
  std::string name;                      ///< the world's name
  Vec3 gravity{0, 0, -9.8};              ///< m/s²
  double step_s = 1e-3;                  ///< of the engine
  std::vector<Link> links;               ///< in the file's order
  std::vector<Joint> joints;             ///< in the file's order
  std::vector<Coupling> couplings;       ///< mimics
  std::vector<Plugin> plugins;           ///< of ours
  std::vector<scene::LinkInfo> infos;    ///< one a link, with its visuals
  std::shared_ptr<const Native> native;  ///< none: all that an engine needs stands here
};

}  // namespace vsa::description
