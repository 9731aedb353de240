// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What older plug-ins of these actuators called things: the ROS-Gazebo toolbox of 2021 (one <plugin> a joint, tags such as
// spring_k1), the plug-ins that it came from, and the Gazebo plug-in of 2015 (fixed joint names). A tag that means the same here is
// taken; any other is answered with the new spelling and why. docs/howto/migration.md is the table, and a test goes through its
// rows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/xml_reader.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::config {

struct OlderTags {
  struct Taken {
    std::string tag;  ///< as written, for problems
    Override override;
  };
  std::vector<Taken> taken;
  bool motor_at_pulley = false;  ///< has values of the toolbox's motor, which turns the pulley without a gearbox
};

[[nodiscard]] bool is_older_tag(std::string_view name);

/// The toolbox's tags among the children of an <actuator> (or of a <plugin> of the toolbox).
[[nodiscard]] OlderTags read_older_tags(const tinyxml2::XMLElement& e, const std::string& path, XmlReader& xml);

/// Whether a <plugin> has an older library's file name, or a tag that only these have.
[[nodiscard]] bool is_surely_older_plugin(const tinyxml2::XMLElement& root);
/// The same of an element that is meant for vsa::Robot: a bare <joint> shows it too.
[[nodiscard]] bool is_older_plugin(const tinyxml2::XMLElement& root);
/// Adds a problem that holds the whole element in the new spelling, and one for every tag that has no equal.
void answer_older_plugin(const tinyxml2::XMLElement& root, XmlReader& xml);

/// Joints of the motors, which the models of 2015 had beside each shaft.
void check_motor_joints(const host::RobotConfig& config, const std::vector<std::string>& joints, std::string_view where,
                        Problems& problems);

}  // namespace vsa::config
