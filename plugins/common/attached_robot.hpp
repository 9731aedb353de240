// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a plug-in of any Gazebo does with its robot; the adapters only carry numbers in and out.
//
//   AttachedRobot robot({element_xml, "world: model", "model", joints_of_the_model}, report);
//   once:          robot.join(trees of its actuators' joints)
//   every step:    for each actuator i: angle and speed into robot.in()[i]
//                  if (robot.wants_mobility()) fill robot.mobility();
//                  robot.step(dt_ns);
//                  for each actuator i: apply robot.torques()[i]
//                  robot.publish_step(end of the step, simulated)
//   while paused:  robot.publish_paused(simulated time)
//
// The robot's clock counts the steps it was given since it was loaded or reset, so a host that sets its time back or seeks doesn't
// disturb buses and firmware; stamps of messages are the host's time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driven_joints.hpp"
#include "vsa/host/mobility_watch.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/host/topics.hpp"
#include "vsa/ports/pace_watch.hpp"
#include "vsa/ports/robot_ports.hpp"
#include "vsa/topics/fault_service.hpp"
#include "vsa/topics/ignition_port.hpp"

namespace vsa::plugins {

struct Attachment {
  std::string xml;                  ///< of the whole <plugin> element
  std::string where;                ///< leads every line of a problem
  std::string model;                ///< scoped name
  std::vector<std::string> joints;  ///< one-axis joints, relative to the model: "module_1::shaft"
  std::vector<JointKey> keys{};     ///< one a joint; none: two plug-ins that drive one joint go unnoticed
};

class AttachedRobot {
 public:
  /// Throws InputError with every problem at once; a joint that another robot drives is one, then nothing is opened or advertised.
  AttachedRobot(const Attachment& attachment, host::RobotTopics::Report report);

  [[nodiscard]] const host::RobotConfig& config() const noexcept { return robot_.config(); }
  [[nodiscard]] host::Robot& robot() noexcept { return robot_; }
  [[nodiscard]] std::span<host::JointIn> in() noexcept { return in_; }
  [[nodiscard]] std::span<const double> torques() const noexcept { return torques_; }

  /// Which actuators' joints move each other (host::Robot::join). None where the model is no tree: that is reported, and each joint
  /// is then solved by itself with its type's shaft inertia.
  void join(const std::vector<std::vector<std::size_t>>& trees);
  /// Once before each step, when in() is filled: whether B is due.
  [[nodiscard]] bool wants_mobility() noexcept { return !mobility_.empty() && watch_.due(in_); }
  [[nodiscard]] std::span<double> mobility() noexcept { return mobility_; }

  /// One step of the host. A step length that the units don't know, or a joint that is no longer finite, stops the actuators with
  /// one reported line: torques are 0 until reset().
  void step(std::int64_t dt_ns);
  void publish_step(std::int64_t time_ns);
  void publish_paused(std::int64_t time_ns);  ///< 10 times a wall second at most
  /// As the service of faults does (docs/reference/topics.md). False: refused and reported, nothing changed. `where` names the
  /// text.
  bool apply_faults(const std::string& words, const std::string& where);
  void reset();  ///< back to the first sample

  [[nodiscard]] bool stopped() const noexcept { return stopped_; }

 private:
  using Clock = std::chrono::steady_clock;

  void stop(const std::string& why);

  host::RobotTopics::Report report_;
  std::string model_;
  host::Robot robot_;
  DrivenJoints joints_;
  std::vector<host::JointIn> in_;
  std::vector<double> torques_, mobility_;
  host::MobilityWatch watch_;
  std::int64_t time_ns_ = 0;
  bool stopped_ = false;
  Clock::time_point next_paused_{};
  std::optional<host::RobotTopics> topics_;  ///< must outlive its port's handlers, so it comes before the port
  topics::IgnitionPort port_;
  std::optional<topics::FaultService> faults_;
  ports::RobotPorts ports_;
  ports::PaceWatch pace_;
};

}  // namespace vsa::plugins
