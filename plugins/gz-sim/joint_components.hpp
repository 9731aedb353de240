// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A joint's components as numbers.
#pragma once

#include "compat.hpp"

namespace vsa::plugins {

inline bool has_one_axis(sim::Entity joint, const sim::EntityComponentManager& ecm) {
  const auto type = ecm.ComponentData<sim::components::JointType>(joint);
  return type == sdf::JointType::REVOLUTE || type == sdf::JointType::CONTINUOUS || type == sdf::JointType::PRISMATIC;
}

/// The first of a component's numbers; 0 where the physics hasn't filled it yet. Creates the component where it is missing.
template <class Component>
double first_number(sim::Entity joint, sim::EntityComponentManager& ecm) {
  const auto* component = ecm.Component<Component>(joint);
  if (component == nullptr) {
    ecm.CreateComponent(joint, Component());
    return 0.0;
  }
  return component->Data().empty() ? 0.0 : component->Data().front();
}

inline void set_force(sim::Entity joint, double torque, sim::EntityComponentManager& ecm) {
  auto* command = ecm.Component<sim::components::JointForceCmd>(joint);
  if (command == nullptr) {
    ecm.CreateComponent(joint, sim::components::JointForceCmd({torque}));
  } else {
    command->Data().assign(1, torque);
  }
}

}  // namespace vsa::plugins
