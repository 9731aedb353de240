// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>

#include "model_scene.hpp"

namespace vsa::plugins {

/// Of the model and those nested in it.
[[nodiscard]] std::vector<gazebo::physics::LinkPtr> all_links(const gazebo::physics::ModelPtr& model);
[[nodiscard]] ModelLinks model_links(const gazebo::physics::ModelPtr& model);

}  // namespace vsa::plugins
