// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One configuration of ros_gz_bridge a robot. Names of the Gazebo side are those of vsa/host/topics.hpp; a test compares them with
// what a robot really subscribes to and publishes, and the type pairs with the bridge's own list.
#include <fmt/format.h>

#include <regex>

#include "generate.hpp"

namespace vsa::generate {
namespace {

enum class Way { to_ros, to_gz };

struct Pair {
  const char *ros, *gz;
};
constexpr Pair kClock{"rosgraph_msgs/msg/Clock", "gz.msgs.Clock"};
constexpr Pair kStates{"sensor_msgs/msg/JointState", "gz.msgs.Model"};
constexpr Pair kTrajectory{"trajectory_msgs/msg/JointTrajectory", "gz.msgs.JointTrajectory"};
constexpr Pair kArray{"actuator_msgs/msg/Actuators", "gz.msgs.Actuators"};
constexpr Pair kNumber{"std_msgs/msg/Float64", "gz.msgs.Double"};

/// Lazy: the bridge listens on a side only while somebody listens on the other, and the robot publishes only to who listens.
std::string entry(const std::string& ros_topic, const std::string& gz_topic, const Pair& types, Way way) {
  return fmt::format(
      "- ros_topic_name: \"{}\"\n  gz_topic_name: \"{}\"\n  ros_type_name: \"{}\"\n  gz_type_name: \"{}\"\n  direction: {}\n{}",
      ros_topic, gz_topic, types.ros, types.gz, way == Way::to_ros ? "GZ_TO_ROS" : "ROS_TO_GZ",
      way == Way::to_ros ? "  lazy: true\n" : "");
}

std::string bridge(const std::string& model, const std::vector<std::string>& actuators) {
  std::string text =
      "# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0\n"
      "# Written by vsa-generate from models/robots.toml: change that, not this. See docs/howto/ros2.md.\n";
  const std::string gz = "/model/" + model;
  // Not lazy: nodes with use_sim_time start by listening.
  text += "- ros_topic_name: \"/clock\"\n  gz_topic_name: \"/clock\"\n  ros_type_name: \"" + std::string(kClock.ros) +
          "\"\n  gz_type_name: \"" + kClock.gz + "\"\n  direction: GZ_TO_ROS\n";
  text += entry("/" + model + "/joint_states", gz + "/vsa/joint_state", kStates, Way::to_ros);
  text += entry("/" + model + "/cmd", gz + "/vsa/cmd", kTrajectory, Way::to_gz);
  text += entry("/" + model + "/cmd_array", gz + "/vsa/cmd_array", kArray, Way::to_gz);
  for (const std::string& actuator : actuators) {
    const std::string ros_joint = "/" + model + "/" + actuator + "/", gz_joint = gz + "/joint/" + actuator + "/";
    for (const char* leaf : {"cmd_equilibrium", "cmd_preset"})
      text += entry(ros_joint + leaf, gz_joint + leaf, kNumber, Way::to_gz);
    for (const char* leaf : {"stiffness", "deflection", "preset", "current_1", "current_2"})
      text += entry(ros_joint + leaf, gz_joint + leaf, kNumber, Way::to_ros);
  }
  return text;
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> out;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) out.push_back((*at)[1]);
  return out;
}

}  // namespace

Files bridges(const Files& models) {
  const std::regex model_name("<model name=\"([^\"]*)\""), actuator_name("<actuator name=\"([^\"]*)\"");
  Files files;
  for (const auto& [name, text] : models) {
    const auto model = matches(text, model_name), actuators = matches(text, actuator_name);
    if (model.size() == 1 && !actuators.empty())
      files["config/" + model.front() + "/bridge.yaml"] = bridge(model.front(), actuators);
  }
  return files;
}

}  // namespace vsa::generate
