// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A model's links as a tree of bodies, for the mobility of its joints, which Gazebo's engines don't tell.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <ignition/math/Matrix3.hh>
#include <ignition/math/Vector3.hh>
#include <vector>

#include "model_robots.hpp"

namespace vsa::plugins {

class ModelTree final : public LinkTrees {
 public:
  /// Of the model and those nested in it. `driven`: the actuators' joints, by Base::GetId(). No tree where the model isn't one of
  /// hinges, sliders and fixed joints (loops, ball joints, links of other models).
  ModelTree(const gazebo::physics::ModelPtr& model, const ModelRobot::Joints& driven);

  void look() override;
  void feel() override;

 private:
  struct Item {
    gazebo::physics::LinkPtr link;
    gazebo::physics::JointPtr joint;  ///< that it hangs on; null: free
    // in the link's own frame
    ignition::math::Vector3d center, axis, anchor;
    ignition::math::Matrix3d inertia;
    bool implicit = false;  ///< the engine takes the joint's spring and damper implicitly
  };

  void read_joint(Item& item, host::TreeBody& body);
  void read_inertia(Item& item, host::TreeBody& body);

  bool build(const std::vector<gazebo::physics::LinkPtr>& links, std::vector<host::TreeBody>& bodies);

  std::vector<Item> items_;
  std::vector<std::size_t> passive_;  ///< joints without actuators
  std::size_t next_ = 0;              ///< whose inertia is read again
  bool read_ = false;                 ///< joints were
};

}  // namespace vsa::plugins
