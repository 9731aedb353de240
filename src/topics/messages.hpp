// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// host/topics' neutral messages and their stock counterparts.
#pragma once

#include <ignition/msgs/actuators.pb.h>
#include <ignition/msgs/joint_trajectory.pb.h>
#include <ignition/msgs/model.pb.h>
#include <ignition/msgs/time.pb.h>

#include <cstdint>

#include "vsa/host/topics.hpp"

namespace vsa::topics {

void set_time(ignition::msgs::Time& out, std::int64_t time_ns);
[[nodiscard]] std::int64_t to_ns(const ignition::msgs::Time& time);

[[nodiscard]] host::Trajectory decode(const ignition::msgs::JointTrajectory& message);
void encode(const host::Trajectory& trajectory, ignition::msgs::JointTrajectory& out);

[[nodiscard]] host::ActuatorsCmd decode(const ignition::msgs::Actuators& message);

/// Joints in order; the shaft's header carries the actuator's name and its commands as data:
/// "actuator", "equilibrium_command_rad", "preset_command". `out` may hold the last message: its strings are reused.
void encode(const host::JointStates& states, ignition::msgs::Model& out);
/// A message without those data gives no names and no commands.
[[nodiscard]] host::JointStates decode(const ignition::msgs::Model& message);

}  // namespace vsa::topics
