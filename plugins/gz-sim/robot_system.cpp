// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "robot_system.hpp"

#include <chrono>
#include <utility>

#include "entities.hpp"
#include "joint_components.hpp"
#include "model_links.hpp"
#include "vsa/errors.hpp"
#include "vsa/topics/ignition_transport.hpp"

namespace vsa::plugins {

namespace components = sim::components;

void SimRobot::Configure(const sim::Entity& entity, const std::shared_ptr<const sdf::Element>& element,
                         sim::EntityComponentManager& ecm, sim::EventManager&) {
  model_ = entity;
  ecm_ = &ecm;
  name_ = sim::scopedName(entity, ecm, "::", false);
  // A model that is being spawned has no world above it yet.
  const auto world = name_.find("::");
  if (world != std::string::npos && sim::worldEntity(entity, ecm) != sim::kNullEntity) name_.erase(0, world + 2);
  try {
    attach(*element, ecm);
  } catch (const InputError& error) {
    watch_.reset();
    seat_.reset();
    const std::string text = name_ + " stays without torques:\n" + error.what();
    VSA_ERROR << "vsa::Robot: " << text << std::endl;
  }
}

void SimRobot::attach(const sdf::Element& element, sim::EntityComponentManager& ecm) {
  std::vector<NamedEntity> known;
  seat::Model model{element.ToString(""), name_, name_, {}};
  for (const NamedEntity& joint : entities_below<components::Joint>(model_, ecm)) {
    if (!has_one_axis(joint.entity, ecm)) continue;
    known.push_back(joint);
    model.joints.push_back({joint.name, {&ecm, joint.entity}, {}, {}, slides(joint.entity, ecm)});
  }
  seat::Options options;
  options.report = [](const std::string& line) { VSA_WARNING << "vsa::Robot: " << line << std::endl; };
  seat_ = std::make_unique<seat::Seat>(model, options);
  seat_->open_ports();
  seat_->connect(std::make_shared<topics::IgnitionTransport>());
  for (const std::size_t j : seat_->joints()) joints_.push_back(known[j].entity);
  for (const sim::Entity joint : joints_) {
    first_number<components::JointPosition>(joint, ecm);
    first_number<components::JointVelocity>(joint, ecm);
  }
  watch_ = ModelWatch::make(
      name_, world_name(ecm), world_step_s(ecm), *seat_, [&] { return model_links(model_, name_, ecm); }, options.report);
  robots_ = ModelRobots::of({&ecm, sim::topLevelModel(model_, ecm)});
  robots_->add(*this);
}

void SimRobot::leave() {
  if (seat_) robots_->remove(*this);
  watch_.reset();
  seat_.reset();
}

void SimRobot::PreUpdate(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
  if (!seat_) return;
  if (!ecm.HasEntity(model_)) {  // removed: Fortress keeps the system
    leave();
    return;
  }
#ifdef VSA_HAS_PARAMETERS
  faults_.look(*seat_);
#endif
  const auto time_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(info.simTime).count();
  let_go();
  if (info.paused) {
    seat_->publish_paused(time_ns);
    if (watch_) watch_->paused();
    return;
  }
  const auto dt_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(info.dt).count();
  if (dt_ns > 0) last_dt_ns_ = dt_ns;
  if (last_dt_ns_ == 0) return;
  robots_->step(*this, time_ns, last_dt_ns_);
  seat_->publish_step(time_ns);
}

std::unique_ptr<LinkTrees> SimRobot::link_trees(Links links, const Joints& driven) {
  return std::make_unique<EntityTree>(links == Links::of_own_model ? model_ : sim::topLevelModel(model_, *ecm_), driven, *ecm_);
}

/// Joints that went with a model nested in this one: from then on their units hold shafts that stand where those were.
void SimRobot::let_go() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i] == sim::kNullEntity || ecm_->HasEntity(joints_[i])) continue;
    joints_[i] = sim::kNullEntity;
    seat_->in()[i].speed_rad_per_s = 0;
    robots_->find_anew();
    const std::string text = name_ + ": the joint of its actuator '" + seat_->robot().config().actuators[i].name +
                             "' went with its model; the others go on";
    VSA_ERROR << "vsa::Robot: " << text << std::endl;
  }
}

void SimRobot::tell(std::int64_t time_ns) {
  if (!ecm_->HasEntity(model_)) return;  // it will learn of it when it is called itself
  if (steps_ <= kPhysicsSteps && steps_++ == kPhysicsSteps && !any_filled<components::JointPosition>(joints_, *ecm_))
    VSA_ERROR << "vsa::Robot: " << name_ + kNoPhysics << std::endl;  // in one piece: colours go around each
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!ecm_->HasEntity(joints_[i])) continue;  // components of what is gone are errors on the log
    seat_->in()[i].angle_rad = first_number<components::JointPosition>(joints_[i], *ecm_);
    seat_->in()[i].speed_rad_per_s = first_number<components::JointVelocity>(joints_[i], *ecm_);
  }
  if (watch_) watch_->before_step(time_ns - last_dt_ns_);
}

void SimRobot::apply() {
  if (!ecm_->HasEntity(model_)) return;
  if (!std::exchange(told_stopped_, seat_->stopped()) && told_stopped_) {  // the reason is a warning, which isn't shown unasked
    const std::string text = name_ + ": its actuators have stopped and give no torque; -v 2 shows why";
    VSA_ERROR << "vsa::Robot: " << text << std::endl;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (ecm_->HasEntity(joints_[i])) set_force(joints_[i], seat_->torques()[i], *ecm_);
}

#ifdef VSA_HAS_PARAMETERS
void SimRobot::ConfigureParameters(gz::transport::parameters::ParametersRegistry& registry, sim::EntityComponentManager&) {
  if (seat_) faults_.declare(registry, name_);
}
#endif

#ifdef VSA_HAS_RESET
void SimRobot::Reset(const sim::UpdateInfo&, sim::EntityComponentManager&) {
  if (seat_) {
    seat_->reset();
    robots_->forget();
  }
  faults_.reset();
  steps_ = 0;
}
#endif

}  // namespace vsa::plugins
