// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robots that share a kinematic tree: an arm and the hand at its end, each described by itself. Their joints move each other within a
// step, so those are solved together, whoever's they are; all else of a robot stays its own.
//
//   RobotGroup group(2, {{{0, 0}, {0, 1}, {1, 0}}});       of robot 0 actuators 0 and 1, of robot 1 actuator 0: one tree
//   for each robot r: r.join(its own trees, group.shared(r))
//   every step: fill group.steps() and group.mobility(), then group.advance(dt_ns)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vsa/device/joint_solver.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::host {

/// Robots whose joints move each other: they are stepped together.
class RobotGroup {
 public:
  /// A joint, by its actuator.
  struct Joint {
    std::size_t robot = 0,  ///< of the group
        actuator = 0;       ///< of that robot
  };
  /// One robot's part of a step, as Robot::advance has it.
  struct Step {
    Robot* robot = nullptr;              ///< which one
    std::int64_t t_ns = 0;               ///< its time
    std::span<const JointIn> in{};       ///< one entry an actuator
    std::span<double> torques_out{};     ///< likewise
    std::span<const double> mobility{};  ///< of its own trees; empty: each joint by itself
    device::Holder* holder = nullptr;    ///< of its own trees
  };

  /// `trees`: those that several robots drive. Throws InputError for a robot beyond `robots` and for a joint twice.
  RobotGroup(std::size_t robots, std::vector<std::vector<Joint>> trees);
  /// For other robots, the same trees.
  [[nodiscard]] RobotGroup another() const { return {shared_.size(), joints_}; }

  /// What Robot::join takes as `shared` of that robot; throws InputError for a robot that there isn't.
  [[nodiscard]] const std::vector<std::size_t>& shared(std::size_t robot) const;
  /// One of each robot, to be filled before each step.
  [[nodiscard]] std::span<Step> steps() noexcept { return steps_; }
  /// B of each tree by rows, one after the other, 1/(kg·m²): to be filled before each step.
  [[nodiscard]] std::span<double> mobility() noexcept { return mobility_; }

  /// A step of all robots, with Robot::advance's terms; `holder`: of the group's trees. Where a joint of any isn't finite, all torques
  /// are NaN and all robots stay where they were.
  void advance(std::int64_t dt_ns, device::Holder* holder = nullptr) noexcept;

 private:
  struct Place {
    std::size_t robot = 0, shared = 0, actuator = 0;
  };
  struct Tree {
    explicit Tree(std::size_t size) : solver(size), joints(size), torques(size) {}
    device::JointSolver solver;
    std::vector<device::JointInStep> joints;
    std::vector<double> torques;
    std::vector<Place> places;
    std::size_t mobility_at = 0, index = 0;
  };
  void begin(Tree& tree, std::int64_t dt_ns) noexcept;

  std::vector<std::vector<Joint>> joints_;  // of the trees, as they were given
  std::vector<std::vector<std::size_t>> shared_;
  std::vector<Step> steps_;
  std::vector<double> mobility_;
  std::vector<Tree> trees_;
};

}  // namespace vsa::host
