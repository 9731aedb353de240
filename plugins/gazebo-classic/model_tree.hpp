// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A model's links as a tree of bodies, for the inverse inertias of its joints, which Gazebo's engines don't tell.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <optional>
#include <vector>

#include "vsa/host/tree_inertia.hpp"

namespace vsa::plugins {

class ModelTree {
 public:
  /// Of the model and those nested in it. `driven`: the joints that are asked for.
  ModelTree(const gazebo::physics::ModelPtr& model, const std::vector<gazebo::physics::JointPtr>& driven);

  /// Takes the links' present places.
  void update();
  /// None where the model is no tree of hinges, sliders and fixed joints (loops, ball joints, links of other models), or has no
  /// mass there: the preset's own value serves then.
  [[nodiscard]] std::optional<double> inverse(std::size_t driven) const;

 private:
  struct Item {
    gazebo::physics::LinkPtr link;
    gazebo::physics::JointPtr joint;  ///< that it hangs on; null: free
  };

  bool build(const std::vector<gazebo::physics::LinkPtr>& links);

  std::vector<Item> items_;
  std::vector<vsa::host::TreeBody> bodies_;
  std::vector<std::size_t> body_of_;  ///< one a driven joint
  std::vector<double> inverse_;
  vsa::host::TreeInertia inertia_{0};
};

}  // namespace vsa::plugins
