// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// SDF that libsdformat 12 doesn't know: versions 1.10, 1.11 and 1.12, read as 1.9, whose strict check of elements then decides.
// Their new elements are
//   honoured   <mimic> of an axis, mesh@optimization (in any version); <initial_position>, which 1.8 dropped
//   left out   sensors, lights, <gui>, <scene>, all of a <material> but its diffuse colour, cones that are only to be seen
//   refused    what physics depends on: inertial@auto, joints of a <world>, cones that collide, <fluid_added_mass> …
#pragma once

#include <tinyxml2.h>

#include <string>

#include "sdf/notes.hpp"
#include "vsa/errors.hpp"

namespace vsa::reader {

inline constexpr const char* kVersions = "1.6 … 1.12; older ones from 1.0 are converted";

/// True where the tree was changed; problems where the version can't be read or physics would be lost.
[[nodiscard]] bool mend_sdf(tinyxml2::XMLElement& sdf, const std::string& file, Notes& notes, Problems& problems);

/// A file that xacro was to expand: a problem and true.
[[nodiscard]] bool is_unexpanded(const tinyxml2::XMLElement& root, const std::string& file, Problems& problems);

}  // namespace vsa::reader
