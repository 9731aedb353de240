// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "attached_robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vsa/config/faults_text.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/errors.hpp"

namespace vsa::plugins {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPausedEvery{100};
constexpr std::int64_t kLongestStep_ns = 16'000'000;  // host::Robot::advance

host::Robot make_robot(const Attachment& attachment) {
  host::RobotConfig config = config::parse_plugin(attachment.xml, attachment.where, config::PresetLibrary());
  Problems problems;
  config::check_joints(config, attachment.joints, attachment.where, problems);
  config::check_one_step(config, attachment.where, problems);
  problems.throw_if_any();
  return host::Robot(std::move(config));
}

std::vector<DrivenJoints::Joint> driven(const host::RobotConfig& config, const Attachment& attachment) {
  std::vector<DrivenJoints::Joint> joints;
  if (attachment.keys.empty()) return joints;
  for (const host::ActuatorConfig& a : config.actuators) {
    const auto at = std::find(attachment.joints.begin(), attachment.joints.end(), a.joint) - attachment.joints.begin();
    joints.push_back({attachment.keys.at(static_cast<std::size_t>(at)), a.joint, a.name});
  }
  return joints;
}

}  // namespace

AttachedRobot::AttachedRobot(const Attachment& attachment, host::RobotTopics::Report report)
    : report_(std::move(report)),
      model_(attachment.model),
      robot_(make_robot(attachment)),
      joints_(attachment.where, driven(robot_.config(), attachment)),
      in_(robot_.size()),
      torques_(robot_.size(), 0.0),
      watch_(robot_.size()) {
  ports_.open(robot_, model_, report_);
  topics_.emplace(robot_, model_, port_, report_);
  faults_.emplace(robot_, model_);
}

void AttachedRobot::stop(const std::string& why) {
  stopped_ = true;
  std::fill(torques_.begin(), torques_.end(), 0.0);
  report_(model_ + ": " + why + ": its actuators give no torque until the world is reset");
}

void AttachedRobot::join(const std::vector<std::vector<std::size_t>>& trees) {
  if (trees.empty() && robot_.size() > 0) {
    report_(model_ +
            ": no tree of hinges, sliders and fixed joints (a loop, a ball joint, another model's link): its joints are solved one "
            "by one with their types' shaft.inertia_kgm2");
    return;
  }
  robot_.join(trees);
  mobility_.resize(robot_.mobility_size());
}

void AttachedRobot::step(std::int64_t dt_ns) {
  if (stopped_) return;
  if (dt_ns <= 0 || dt_ns > kLongestStep_ns) {
    stop("a step of " + std::to_string(dt_ns) + " ns is outside 1 ns … 16 ms");
    return;
  }
  for (std::size_t i = 0; i < in_.size(); ++i) {
    if (std::isfinite(in_[i].angle_rad) && std::isfinite(in_[i].speed_rad_per_s)) continue;
    stop("joint " + robot_.config().actuators[i].joint + " is no longer at a finite angle or speed");
    return;
  }
  robot_.advance(time_ns_, dt_ns, in_, torques_, mobility_);
  time_ns_ += dt_ns;
  if (!ports_.all().empty() && pace_.fell_behind(Clock::now(), time_ns_)) {
    report_(model_ + ": slower than real time: units on serial ports answer in time, but move more slowly than a client expects");
  }
}

void AttachedRobot::publish_step(std::int64_t time_ns) { topics_->update(time_ns); }

void AttachedRobot::publish_paused(std::int64_t time_ns) {
  pace_.stood();
  const auto now = Clock::now();
  if (now < next_paused_) return;
  next_paused_ = now + kPausedEvery;
  topics_->publish(time_ns);
}

bool AttachedRobot::apply_faults(const std::string& words, const std::string& where) {
  try {
    (void)config::apply_faults(robot_, words, where);
    return true;
  } catch (const InputError& error) {
    report_(model_ + ": refused: " + error.what());
    return false;
  }
}

void AttachedRobot::reset() {
  robot_.reset();
  pace_.stood();
  time_ns_ = 0;
  watch_.again();
  stopped_ = false;
  std::fill(torques_.begin(), torques_.end(), 0.0);
}

}  // namespace vsa::plugins
