// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "robot_system.hpp"

#include <algorithm>
#include <utility>

#include "entities.hpp"
#include "vsa/errors.hpp"
#ifdef VSA_HAS_PARAMETERS
#include <gz/msgs/stringmsg.pb.h>
#endif

namespace vsa::plugins {
namespace {

namespace components = sim::components;
#ifdef VSA_HAS_PARAMETERS
using gz::msgs::StringMsg;
#endif

constexpr int kParameterRounds = 50;
constexpr int kPhysicsSteps = 10;  // by then any physics has filled the joints' components

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
  name_ = sim::scopedName(entity, ecm, "::", false);
  // A model that is being spawned has no world above it yet.
  const auto world = name_.find("::");
  if (world != std::string::npos && sim::worldEntity(entity, ecm) != sim::kNullEntity) name_.erase(0, world + 2);
  try {
    attach(*element, ecm);
  } catch (const InputError& error) {
    robot_.reset();
    const std::string text = name_ + " stays without torques:\n" + error.what();
    VSA_ERROR << "vsa::Robot: " << text << std::endl;
  }
}

void SimRobot::attach(const sdf::Element& element, sim::EntityComponentManager& ecm) {
  std::vector<NamedEntity> known;
  Attachment attachment{element.ToString(""), name_, name_, {}};
  for (const NamedEntity& joint : entities_below<components::Joint>(model_, ecm)) {
    if (!has_one_axis(joint.entity, ecm)) continue;
    known.push_back(joint);
    attachment.joints.push_back(joint.name);
    attachment.keys.push_back({&ecm, joint.entity});
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
  robot_->join(tree_->trees());
}

void SimRobot::PreUpdate(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
  if (!robot_) return;
  if (!ecm.HasEntity(model_)) {  // removed: Fortress keeps the system
    robot_.reset();
    tree_.reset();
    return;
  }
#ifdef VSA_HAS_PARAMETERS
  if (registry_ != nullptr && rounds_to_look_-- <= 0) look_at_parameters();
#endif
  const auto time_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(info.simTime).count();
  if (info.paused) {
    robot_->publish_paused(time_ns);
    return;
  }
  const auto dt_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(info.dt).count();
  if (dt_ns > 0) last_dt_ns_ = dt_ns;
  if (last_dt_ns_ == 0) return;
  step(last_dt_ns_, ecm);
  robot_->publish_step(time_ns);
}

void SimRobot::step(std::int64_t dt_ns, sim::EntityComponentManager& ecm) {
  if (steps_ <= kPhysicsSteps && steps_++ == kPhysicsSteps) look_for_physics(ecm);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    robot_->in()[i].angle_rad = first_number<components::JointPosition>(joints_[i], ecm);
    robot_->in()[i].speed_rad_per_s = first_number<components::JointVelocity>(joints_[i], ecm);
  }
  if (robot_->wants_mobility()) tree_->mobility(ecm, robot_->mobility());
  const bool stopped = robot_->stopped();
  robot_->step(dt_ns);
  if (robot_->stopped() && !stopped) {  // the reason is a warning, which gz-sim doesn't show unasked
    const std::string text = name_ + ": its actuators have stopped and give no torque; -v 2 shows why";
    VSA_ERROR << "vsa::Robot: " << text << std::endl;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) set_force(joints_[i], robot_->torques()[i], ecm);
}

void SimRobot::look_for_physics(const sim::EntityComponentManager& ecm) {
  for (const sim::Entity joint : joints_) {
    const auto* position = ecm.Component<components::JointPosition>(joint);
    if (position != nullptr && !position->Data().empty()) return;
  }
  const std::string text =
      name_ +
      ": no physics moves it: its world has no physics system. Up to Harmonic a world with <plugin>s of its own must name the "
      "physics among them; later ones add that of server.config, unless <gz:policies> forbids it. Into a world without any gz-sim "
      "loads it, but Fortress before 6.8 only where no model has a plug-in either.";
  VSA_ERROR << "vsa::Robot: " << text << std::endl;
}

#ifdef VSA_HAS_PARAMETERS
void SimRobot::ConfigureParameters(gz::transport::parameters::ParametersRegistry& registry, sim::EntityComponentManager&) {
  if (!robot_) return;
  parameter_ = "model." + name_ + ".vsa.faults";
  for (auto at = parameter_.find("::"); at != std::string::npos; at = parameter_.find("::")) parameter_.replace(at, 2, ".");
  // Of a model that was removed and is back, the parameter is there already.
  if (!registry.DeclareParameter(parameter_, StringMsg()) && !registry.SetParameter(parameter_, StringMsg())) return;
  registry_ = &registry;
}

void SimRobot::look_at_parameters() {
  rounds_to_look_ = kParameterRounds - 1;
  StringMsg value;
  if (!registry_->Parameter(parameter_, value) || value.data() == faults_) return;
  if (robot_->apply_faults(value.data().empty() ? "all none" : value.data(), parameter_)) {
    faults_ = value.data();
  } else {
    value.set_data(faults_);
    registry_->SetParameter(parameter_, value);
  }
}
#endif

#ifdef VSA_HAS_RESET
void SimRobot::Reset(const sim::UpdateInfo&, sim::EntityComponentManager&) {
  if (robot_) robot_->reset();
  if (registry_ != nullptr) registry_->SetParameter(parameter_, StringMsg());
  faults_.clear();  // a reset ends them
  steps_ = 0;
}
#endif

}  // namespace vsa::plugins
