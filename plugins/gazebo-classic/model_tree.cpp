// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "model_tree.hpp"

#include <algorithm>
#include <cmath>
#include <gazebo/physics/Inertial.hh>
#include <gazebo/physics/Joint.hh>
#include <gazebo/physics/Link.hh>
#include <gazebo/physics/Model.hh>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/World.hh>
#include <gazebo/physics/ode/ODEJoint.hh>
#include <utility>

#include "model_links.hpp"

namespace vsa::plugins {
namespace {

using gazebo::physics::Base;
using gazebo::physics::JointPtr;
using gazebo::physics::LinkPtr;
using gazebo::physics::ModelPtr;
using host::TreeBody;

std::array<double, 3> array(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

std::optional<TreeBody::Joint> kind(const JointPtr& joint) {
  if (!joint) return TreeBody::Joint::free;
  if (joint->HasType(Base::FIXED_JOINT)) return TreeBody::Joint::fixed;
  if (joint->HasType(Base::HINGE_JOINT)) return TreeBody::Joint::revolute;
  if (joint->HasType(Base::SLIDER_JOINT)) return TreeBody::Joint::prismatic;
  return std::nullopt;
}

bool moves(const TreeBody& body) { return body.joint == TreeBody::Joint::revolute || body.joint == TreeBody::Joint::prismatic; }

/// DART takes every spring and damper so, ODE those of joints that say <implicit_spring_damper>. Any other is of the angle and speed at
/// a step's start, a torque like gravity's, and isn't in B.
bool takes_implicitly(const JointPtr& joint) {
  if (const auto ode = boost::dynamic_pointer_cast<gazebo::physics::ODEJoint>(joint)) return ode->UsesImplicitSpringDamper();
  return joint->GetWorld()->Physics()->GetType() == "dart";
}

}  // namespace

ModelTree::ModelTree(const ModelPtr& model, const ModelRobot::Joints& driven) {
  std::vector<TreeBody> bodies;
  if (!build(all_links(model), bodies)) return;
  std::vector<std::size_t> body_of;
  for (const std::uint64_t id : driven) {
    const auto at =
        std::find_if(items_.begin(), items_.end(), [&](const Item& item) { return item.joint && item.joint->GetId() == id; });
    if (at == items_.end()) return;
    body_of.push_back(static_cast<std::size_t>(at - items_.begin()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (moves(bodies[i]) && std::find(body_of.begin(), body_of.end(), i) == body_of.end()) passive_.push_back(i);
  tree_ = seat::DrivenTree(std::move(bodies), std::move(body_of));
}

/// Parents first. False: no tree.
bool ModelTree::build(const std::vector<LinkPtr>& links, std::vector<TreeBody>& bodies) {
  std::vector<LinkPtr> waiting = links;
  while (!waiting.empty()) {
    const std::size_t before = waiting.size();
    for (auto it = waiting.begin(); it != waiting.end();) {
      const auto joints = (*it)->GetParentJoints();
      if (joints.size() > 1) return false;
      const JointPtr joint = joints.empty() ? nullptr : joints.front();
      const auto type = kind(joint);
      if (!type) return false;
      TreeBody body;
      body.joint = *type;
      const LinkPtr parent = joint ? joint->GetParent() : nullptr;
      if (parent) {
        const auto at = std::find_if(items_.begin(), items_.end(), [&](const Item& item) { return item.link == parent; });
        if (at == items_.end()) {
          ++it;  // its turn comes after its parent's
          continue;
        }
        body.parent = static_cast<std::size_t>(at - items_.begin());
      }
      items_.push_back({*it, joint, {}, {}, {}, {}, false});
      bodies.push_back(body);
      it = waiting.erase(it);
    }
    if (waiting.size() == before) return false;  // a loop, or a parent in another model
  }
  return true;
}

/// An axis keeps its place in its link, so what it is there is asked for once, when the model stands.
void ModelTree::read_joint(Item& item, TreeBody& body) {
  if (!moves(body)) return;
  const auto& pose = item.link->WorldPose();
  item.axis = pose.Rot().RotateVectorReverse(item.joint->GlobalAxis(0));
  item.anchor = pose.Rot().RotateVectorReverse(item.joint->WorldPose().Pos() - pose.Pos());
  body.damping = std::abs(item.joint->GetDamping(0));  // ODE takes its size, a sign only asks for more of it
  body.stiffness = item.joint->GetStiffness(0);
  item.implicit = takes_implicitly(item.joint);
}

void ModelTree::read_inertia(Item& item, TreeBody& body) {
  const auto inertial = item.link->GetInertial();
  body.mass_kg = inertial->Mass();
  item.center = inertial->CoG();
  item.inertia = inertial->MOI({item.center, ignition::math::Quaterniond::Identity});
}

void ModelTree::look() {
  std::vector<TreeBody>& bodies = tree_.bodies();
  for (std::size_t i = 0; i < items_.size() && !read_; ++i) {
    read_joint(items_[i], bodies[i]);
    read_inertia(items_[i], bodies[i]);
  }
  read_ = true;
  if (items_.empty()) return;
  // Somebody may give a link another mass while it runs: one of them is looked at each time.
  next_ = (next_ + 1) % items_.size();
  read_inertia(items_[next_], bodies[next_]);
  const auto world = items_.front().link->GetWorld();
  const double dt_s = world->Physics()->GetMaxStepSize();
  const auto gravity = world->Gravity();
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    TreeBody& body = bodies[i];
    const auto& pose = item.link->WorldPose();
    const ignition::math::Matrix3d turned(pose.Rot());
    const auto inertia = turned * item.inertia * turned.Transposed();
    for (unsigned r = 0; r < 3; ++r) {
      for (unsigned c = 0; c < 3; ++c) body.inertia_kgm2[3 * r + c] = inertia(r, c);
    }
    body.center_of_mass = array(pose.Pos() + turned * item.center);
    body.weight_N = array(item.link->GetGravityMode() ? body.mass_kg * gravity : ignition::math::Vector3d::Zero);
    if (!moves(body)) continue;
    body.axis = array(turned * item.axis);
    body.anchor = array(pose.Pos() + turned * item.anchor);
    body.implicit_s = item.implicit ? dt_s : 0;
  }
  tree_.update();
}

void ModelTree::feel() {
  for (const std::size_t i : passive_) {
    tree_.positions()[i] = items_[i].joint->Position(0);
    tree_.speeds()[i] = items_[i].joint->GetVelocity(0);
  }
}

}  // namespace vsa::plugins
