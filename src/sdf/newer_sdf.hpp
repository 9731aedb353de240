// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What of an SDF libsdformat 12 would refuse, or tell of without its place. In any version
//   left out   what sensors and a <material>'s <script> and <pbr> hold, all else of a <material> but its diffuse colour, that the axis
//              of a joint that has none (fixed, ball) is without direction
//   refused    any other axis without direction
// and versions that it doesn't know, 1.10, 1.11 and 1.12, read as 1.9, whose strict check of elements then decides. Their new
// elements are
//   honoured   <mimic> of an axis, mesh@optimization (in any version); <initial_position>, which 1.8 dropped
//   left out   lights, <gui>, <scene>, cones that are only to be seen
//   refused    what physics depends on: inertial@auto, joints of a <world>, cones that collide, <fluid_added_mass> …
#pragma once

#include <tinyxml2.h>

#include <string>

#include "sdf/notes.hpp"
#include "vsa/errors.hpp"

namespace vsa::reader {

inline constexpr const char* kVersions = "1.6 … 1.12; older ones from 1.0 are converted";

/// Of a version after 1.9.
[[nodiscard]] bool is_newer(const tinyxml2::XMLElement& sdf);

/// True where the tree was changed; problems where the version can't be read or physics would be lost.
[[nodiscard]] bool mend_sdf(tinyxml2::XMLElement& sdf, const std::string& file, Notes& notes, Problems& problems);

/// libsdformat and urdfdom read the first element of a file: another one or text beside it is a problem, and true.
[[nodiscard]] bool has_more_than_root(const tinyxml2::XMLElement& root, const std::string& file, Problems& problems);

/// A file that xacro was to expand: a problem and true.
[[nodiscard]] bool is_unexpanded(const tinyxml2::XMLElement& root, const std::string& file, Problems& problems);

}  // namespace vsa::reader
