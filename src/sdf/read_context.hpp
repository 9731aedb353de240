// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the readers of an SDF's parts share: where results, problems and warnings go. Private to the files that know
// libsdformat.
#pragma once

#include <sdf/sdf_config.h>

#include <map>
#include <sdf/Element.hh>
#include <sdf/SemanticPose.hh>
#include <set>
#include <type_traits>
#include <utility>

#include "sdf/description.hpp"
#include "sdf/input_files.hpp"
#include "sdf/notes.hpp"
#include "vsa/sdf/finder.hpp"
#include "vsa/sdf/read.hpp"

namespace sdf {
inline namespace SDF_VERSION_NAMESPACE {
class Joint;
class Link;
class Model;
class Geometry;
class Visual;
class World;
}  // namespace SDF_VERSION_NAMESPACE
}  // namespace sdf

namespace vsa::reader {

/// What libsdformat gives and takes: ignition::math's or gz::math's, by its version.
using SdfPose3 = std::decay_t<decltype(std::declval<sdf::SemanticPose>().RawPose())>;
using SdfVec3 = std::decay_t<decltype(std::declval<SdfPose3>().Pos())>;

/// What a file says of a joint that follows another, before the joints are all known.
struct Mimic {
  std::string file, follower, leader;  ///< scoped
  double multiplier = 1, offset = 0;
};

/// Of a collision's friction: the link in whose frame its direction is, before the links are all known.
struct DirectionFrame {
  std::string collision, frame;
  sdf::ElementPtr element;
};

/// A joint without one axis that a <state> has turned, before it is known which joints close loops.
struct TurnedJoint {
  std::size_t joint = 0;
  std::string key;
  sdf::ElementPtr element;
};

struct ReadContext {
  description::World& out;
  Problems& problems;
  Notes& notes;
  const Finder& finder;
  InputFiles& files;
  SeenFiles& seen;
  std::string file;            ///< the world's, where an element doesn't know its own
  std::filesystem::path base;  ///< directory for relative paths of elements that don't know their file
  const Capabilities& engine;
  Concave concave = Concave::refuse;
  ImpossibleInertia impossible_inertia = ImpossibleInertia::refuse;
  bool parsed_clean = true;  ///< false: poses may not resolve for reasons already reported
  std::vector<Mimic> mimics{};
  std::vector<DirectionFrame> direction_frames{};
  std::vector<TurnedJoint> turned{};
  std::set<std::string> driven{};              ///< joints that plugins of ours name, scoped
  std::map<std::string, Pose3> model_poses{};  ///< scoped name → its frame in the world

  void problem(const sdf::ElementPtr& element, std::string key, std::string value, std::string message, std::string allowed = {});
  [[nodiscard]] std::string file_of(const sdf::ElementPtr& element) const;
  /// A problem of what this engine can't honour.
  void cannot(const sdf::ElementPtr& element, std::string key, std::string value, const std::string& what, std::string allowed);
  /// The pose in the frame `to` (empty: the default one); identity and a problem where it can't be resolved.
  Pose3 resolve(const sdf::SemanticPose& pose, const std::string& to, const sdf::ElementPtr& element, const std::string& key);
  /// The number in `name` under `element`, or `fallback`; a problem where it isn't finite or outside [min, max].
  double number(const sdf::ElementPtr& element, const std::string& name, double fallback, double min, double max,
                const std::string& key);
};

/// The child, or null: unlike GetElement() never adds one.
[[nodiscard]] sdf::ElementPtr child(const sdf::ElementPtr& element, const std::string& name);

/// Model being read: its place in the world and what its links inherit.
struct ModelScope {
  std::string name;  ///< scoped
  std::string top;
  Pose3 pose;  ///< of the model's frame in the world
  bool is_static = false;
  bool self_collide = false;
};

void read_model(ReadContext& context, const sdf::Model& model, const ModelScope* outer);
void read_link(ReadContext& context, const sdf::Link& link, const ModelScope& scope);
void read_joint(ReadContext& context, const sdf::Joint& joint, const ModelScope& scope);
/// Compares a model that came from a URDF with it; afterwards, that each URDF was.
void check_urdf(ReadContext& context, const sdf::Model& model, const ModelScope& scope);
void check_urdfs_found(ReadContext& context);
/// What the files say twice, or not in numbers; `described`: the element <sdf>, with libsdformat's descriptions of all others.
void check_sdfs(ReadContext& context, const sdf::ElementPtr& described);
/// A world's <state>, once its models are read.
void read_state(ReadContext& context, const sdf::World& world);
/// Once all joints are known: welds those without room, finds where each starts, couples followers to leaders.
void finish_joints(ReadContext& context);
/// Then: takes a joint out of each kinematic loop, which closes it. Of the others those without one axis start unturned.
void close_loops(ReadContext& context);
/// Whether its two ends hang together without it, too.
[[nodiscard]] bool in_loop(const description::World& world, std::size_t joint);
[[nodiscard]] std::optional<Geometry> read_geometry(ReadContext& context, const sdf::Geometry& geometry, const std::string& key,
                                                    bool collides);
[[nodiscard]] Surface read_surface(ReadContext& context, const sdf::ElementPtr& collision, const std::string& key);
/// Once all links are known.
void find_direction_frames(ReadContext& context);
[[nodiscard]] std::vector<scene::Shape> read_visuals(ReadContext& context, const sdf::Link& link, const Link& described);

}  // namespace vsa::reader
