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

  /// To be filled with where they are, before mobility().
  [[nodiscard]] std::vector<host::TreeBody>& bodies() noexcept { return bodies_; }
  /// Actuators by trees, for host::Robot::join; none where the model is no tree.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& trees() const noexcept { return trees_; }
  /// B of each tree, one after the other, with the bodies where they are now. Kept to seven digits: plenty for a prediction, and
  /// the links' poses, from which it comes, differ by rounding after a reset.
  void mobility(std::span<double> out) noexcept {
    inertia_.update(bodies_);
    for (const auto& tree : of_tree_) {
      const std::size_t size = tree.size() * tree.size();
      inertia_.mobility(bodies_, tree, out.first(size));
      for (double& b : out.first(size)) b = static_cast<float>(b);
      out = out.subspan(size);
    }
  }

 private:
  std::vector<host::TreeBody> bodies_;
  std::vector<std::size_t> driven_;
  host::TreeInertia inertia_{0};
  std::vector<std::vector<std::size_t>> trees_, of_tree_;
};

}  // namespace vsa::seat
