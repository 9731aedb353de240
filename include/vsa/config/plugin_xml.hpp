// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The <plugin name="vsa::Robot"> element, identical in every host, read from its XML text.
#pragma once

#include <string>
#include <string_view>

#include "vsa/config/preset.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::config {

inline constexpr std::string_view kPluginName = "vsa::Robot";

/// Throws InputError with every problem at once; `where` (file or model name) leads each line. Checks keys, numbers, duplicate
/// names, joints and bus ids, cycle times; whether a joint exists in the model is the host's to check, see check_joints().
[[nodiscard]] host::RobotConfig parse_plugin(std::string_view xml, std::string_view where, const PresetLibrary& presets);

/// Adds a problem for every configured joint that isn't among `joints` (scoped names).
void check_joints(const host::RobotConfig& config, const std::vector<std::string>& joints, std::string_view where,
                  Problems& problems);

}  // namespace vsa::config
