// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "topics_commands.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vsa/errors.hpp"

namespace vsa::host {
namespace {

constexpr std::string_view kPresetSuffix = "_preset";
constexpr double kLongest_s = 1e9;  // Robot::follow's limit, so that it can't refuse a part of what was checked here

std::string not_finite_text(std::size_t index) { return "position " + std::to_string(index) + " isn't a finite number"; }

std::optional<std::size_t> first_not_finite(const std::vector<double>& values) {
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  if (bad == values.end()) return std::nullopt;
  return static_cast<std::size_t>(bad - values.begin());
}

std::string length_text(std::size_t found, std::size_t expected, std::string_view why) {
  return "has " + std::to_string(found) + " positions where " + std::to_string(expected) + " belong (" + std::string(why) + ")";
}

}  // namespace

TopicCommands::TopicCommands(Robot& robot, RobotTopics::Report report) : robot_(robot), report_(std::move(report)) {
  Problems problems;
  const auto& actuators = robot.config().actuators;
  for (std::size_t i = 0; i < actuators.size(); ++i) targets_[actuators[i].name] = {i, Robot::Channel::equilibrium};
  for (std::size_t i = 0; i < actuators.size(); ++i) {
    const std::string name = actuators[i].name + std::string(kPresetSuffix);
    if (!targets_.emplace(name, Target{i, Robot::Channel::preset}).second) {
      problems.add({"", "actuator", name,
                    "is both an actuator's name and, in a trajectory, the preset of '" + actuators[i].name + "'", "another name"});
    }
  }
  problems.throw_if_any();
}

void TopicCommands::refuse(const std::string& topic, Refusal fault, const std::string& text) {
  refused_.fetch_add(1);
  {
    const std::lock_guard lock(mutex_);
    if (!reported_.emplace(topic, fault).second) return;
  }
  if (report_) report_(topic + ": command refused: " + text + " (further ones like it are refused in silence)");
}

void TopicCommands::single(const std::string& topic, std::size_t actuator, Robot::Channel channel, double value) {
  if (!std::isfinite(value)) {
    refuse(topic, Refusal::not_finite, "it isn't a finite number");
    return;
  }
  apply_point({{actuator, channel}}, {value});
}

void TopicCommands::array(const std::string& topic, const ActuatorsCmd& message) {
  const std::size_t n = robot_.size();
  const auto& values = message.positions;
  if (values.size() != 2 * n) {
    refuse(topic, Refusal::wrong_length, length_text(values.size(), 2 * n, "all equilibria, then all presets"));
    return;
  }
  if (const auto bad = first_not_finite(values)) {
    refuse(topic, Refusal::not_finite, not_finite_text(*bad));
    return;
  }
  std::vector<Robot::Command> commands;
  for (std::size_t i = 0; i < n; ++i) commands.push_back({i, values[i], values[n + i]});
  robot_.command(commands);
}

bool TopicCommands::find_targets(const std::string& topic, const Trajectory& message, std::vector<Target>& targets) {
  for (const std::string& name : message.names) {
    const auto found = targets_.find(name);
    if (found == targets_.end()) {
      std::string known;
      for (const auto& actuator : robot_.config().actuators) known += (known.empty() ? "" : ", ") + actuator.name;
      refuse(topic, Refusal::unknown_name, "no actuator '" + name + "' (allowed: " + known + ", each also with _preset)");
      return false;
    }
    targets.push_back(found->second);
  }
  std::set<Target> seen;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (seen.insert(targets[i]).second) continue;
    refuse(topic, Refusal::repeated_name, "'" + message.names[i] + "' is named twice");
    return false;
  }
  return true;
}

bool TopicCommands::check_points(const std::string& topic, const Trajectory& message) {
  double last = -1;
  for (std::size_t p = 0; p < message.points.size(); ++p) {
    const auto& point = message.points[p];
    const std::string where = "point " + std::to_string(p) + ": ";
    if (point.positions.size() != message.names.size()) {
      refuse(topic, Refusal::wrong_length, where + length_text(point.positions.size(), message.names.size(), "one per joint name"));
      return false;
    }
    if (const auto bad = first_not_finite(point.positions)) {
      refuse(topic, Refusal::not_finite, where + not_finite_text(*bad));
      return false;
    }
    const double time = point.time_from_start_s;
    if (message.points.size() > 1 && !(time >= 0 && time > last && time <= kLongest_s)) {
      refuse(topic, Refusal::bad_times, where + "time_from_start must grow from point to point, within 0 … 1e9 s");
      return false;
    }
    last = time;
  }
  return true;
}

void TopicCommands::trajectory(const std::string& topic, const Trajectory& message) {
  if (message.names.empty() || message.points.empty()) {
    refuse(topic, Refusal::empty, "it has no joint names or no points");
    return;
  }
  std::vector<Target> targets;
  if (!find_targets(topic, message, targets) || !check_points(topic, message)) return;
  if (message.points.size() == 1) {
    apply_point(targets, message.points.front().positions);
    return;
  }
  std::vector<Robot::Path> paths;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    Robot::Path& path = paths.emplace_back();
    path.actuator = targets[k].actuator;
    path.channel = targets[k].channel;
    for (const auto& point : message.points) path.knots.push_back({point.time_from_start_s, point.positions[k]});
  }
  robot_.follow(std::move(paths));
}

void TopicCommands::apply_point(const std::vector<Target>& targets, const std::vector<double>& values) {
  std::vector<Robot::Command> commands;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    Robot::Command& c = commands.emplace_back();
    c.actuator = targets[k].actuator;
    (targets[k].channel == Robot::Channel::equilibrium ? c.equilibrium_rad : c.preset) = values[k];
  }
  robot_.command(commands);
}

}  // namespace vsa::host
