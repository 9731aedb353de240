// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Gazebo Classic 11: the <plugin name="vsa::Robot"> of a model. Glue only.
//
// At the start of every step Gazebo tells each joint's angle and speed and takes its torque; in between nothing is ours, so other
// joints and other plug-ins are left alone. Load errors are one message on Gazebo's error log and a model without torques.
//
// Gazebo Classic tells nobody when it is paused, and then calls nobody. So a thread looks ten times a wall second whether a step
// was made since, and publishes the state if not. It shares the robot with the world's thread by one lock, which all robots of an
// outermost model have together, as they step together (model_robots.hpp).
#pragma once

#include <gazebo/common/Plugin.hh>
#include <gazebo/common/UpdateInfo.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model_robots.hpp"
#include "model_watch.hpp"
#include "vsa/seat/seat.hpp"
#include "wall_timer.hpp"

namespace vsa::plugins {

class ClassicRobot final : public gazebo::ModelPlugin, private ModelRobot {
 public:
  ~ClassicRobot() override;
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr element) override;
  void Reset() override;

  /// Null where loading failed. For tests.
  [[nodiscard]] seat::Seat* seat() noexcept override { return seat_.get(); }

 private:
  void attach(const sdf::ElementPtr& element);
  void update(const gazebo::common::UpdateInfo& info);
  [[nodiscard]] const Joints& driven() const noexcept override { return driven_; }
  [[nodiscard]] std::unique_ptr<LinkTrees> link_trees(Links links, const Joints& driven) override;
  void tell(std::int64_t time_ns) override;
  void apply() override;
  [[nodiscard]] std::int64_t step_ns() const;
  void publish_where_it_stands();

  gazebo::physics::ModelPtr model_;
  std::string world_;                              ///< its name
  std::vector<gazebo::physics::JointPtr> joints_;  ///< of the actuators
  Joints driven_;                                  ///< their numbers
  std::unique_ptr<seat::Seat> seat_;
  std::unique_ptr<ModelWatch> watch_;
  std::shared_ptr<ModelRobots> robots_;                   ///< of its outermost model; its mutex guards what is below, and the robot
  std::int64_t now_ns_ = 0;                               ///< simulated
  bool stepped_ = false;                                  ///< since the timer looked
  gazebo::event::ConnectionPtr connection_, time_reset_;  ///< gone before the robot is, as is the timer
  std::optional<WallTimer> timer_;
};

}  // namespace vsa::plugins
