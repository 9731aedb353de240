// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "robot_plugin.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "vsa/errors.hpp"

namespace vsa::plugins {
namespace {

using gazebo::physics::Base;
using gazebo::physics::JointPtr;
using gazebo::physics::ModelPtr;

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
  robot_ =
      std::make_unique<AttachedRobot>(attachment, [](const std::string& line) { gzwarn << "vsa::Robot: " << line << std::endl; });
  for (const host::ActuatorConfig& a : robot_->config().actuators) {
    joints_.push_back(std::find_if(known.begin(), known.end(), [&](const NamedJoint& k) { return k.name == a.joint; })->joint);
  }
  connection_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo& info) { update(info); });
}

void ClassicRobot::update(const gazebo::common::UpdateInfo& info) {
  if (info.worldName != model_->GetWorld()->Name()) return;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    robot_->in()[i] = {joints_[i]->Position(0), joints_[i]->GetVelocity(0), std::nullopt};
  }
  robot_->step(std::llround(model_->GetWorld()->Physics()->GetMaxStepSize() * 1e9));
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i]->SetForce(0, robot_->torques()[i]);
  // Gazebo has counted this step already.
  robot_->publish_step(info.simTime.sec * std::int64_t{1'000'000'000} + info.simTime.nsec);
}

void ClassicRobot::Reset() {
  if (robot_) robot_->reset();
}

GZ_REGISTER_MODEL_PLUGIN(ClassicRobot)

}  // namespace vsa::plugins
