// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a link looks like, from its SDF element: any Gazebo has that.
#pragma once

#include <sdf/Element.hh>
#include <string>
#include <vector>

#include "vsa/scene/link.hpp"

namespace vsa::plugins {

/// Boxes, spheres, cylinders, capsules and planes of the visuals, or of the collisions where a link has no visual. How many others it
/// has is added to `left_out`.
[[nodiscard]] std::vector<scene::Shape> link_shapes(const sdf::ElementPtr& link, int& left_out);

/// A line for all that were left out; none: nothing was.
[[nodiscard]] std::vector<std::string> left_out_notice(int left_out);

}  // namespace vsa::plugins
