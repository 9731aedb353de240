// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tinyxml2.h>

#include <string>

#include "vsa/errors.hpp"

namespace vsa::reader {

/// Refuses our plug-in where nobody looks for it: elsewhere than in a <model> or <include> of an SDF, or a <gazebo> of a URDF that
/// speaks of the whole robot. In a <world> it is told by who reads that.
void check_plugin_places(const tinyxml2::XMLElement& root, const std::string& file, Problems& problems);

}  // namespace vsa::reader
