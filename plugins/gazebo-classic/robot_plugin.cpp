// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "robot_plugin.hpp"

#include <cmath>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/physics/Joint.hh>
#include <gazebo/physics/Model.hh>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/World.hh>
#include <utility>

#include "gazebo_transport.hpp"
#include "model_links.hpp"
#include "model_tree.hpp"
#include "vsa/errors.hpp"
#include "vsa/scoped_name.hpp"
#include "vsa/topics/ignition_transport.hpp"

namespace vsa::plugins {
namespace {

using gazebo::physics::Base;
using gazebo::physics::JointPtr;
using gazebo::physics::ModelPtr;

constexpr std::chrono::milliseconds kLookEvery{100};

std::int64_t nanoseconds(const gazebo::common::Time& time) { return time.sec * std::int64_t{1'000'000'000} + time.nsec; }

struct NamedJoint {
  std::string name;  ///< relative to the plug-in's model
  JointPtr joint;
};

void collect_joints(const ModelPtr& model, const std::string& scope, std::vector<NamedJoint>& out) {
  for (const JointPtr& joint : model->GetJoints()) {
    if (joint->HasType(Base::HINGE_JOINT) || joint->HasType(Base::SLIDER_JOINT))
      out.push_back({scoped_name(scope, joint->GetName()), joint});
  }
  for (const ModelPtr& nested : model->NestedModels()) collect_joints(nested, scoped_name(scope, nested->GetName()), out);
}

ModelPtr outermost(const ModelPtr& model) {
  ModelPtr out = model;
  for (auto above = model->GetParent(); above && above->HasType(Base::MODEL); above = above->GetParent())
    out = boost::dynamic_pointer_cast<gazebo::physics::Model>(above);
  return out;
}

}  // namespace

ClassicRobot::~ClassicRobot() {
  connection_.reset();
  time_reset_.reset();
  timer_.reset();
  if (!seat_) return;
  const std::lock_guard lock(robots_->mutex());
  robots_->remove(*this);
}

void ClassicRobot::Load(ModelPtr model, sdf::ElementPtr element) {
  model_ = std::move(model);
  world_ = model_->GetWorld()->Name();
  try {
    attach(element);
  } catch (const InputError& error) {
    watch_.reset();
    seat_.reset();
    gzerr << "vsa::Robot: " << model_->GetScopedName() << " stays without torques:\n" << error.what() << std::endl;
  }
}

void ClassicRobot::attach(const sdf::ElementPtr& element) {
  std::vector<NamedJoint> known;
  collect_joints(model_, "", known);
  seat::Model model{element->ToString(""), world_ + ": " + model_->GetScopedName(), model_->GetScopedName(), {}};
  for (const NamedJoint& k : known)
    model.joints.push_back({k.name, {model_->GetWorld().get(), k.joint->GetId()}, {}, {}, k.joint->HasType(Base::SLIDER_JOINT)});
  seat::Options options;
  options.report = [](const std::string& line) { gzwarn << "vsa::Robot: " << line << std::endl; };
  seat_ = std::make_unique<seat::Seat>(model, options);
  seat_->open_ports();
  seat_->connect(std::make_shared<topics::IgnitionTransport>());
  seat_->connect(std::make_shared<GazeboTransport>(world_, model.name));
  for (const std::size_t j : seat_->joints()) {
    joints_.push_back(known[j].joint);
    driven_.push_back(known[j].joint->GetId());
  }
  watch_ = ModelWatch::make(
      model.where, world_, model_->GetWorld()->Physics()->GetMaxStepSize(), *seat_, [this] { return model_links(model_); },
      options.report);
  robots_ = ModelRobots::of({model_->GetWorld().get(), outermost(model_)->GetId()});
  {
    const std::lock_guard lock(robots_->mutex());
    robots_->add(*this);
  }
  using gazebo::event::Events;
  connection_ = Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo& info) { update(info); });
  time_reset_ = Events::ConnectTimeReset([this] {  // of any world
    const std::lock_guard lock(robots_->mutex());
    now_ns_ = nanoseconds(model_->GetWorld()->SimTime());
  });
  timer_.emplace(kLookEvery, [this] { publish_where_it_stands(); });
}

void ClassicRobot::update(const gazebo::common::UpdateInfo& info) {
  if (info.worldName != world_) return;
  const std::lock_guard lock(robots_->mutex());
  stepped_ = true;
  now_ns_ = nanoseconds(info.simTime);  // Gazebo has counted this step already
  robots_->step(*this, now_ns_, step_ns());
  seat_->publish_step(now_ns_);
}

std::unique_ptr<LinkTrees> ClassicRobot::link_trees(Links links, const Joints& driven) {
  return std::make_unique<ModelTree>(links == Links::of_own_model ? model_ : outermost(model_), driven);
}

void ClassicRobot::tell(std::int64_t time_ns) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    seat_->in()[i].angle_rad = joints_[i]->Position(0);
    seat_->in()[i].speed_rad_per_s = joints_[i]->GetVelocity(0);
  }
  if (watch_) watch_->before_step(time_ns - step_ns());
}

void ClassicRobot::apply() {
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i]->SetForce(0, seat_->torques()[i]);
}

std::int64_t ClassicRobot::step_ns() const { return std::llround(model_->GetWorld()->Physics()->GetMaxStepSize() * 1e9); }

void ClassicRobot::publish_where_it_stands() {
  const std::lock_guard lock(robots_->mutex());
  if (std::exchange(stepped_, false)) return;
  seat_->publish_paused(now_ns_);
  if (watch_) watch_->paused();
}

void ClassicRobot::Reset() {
  if (!seat_) return;
  const std::lock_guard lock(robots_->mutex());
  seat_->reset();
  robots_->forget();
}

GZ_REGISTER_MODEL_PLUGIN(ClassicRobot)

}  // namespace vsa::plugins
