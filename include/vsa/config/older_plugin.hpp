// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace vsa::config {

/// Whether the `<plugin>` element is of the ROS-Gazebo toolbox of 2021 or of the plug-in of 2015: parse_plugin() refuses those with
/// the same robot in the new spelling.
[[nodiscard]] bool is_older_plugin(std::string_view xml);

}  // namespace vsa::config
