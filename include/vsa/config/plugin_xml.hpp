// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The <plugin name="vsa::Robot"> element, identical in every host, read from its XML text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::config {

inline constexpr std::string_view kPluginName = "vsa::Robot";  ///< that every host looks for

/// Puts another actuator on a robot that is already described: every `<actuator>` takes these instead of what its element says.
struct Replacement {
  std::optional<std::string> type;  ///< given: the elements' own `<override>`s, which belong to their types, are left out
  std::vector<Override> overrides;  ///< come after the elements' own; of an equal key this one counts
  std::string flag = "override";    ///< what gave them, for their problems: "--set"
};

/// Throws InputError with every problem at once; `where` (file or model name) leads each line. Checks keys, numbers, duplicate
/// names, joints and bus ids, cycle times; whether a joint exists in the model is the host's to check, see check_joints().
/// An initial preset that a replacing actuator can't have is clamped to its range, or 0 where its unit is another.
[[nodiscard]] host::RobotConfig parse_plugin(std::string_view xml, std::string_view where, const TypeLibrary& types,
                                             const Replacement& replacement = {});

/// For hosts whose engine steps by itself: adds a problem where the robot asks for more than one substep.
void check_one_step(const host::RobotConfig& config, std::string_view where, Problems& problems);

/// Adds a problem for an actuator whose first equilibrium and preset ask a motor for what its firmware would clamp: where a unit starts
/// must be what the file says.
void check_start(const host::ActuatorConfig& actuator, const std::string& key, std::string_view where, Problems& problems);

/// Adds a problem for every configured joint that isn't among `joints` (scoped names).
void check_joints(const host::RobotConfig& config, const std::vector<std::string>& joints, std::string_view where,
                  Problems& problems);

}  // namespace vsa::config
