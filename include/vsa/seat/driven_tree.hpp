// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The bodies of a model and those whose joints have actuators: from them comes B, which no Gazebo tells.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "vsa/host/tree_inertia.hpp"

namespace vsa::seat {

/// A model's rigid tree as its host sees it: the host keeps bodies() up to date, mobility() makes B of it.
class DrivenTree {
 public:
  DrivenTree() = default;
  /// `driven`: the body of each actuator's joint, in the actuators' order.
  DrivenTree(std::vector<host::TreeBody> bodies, std::vector<std::size_t> driven)
      : bodies_(std::move(bodies)), driven_(std::move(driven)), inertia_(bodies_.size()), trees_(host::joined(bodies_, driven_)) {
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

 private:
  std::vector<host::TreeBody> bodies_;
  std::vector<std::size_t> driven_;
  host::TreeInertia inertia_{0};
  std::vector<std::vector<std::size_t>> trees_, of_tree_;
};

}  // namespace vsa::seat
