// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The description's words as this room uses them.
#pragma once

#include "vsa/description/capabilities.hpp"
#include "vsa/description/world.hpp"

namespace vsa::reader {

using description::alike;
using description::Axis;
using description::Capabilities;
using description::Collision;
using description::Coupling;
using description::Geometry;
using description::Heightmap;
using description::Joint;
using description::Link;
using description::Mat3;
using description::Mesh;
using description::Pose3;
using description::Quat;
using description::Surface;
using description::Vec3;

}  // namespace vsa::reader
