// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What readers of all formats share, with libsdformat or without: where results, problems and warnings go, and what can only be said
// once all links and joints are known.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/description.hpp"
#include "sdf/notes.hpp"
#include "vsa/sdf/finder.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::reader {

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();
inline constexpr double kNoLimit = 1e15;  ///< SDF writes ±1e16 for "none"
inline constexpr double kOpenSide = 1e9;  ///< the other side of a one-sided limit

/// What a file says of a joint that follows another, before the joints are all known.
struct Mimic {
  std::string file, follower, leader;  ///< scoped
  double multiplier = 1, offset = 0;
};

/// Of a collision's friction: the link in whose frame its direction is, before the links are all known.
struct DirectionFrame {
  std::string collision, frame;
  std::string file, key;  ///< for problems
};

/// A joint without one axis that a <state> has turned, before it is known which joints close loops.
struct TurnedJoint {
  std::size_t joint = 0;
  std::string file, key;  ///< for problems
};

/// Model being read: its place in the world and what its links inherit.
struct ModelScope {
  std::string name;  ///< scoped
  std::string top;
  Pose3 pose;  ///< of the model's frame in the world
  bool is_static = false;
  bool self_collide = false;
};

struct Reading {
  description::World& out;
  Problems& problems;
  Notes& notes;
  const Finder& finder;
  SeenFiles& seen;
  std::string file;            ///< the world's, where an element doesn't know its own
  std::filesystem::path base;  ///< directory for relative paths of elements that don't know their file
  const Capabilities& engine;
  Concave concave = Concave::refuse;
  ImpossibleInertia impossible_inertia = ImpossibleInertia::refuse;
  std::vector<Mimic> mimics{};
  std::vector<DirectionFrame> direction_frames{};
  std::vector<TurnedJoint> turned{};
  std::set<std::string> driven{};  ///< joints that plugins of ours name, scoped

  /// A problem of what this engine can't honour.
  void engine_cannot(const std::string& in, std::string key, std::string value, const std::string& what, std::string allowed);
  /// The value, or `fallback` and a problem where it isn't finite or outside [min, max].
  double in_range(double value, double fallback, double min, double max, const std::string& in, const std::string& key);
};

/// Whether there is a file, or a text, to read at all; else a problem.
[[nodiscard]] bool is_there(const SdfSource& source, Problems& problems);

/// A <plugin>, whoever has read it.
struct PluginElement {
  std::string name, library, text;
  std::vector<std::string> joints;  ///< that its actuators drive
  std::string file;                 ///< for problems
};
/// A robot of ours, or a word on whose it is.
void take_plugin(Reading& reading, const PluginElement& plugin, const ModelScope& scope);

/// What a joint's type is called in files, of those that the engine takes.
[[nodiscard]] std::string movable(const Capabilities& engine);
/// Limits of an axis; `in`, `key`: of the axis. False where they are none.
bool take_range(Reading& reading, double lower, double upper, const std::string& in, const std::string& key, Axis& out);
/// A word on "effort" or "velocity", where it is one.
void tell_of_limit(Reading& reading, const char* name, double value, const std::string& key);

/// A link's mass and inertia: problems, words and, where it was asked for, the nearest inertia that a body can have. `shown`: the
/// inertia as the file has it.
void check_inertia(Reading& reading, const std::string& in, const std::string& key, const std::string& shown, Link& link);

/// The shape, or its convex parts, with all else of `shape`; a problem where it can't move.
void take_collision(Reading& reading, const std::string& in, Collision shape, const Geometry& geometry, Link& link);

/// Once all links are known.
void find_direction_frames(Reading& reading);
/// Once all joints are known: welds those without room, finds where each starts, couples followers to leaders.
void finish_joints(Reading& reading);
/// Then: takes a joint out of each kinematic loop, which closes it. Of the others those without one axis start unturned.
void close_loops(Reading& reading);
/// Whether its two ends hang together without it, too.
[[nodiscard]] bool in_loop(const description::World& world, std::size_t joint);

}  // namespace vsa::reader
