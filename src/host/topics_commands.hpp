// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Commands from topics: checked whole, then applied whole.
#pragma once

#include <array>
#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "vsa/host/topics.hpp"

namespace vsa::host {

enum class Refusal { not_finite, wrong_length, unknown_name, repeated_name, empty, bad_times };

class TopicCommands {
 public:
  /// Throws InputError where an actuator's name equals another's with "_preset" added.
  TopicCommands(Robot& robot, RobotTopics::Report report);

  void single(const std::string& topic, std::size_t actuator, Robot::Channel channel, double value);
  void trajectory(const std::string& topic, const Trajectory& message);
  void array(const std::string& topic, const ActuatorsCmd& message);
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(); }

 private:
  struct Target {
    std::size_t actuator = 0;
    Robot::Channel channel = Robot::Channel::equilibrium;
    bool operator<(const Target& other) const { return std::pair(actuator, channel) < std::pair(other.actuator, other.channel); }
  };

  void refuse(const std::string& topic, Refusal fault, const std::string& text);
  [[nodiscard]] bool find_targets(const std::string& topic, const Trajectory& message, std::vector<Target>& targets);
  [[nodiscard]] bool check_points(const std::string& topic, const Trajectory& message);
  void apply_point(const std::vector<Target>& targets, const std::vector<double>& values);

  Robot& robot_;
  RobotTopics::Report report_;
  std::map<std::string, Target, std::less<>> targets_;
  std::atomic<std::uint64_t> refused_{0};
  std::mutex mutex_;  // guards reported_
  std::set<std::pair<std::string, Refusal>> reported_;
};

}  // namespace vsa::host
