// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The bodies of a model and those whose joints have actuators: from them come B and what else moves the joints, which no Gazebo
// tells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "vsa/host/robot.hpp"
#include "vsa/host/tree_foresight.hpp"
#include "vsa/host/tree_inertia.hpp"
#include "vsa/owner.hpp"

namespace vsa::seat {

/// A model's rigid tree as its host sees it: the host keeps bodies() up to date, mobility() makes B of it.
class DrivenTree {
 public:
  DrivenTree() = default;
  /// `driven`: the body of each actuator's joint, in the actuators' order.
  DrivenTree(std::vector<host::TreeBody> bodies, std::vector<std::size_t> driven)
      : bodies_(std::move(bodies)),
        driven_(std::move(driven)),
        inertia_(bodies_.size()),
        foresight_(bodies_.size()),
        memory_(foresight_.begin()),
        positions_(bodies_.size()),
        seen_at_(bodies_.size()),
        speeds_(bodies_.size()),
        free_(bodies_.size()),
        trees_(host::joined(bodies_, driven_)) {
    using Kind = host::TreeBody::Joint;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if ((bodies_[i].joint == Kind::revolute || bodies_[i].joint == Kind::prismatic) &&
          std::find(driven_.begin(), driven_.end(), i) == driven_.end())
        beside_.push_back(i);
    for (const auto& tree : trees_) {
      of_tree_.emplace_back();
      for (const std::size_t actuator : tree) of_tree_.back().push_back(driven_[actuator]);
    }
  }

  /// To be filled with where they are, then update().
  [[nodiscard]] std::vector<host::TreeBody>& bodies() noexcept { return bodies_; }
  /// Actuators by trees, for host::Robot::join; none where the model is no tree.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& trees() const noexcept { return trees_; }
  /// Takes over where the bodies are now.
  void update() noexcept { inertia_.update(bodies_); }
  /// B of that tree, by rows, as of the last update(). Kept to seven digits: plenty for a prediction, and the links' poses, from which
  /// it comes, differ by rounding after a reset.
  void mobility(std::size_t tree, std::span<double> out) noexcept {
    inertia_.mobility(bodies_, of_tree_[tree], out);
    for (double& b : out) b = static_cast<float>(b);
  }

  /// Where joints without actuators are, one entry a body, rad or m: to be filled before foresee().
  [[nodiscard]] std::vector<double>& positions() noexcept { return positions_; }
  /// How fast they are, rad/s or m/s, likewise.
  [[nodiscard]] std::vector<double>& speeds() noexcept { return speeds_; }
  /// By how much a joint without an actuator has turned since it was asked last, rad at most; a slide counts ten radians for a metre.
  /// Once before each step, when positions() are filled (Seat::turned).
  [[nodiscard]] double turned_rad() noexcept {
    using Kind = host::TreeBody::Joint;
    double most = 0;
    for (const std::size_t i : beside_) {
      const double gone = std::abs(positions_[i] - seen_at_[i]);
      most = std::max(most, bodies_[i].joint == Kind::prismatic ? 10.0 * gone : gone);
      seen_at_[i] = positions_[i];
    }
    return most;
  }
  /// Once before each step, after update() where the bodies moved: JointIn::free_acceleration of the actuators, whose angles and speeds
  /// are there, in their order. Joints that were placed are told nothing (host/tree_foresight.hpp).
  void foresee(std::span<host::JointIn* const> actuators, double dt_s) noexcept {
    require(actuators.size() == driven_.size(), "vsa::seat::DrivenTree::foresee", "one entry an actuator");
    for (std::size_t i = 0; i < driven_.size(); ++i) {
      positions_[driven_[i]] = actuators[i]->angle_rad;
      speeds_[driven_[i]] = actuators[i]->speed_rad_per_s;
    }
    foresight_.foresee(bodies_, inertia_, positions_, speeds_, dt_s, memory_, free_);
    for (std::size_t i = 0; i < driven_.size(); ++i) {
      actuators[i]->free_acceleration_rad_per_s2.reset();
      if (std::isfinite(free_[driven_[i]]) && !actuators[i]->placed) actuators[i]->free_acceleration_rad_per_s2 = free_[driven_[i]];
    }
  }
  void forget() noexcept { memory_.forget(); }  ///< of the step before: after a reset

 private:
  std::vector<host::TreeBody> bodies_;
  std::vector<std::size_t> driven_, beside_;  ///< beside_: the other bodies with joints
  host::TreeInertia inertia_{0};
  host::TreeForesight foresight_{0};
  host::TreeForesight::Memory memory_;
  std::vector<double> positions_, seen_at_, speeds_, free_;
  std::vector<std::vector<std::size_t>> trees_, of_tree_;
};

}  // namespace vsa::seat
