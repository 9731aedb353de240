// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// host/topics' neutral messages and their stock counterparts.
#pragma once

#include <cstdint>

#include "stock.hpp"
#include "vsa/host/topics.hpp"

namespace vsa::topics {

void set_time(msgs::Time& out, std::int64_t time_ns);
[[nodiscard]] std::int64_t to_ns(const msgs::Time& time);

#ifdef VSA_HAS_JOINT_TRAJECTORY
[[nodiscard]] host::Trajectory decode(const msgs::JointTrajectory& message);
void encode(const host::Trajectory& trajectory, msgs::JointTrajectory& out);
#endif

[[nodiscard]] host::ActuatorsCmd decode(const msgs::Actuators& message);

/// Joints in order; the shaft's header carries the actuator's name and its commands as data:
/// "actuator", "equilibrium_command_rad", "preset_command". `out` may hold the last message: its strings are reused.
void encode(const host::JointStates& states, msgs::Model& out);
/// A message without those data gives no names and no commands.
[[nodiscard]] host::JointStates decode(const msgs::Model& message);

}  // namespace vsa::topics
