// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "robot_system.hpp"

#include <algorithm>
#include <utility>

#include "entities.hpp"
#include "vsa/errors.hpp"

namespace vsa::plugins {
namespace {

namespace components = sim::components;

constexpr int kRefreshSteps = 16;  // inverse inertias only serve the robot's prediction

bool has_one_axis(sim::Entity joint, const sim::EntityComponentManager& ecm) {
  const auto type = ecm.ComponentData<components::JointType>(joint);
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

void set_force(sim::Entity joint, double torque, sim::EntityComponentManager& ecm) {
  auto* command = ecm.Component<components::JointForceCmd>(joint);
  if (command == nullptr) {
    ecm.CreateComponent(joint, components::JointForceCmd({torque}));
  } else {
    command->Data().assign(1, torque);
  }
}

}  // namespace

void SimRobot::Configure(const sim::Entity& entity, const std::shared_ptr<const sdf::Element>& element,
                         sim::EntityComponentManager& ecm, sim::EventManager&) {
  model_ = entity;
  std::string name = sim::scopedName(entity, ecm, "::", false);
  if (const auto world = name.find("::"); world != std::string::npos) name.erase(0, world + 2);
  try {
    attach(*element, name, ecm);
  } catch (const InputError& error) {
    robot_.reset();
    VSA_ERROR << "vsa::Robot: " << name << " stays without torques:\n" << error.what() << std::endl;
  }
}

void SimRobot::attach(const sdf::Element& element, const std::string& name, sim::EntityComponentManager& ecm) {
  std::vector<NamedEntity> known;
  Attachment attachment{element.ToString(""), name, name, {}};
  for (const NamedEntity& joint : entities_below<components::Joint>(model_, ecm)) {
    if (!has_one_axis(joint.entity, ecm)) continue;
    known.push_back(joint);
    attachment.joints.push_back(joint.name);
  }
  robot_ = std::make_unique<AttachedRobot>(attachment,
                                           [](const std::string& line) { VSA_WARNING << "vsa::Robot: " << line << std::endl; });
  for (const host::ActuatorConfig& a : robot_->config().actuators) {
    joints_.push_back(std::find_if(known.begin(), known.end(), [&](const NamedEntity& k) { return k.name == a.joint; })->entity);
  }
  for (const sim::Entity joint : joints_) {
    first_number<components::JointPosition>(joint, ecm);
    first_number<components::JointVelocity>(joint, ecm);
  }
  tree_ = std::make_unique<EntityTree>(model_, joints_, ecm);
}

void SimRobot::PreUpdate(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
  if (!robot_) return;
  if (!ecm.HasEntity(model_)) {  // removed: gz-sim keeps the system
    robot_.reset();
    return;
  }
  if (info.paused || info.dt.count() <= 0) return;  // a negative step is a seek
  if (steps_to_refresh_-- <= 0) {
    tree_->update(ecm);
    steps_to_refresh_ = kRefreshSteps - 1;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    robot_->in()[i] = {first_number<components::JointPosition>(joints_[i], ecm),
                       first_number<components::JointVelocity>(joints_[i], ecm), tree_->inverse(i)};
  }
  robot_->step(std::chrono::duration_cast<std::chrono::nanoseconds>(info.dt).count());
  for (std::size_t i = 0; i < joints_.size(); ++i) set_force(joints_[i], robot_->torques()[i], ecm);
}

void SimRobot::PostUpdate(const sim::UpdateInfo& info, const sim::EntityComponentManager&) {
  if (!robot_) return;
  const auto time_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(info.simTime).count();
  if (info.paused) {
    robot_->publish_paused(time_ns);
  } else {
    robot_->publish_step(time_ns);
  }
}

#ifdef VSA_HAS_RESET
void SimRobot::Reset(const sim::UpdateInfo&, sim::EntityComponentManager&) {
  if (robot_) robot_->reset();
  steps_to_refresh_ = 0;
}
#endif

}  // namespace vsa::plugins
