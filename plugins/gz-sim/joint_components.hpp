// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A joint's components as numbers.
#pragma once

#include <algorithm>
#include <vector>

#include "compat.hpp"

namespace vsa::plugins {

inline bool has_one_axis(sim::Entity joint, const sim::EntityComponentManager& ecm) {
  const auto type = ecm.ComponentData<sim::components::JointType>(joint);
  return type == sdf::JointType::REVOLUTE || type == sdf::JointType::CONTINUOUS || type == sdf::JointType::PRISMATIC;
}

inline bool slides(sim::Entity joint, const sim::EntityComponentManager& ecm) {
  return ecm.ComponentData<sim::components::JointType>(joint) == sdf::JointType::PRISMATIC;
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

/// Whether the physics fills that component of any of them.
template <class Component>
bool any_filled(const std::vector<sim::Entity>& joints, const sim::EntityComponentManager& ecm) {
  return std::any_of(joints.begin(), joints.end(), [&ecm](sim::Entity joint) {
    const auto* component = ecm.Component<Component>(joint);
    return component != nullptr && !component->Data().empty();
  });
}

/// What to say where none is.
inline constexpr const char* kNoPhysics =
    ": no physics moves it: its world has no physics system. Up to Harmonic a world with <plugin>s of its own must name the "
    "physics among them; later ones add that of server.config, unless <gz:policies> forbids it. Into a world without any gz-sim "
    "loads it, but Fortress before 6.8 only where no model has a plug-in either.";

inline void set_force(sim::Entity joint, double torque, sim::EntityComponentManager& ecm) {
  auto* command = ecm.Component<sim::components::JointForceCmd>(joint);
  if (command == nullptr) {
    ecm.CreateComponent(joint, sim::components::JointForceCmd({torque}));
  } else {
    command->Data().assign(1, torque);
  }
}

}  // namespace vsa::plugins
