// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "robot_plugin.hpp"

#include <algorithm>
#include <cmath>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/physics/Joint.hh>
#include <gazebo/physics/Model.hh>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/World.hh>
#include <utility>

#include "vsa/errors.hpp"

namespace vsa::plugins {
namespace {

using gazebo::physics::Base;
using gazebo::physics::JointPtr;
using gazebo::physics::ModelPtr;

constexpr int kRefreshSteps = 16;  // inverse inertias only serve the robot's prediction

struct NamedJoint {
  std::string name;  ///< relative to the plug-in's model
  JointPtr joint;
};

void collect_joints(const ModelPtr& model, const std::string& prefix, std::vector<NamedJoint>& out) {
  for (const JointPtr& joint : model->GetJoints()) {
    if (joint->HasType(Base::HINGE_JOINT) || joint->HasType(Base::SLIDER_JOINT)) out.push_back({prefix + joint->GetName(), joint});
  }
  for (const ModelPtr& nested : model->NestedModels()) collect_joints(nested, prefix + nested->GetName() + "::", out);
}

}  // namespace

void ClassicRobot::Load(ModelPtr model, sdf::ElementPtr element) {
  model_ = std::move(model);
  try {
    attach(element);
  } catch (const InputError& error) {
    gzerr << "vsa::Robot: " << model_->GetScopedName() << " stays without torques:\n" << error.what() << std::endl;
  }
}

void ClassicRobot::attach(const sdf::ElementPtr& element) {
  std::vector<NamedJoint> known;
  collect_joints(model_, "", known);
  Attachment attachment{
      element->ToString(""), model_->GetWorld()->Name() + ": " + model_->GetScopedName(), model_->GetScopedName(), {}};
  for (const NamedJoint& k : known) attachment.joints.push_back(k.name);
  const auto report = [](const std::string& line) { gzwarn << "vsa::Robot: " << line << std::endl; };
  robot_ = std::make_unique<AttachedRobot>(attachment, report);
  own_port_ = std::make_unique<GazeboPort>(model_->GetWorld()->Name());
  own_topics_.emplace(robot_->robot(), attachment.model, *own_port_, report);
  for (const host::ActuatorConfig& a : robot_->config().actuators) {
    joints_.push_back(std::find_if(known.begin(), known.end(), [&](const NamedJoint& k) { return k.name == a.joint; })->joint);
  }
  tree_ = std::make_unique<ModelTree>(model_, joints_);
  connection_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo& info) { update(info); });
}

void ClassicRobot::update(const gazebo::common::UpdateInfo& info) {
  if (info.worldName != model_->GetWorld()->Name()) return;
  if (steps_to_refresh_-- <= 0) {
    tree_->update();
    steps_to_refresh_ = kRefreshSteps - 1;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    robot_->in()[i] = {joints_[i]->Position(0), joints_[i]->GetVelocity(0), tree_->inverse(i)};
  }
  robot_->step(std::llround(model_->GetWorld()->Physics()->GetMaxStepSize() * 1e9));
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i]->SetForce(0, robot_->torques()[i]);
  // Gazebo has counted this step already.
  const std::int64_t now_ns = info.simTime.sec * std::int64_t{1'000'000'000} + info.simTime.nsec;
  robot_->publish_step(now_ns);
  own_topics_->update(now_ns);
}

void ClassicRobot::Reset() {
  if (robot_) robot_->reset();
  steps_to_refresh_ = 0;
}

GZ_REGISTER_MODEL_PLUGIN(ClassicRobot)

}  // namespace vsa::plugins
