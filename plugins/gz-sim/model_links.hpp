// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "compat.hpp"
#include "model_scene.hpp"

namespace vsa::plugins {

/// Of the model and those nested in it. `name`: its scoped name. The manager must outlive what is returned.
[[nodiscard]] ModelLinks model_links(sim::Entity model, const std::string& name, const sim::EntityComponentManager& ecm);

/// Of the world that the manager is of. Step: 0 where it isn't known.
[[nodiscard]] double world_step_s(const sim::EntityComponentManager& ecm);
[[nodiscard]] math::Vector3d world_gravity(const sim::EntityComponentManager& ecm);  ///< m/s²
[[nodiscard]] std::string world_name(const sim::EntityComponentManager& ecm);

}  // namespace vsa::plugins
