// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "vsa/config/text.hpp"

namespace vsa::topics {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr std::array<const char*, 5> kKeys{"actuator", "equilibrium_command_rad", "preset_command", "equilibrium_unit",
                                           "preset_unit"};
constexpr int kOldest = 3;  // of them: an older robot tells no units

double number(const std::string& text) { return config::parse_number(text).value_or(std::numeric_limits<double>::quiet_NaN()); }

void set_data(msgs::Header& header, int index, const std::string& value) {
  while (header.data_size() <= index) header.add_data()->set_key(kKeys[static_cast<std::size_t>(header.data_size() - 1)]);
  auto& data = *header.mutable_data(index);
  if (data.value_size() == 0) data.add_value();
  data.set_value(0, value);
}

bool has_data(const msgs::Header& header) {
  if (header.data_size() < kOldest) return false;
  for (int i = 0; i < std::min(header.data_size(), static_cast<int>(kKeys.size())); ++i) {
    if (header.data(i).key() != kKeys[static_cast<std::size_t>(i)] || header.data(i).value_size() != 1) return false;
  }
  return true;
}

}  // namespace

void set_time(msgs::Time& out, std::int64_t time_ns) {
  out.set_sec(time_ns / kNsPerSecond);
  out.set_nsec(static_cast<std::int32_t>(time_ns % kNsPerSecond));
}

std::int64_t to_ns(const msgs::Time& time) {
  // What doesn't fit is as good as for ever; a client may send any 64 bits.
  constexpr std::int64_t kLast_s = std::numeric_limits<std::int64_t>::max() / kNsPerSecond - 2;
  const std::int64_t seconds = std::clamp<std::int64_t>(time.sec(), -kLast_s, kLast_s);
  return seconds * kNsPerSecond + std::clamp<std::int32_t>(time.nsec(), -999'999'999, 999'999'999);
}

#ifdef VSA_HAS_JOINT_TRAJECTORY
host::Trajectory decode(const msgs::JointTrajectory& message) {
  host::Trajectory out;
  out.names.assign(message.joint_names().begin(), message.joint_names().end());
  for (const auto& point : message.points()) {
    const double seconds = static_cast<double>(point.time_from_start().sec()) + 1e-9 * point.time_from_start().nsec();
    out.points.push_back({{point.positions().begin(), point.positions().end()}, seconds});
  }
  return out;
}

void encode(const host::Trajectory& trajectory, msgs::JointTrajectory& out) {
  out.Clear();
  for (const auto& name : trajectory.names) out.add_joint_names(name);
  for (const auto& point : trajectory.points) {
    auto& to = *out.add_points();
    for (const double position : point.positions) to.add_positions(position);
    const std::int64_t ns = std::llround(point.time_from_start_s * 1e9);
    to.mutable_time_from_start()->set_sec(ns / kNsPerSecond);
    to.mutable_time_from_start()->set_nsec(static_cast<std::int32_t>(ns % kNsPerSecond));
  }
}
#endif

host::ActuatorsCmd decode(const msgs::Actuators& message) { return {{message.position().begin(), message.position().end()}}; }

void encode(const host::JointStates& states, msgs::Model& out) {
  set_time(*out.mutable_header()->mutable_stamp(), states.time_ns);
  out.set_name(states.model);
  const auto count = static_cast<int>(states.joints.size());
  while (out.joint_size() < count) out.add_joint();
  std::size_t actuator = 0;
  for (int i = 0; i < count; ++i) {
    const auto& from = states.joints[static_cast<std::size_t>(i)];
    auto& to = *out.mutable_joint(i);
    to.set_name(from.name);
    auto& axis = *to.mutable_axis1();
    axis.set_position(from.position_rad);
    axis.set_velocity(from.velocity_rad_per_s);
    axis.set_force(from.force_Nm);
    const bool is_shaft = actuator < states.first_joint.size() && states.first_joint[actuator] == static_cast<std::size_t>(i);
    if (!is_shaft) continue;
    set_data(*to.mutable_header(), 0, states.names[actuator]);
    set_data(*to.mutable_header(), 1, config::number_text(states.commands[actuator].equilibrium_rad));
    set_data(*to.mutable_header(), 2, config::number_text(states.commands[actuator].preset));
    if (actuator < states.units.size()) {  // a caller of before them fills none
      set_data(*to.mutable_header(), 3, states.units[actuator].equilibrium);
      set_data(*to.mutable_header(), 4, states.units[actuator].preset);
    }
    ++actuator;
  }
}

host::JointStates decode(const msgs::Model& message) {
  host::JointStates out;
  out.time_ns = to_ns(message.header().stamp());
  out.model = message.name();
  for (const auto& joint : message.joint()) {
    if (has_data(joint.header())) {
      out.first_joint.push_back(out.joints.size());
      out.names.push_back(joint.header().data(0).value(0));
      out.commands.push_back({number(joint.header().data(1).value(0)), number(joint.header().data(2).value(0))});
      auto& units = out.units.emplace_back();
      if (joint.header().data_size() >= static_cast<int>(kKeys.size()))
        units = {joint.header().data(3).value(0), joint.header().data(4).value(0)};
    }
    out.joints.push_back({joint.name(), joint.axis1().position(), joint.axis1().velocity(), joint.axis1().force()});
  }
  return out;
}

}  // namespace vsa::topics
