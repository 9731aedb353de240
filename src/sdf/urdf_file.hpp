// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// URDF before and after libsdformat 12 turns it into SDF, which by itself, and without a word to the user,
//   leaves out a link of no mass (none given, or up to 1e-6 kg) and everything that hangs on it, by whatever joints;
//   drops <mimic>;
//   takes the gravity of all links that it lumps into one where one of them is without;
//   lets a second <gazebo> for the whole robot undo the <static> of the first.
// So the text is mended first, and the result compared with what the file says: a link may be missing only where a chain of fixed
// joints lumps it into one that is there.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <vector>

#include "sdf/notes.hpp"
#include "vsa/description/math.hpp"
#include "vsa/errors.hpp"

namespace vsa::reader {

/// What a link without mass gets where it can't be left out: 10 mg, and the inertia of 10 mg at 3 cm.
inline constexpr double kDummyMass_kg = 1e-5, kDummyInertia_kgm2 = 1e-8;

struct UrdfMimic {
  std::string leader;
  double multiplier = 1, offset = 0;
};

struct UrdfJoint {
  std::string name, type, parent, child;
  bool lumped = false;  ///< fixed, and its child becomes a part of its parent
  std::optional<UrdfMimic> mimic;
};

struct Urdf {
  std::string file;
  std::vector<std::string> links;
  std::vector<UrdfJoint> joints;
  std::size_t collisions = 0;
  bool found = false;  ///< a model read by libsdformat was compared with it

  [[nodiscard]] const UrdfJoint* joint_above(const std::string& link) const;
  /// The link that `link` is lumped into; itself where it stays.
  [[nodiscard]] std::string lumped_into(const std::string& link) const;
};

/// Reads and mends a <robot>. `id` marks it: the model will hold <vsa:urdf id="…"/>.
[[nodiscard]] Urdf mend_urdf(tinyxml2::XMLElement& robot, const std::string& file, std::size_t id, Notes& notes,
                             Problems& problems);

/// "1 2 3"; none: it isn't three finite numbers.
[[nodiscard]] std::optional<description::Vec3> three_numbers(const char* text);

/// libsdformat gives what a <gazebo> says of a link's surface to those of its collisions whose names it has made itself: to none that
/// the URDF names, and to another's where one link's name begins with that of the link it is lumped into. So those are renamed.
void rename_collisions(tinyxml2::XMLElement& robot, const Urdf& urdf);

/// <gazebo> elements: ROS 1 leftovers, and what only some engines understand.
void mend_gazebo_elements(tinyxml2::XMLElement& robot, const Urdf& urdf, Notes& notes, Problems& problems);

/// Links with gravity aren't lumped with links without: what joins them stays.
void keep_gravity_apart(tinyxml2::XMLElement& robot, Urdf& urdf, Notes& notes);

/// Gives links without mass a little where the tree needs them, or refuses them.
void mend_massless_links(tinyxml2::XMLElement& robot, const Urdf& urdf, Notes& notes, Problems& problems);

}  // namespace vsa::reader
