// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Gazebo Classic 11: the <plugin name="vsa::Robot"> of a model. Glue only.
//
// At the start of every step Gazebo tells each joint's angle and speed and takes its torque; in between nothing is ours, so other
// joints and other plug-ins are left alone. Load errors are one message on Gazebo's error log and a model without torques.
#pragma once

#include <gazebo/common/Plugin.hh>
#include <gazebo/common/UpdateInfo.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "attached_robot.hpp"
#include "gazebo_port.hpp"
#include "model_tree.hpp"

namespace vsa::plugins {

class ClassicRobot : public gazebo::ModelPlugin {
 public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr element) override;
  void Reset() override;

  /// Null where loading failed. For tests.
  [[nodiscard]] AttachedRobot* robot() noexcept { return robot_.get(); }

 private:
  void attach(const sdf::ElementPtr& element);
  void update(const gazebo::common::UpdateInfo& info);

  gazebo::physics::ModelPtr model_;
  std::vector<gazebo::physics::JointPtr> joints_;  ///< of the actuators
  std::unique_ptr<AttachedRobot> robot_;
  std::unique_ptr<ModelTree> tree_;
  int steps_to_refresh_ = 0;
  std::optional<host::RobotTopics> own_topics_;  ///< on Gazebo's own transport; before the port, which must go first
  std::unique_ptr<GazeboPort> own_port_;
  gazebo::event::ConnectionPtr connection_;  ///< gone before the robot is
};

}  // namespace vsa::plugins
