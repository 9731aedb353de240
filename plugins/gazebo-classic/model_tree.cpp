// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "model_tree.hpp"

#include <algorithm>
#include <cmath>
#include <gazebo/physics/Inertial.hh>
#include <gazebo/physics/Joint.hh>
#include <gazebo/physics/Link.hh>
#include <gazebo/physics/Model.hh>
#include <utility>

namespace vsa::plugins {
namespace {

using gazebo::physics::Base;
using gazebo::physics::JointPtr;
using gazebo::physics::LinkPtr;
using gazebo::physics::ModelPtr;
using host::TreeBody;

std::array<double, 3> array(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

void collect_links(const ModelPtr& model, std::vector<LinkPtr>& out) {
  for (const LinkPtr& link : model->GetLinks()) out.push_back(link);
  for (const ModelPtr& nested : model->NestedModels()) collect_links(nested, out);
}

std::optional<TreeBody::Joint> kind(const JointPtr& joint) {
  if (!joint) return TreeBody::Joint::free;
  if (joint->HasType(Base::FIXED_JOINT)) return TreeBody::Joint::fixed;
  if (joint->HasType(Base::HINGE_JOINT)) return TreeBody::Joint::revolute;
  if (joint->HasType(Base::SLIDER_JOINT)) return TreeBody::Joint::prismatic;
  return std::nullopt;
}

}  // namespace

ModelTree::ModelTree(const ModelPtr& model, const std::vector<JointPtr>& driven) {
  std::vector<LinkPtr> links;
  collect_links(model, links);
  std::vector<TreeBody> bodies;
  if (!build(links, bodies)) return;
  std::vector<std::size_t> body_of;
  for (const JointPtr& joint : driven) {
    const auto at = std::find_if(items_.begin(), items_.end(), [&](const Item& item) { return item.joint == joint; });
    if (at == items_.end()) return;
    body_of.push_back(static_cast<std::size_t>(at - items_.begin()));
  }
  tree_ = DrivenTree(std::move(bodies), std::move(body_of));
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
      items_.push_back({*it, joint});
      bodies.push_back(body);
      it = waiting.erase(it);
    }
    if (waiting.size() == before) return false;  // a loop, or a parent in another model
  }
  return true;
}

void ModelTree::mobility(std::span<double> out) {
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const LinkPtr& link = items_[i].link;
    TreeBody& body = tree_.bodies()[i];
    const auto inertia = link->WorldInertiaMatrix();
    for (unsigned r = 0; r < 3; ++r) {
      for (unsigned c = 0; c < 3; ++c) body.inertia_kgm2[3 * r + c] = inertia(r, c);
    }
    body.mass_kg = link->GetInertial()->Mass();
    body.center_of_mass = array(link->WorldInertialPose().Pos());
    if (body.joint != TreeBody::Joint::revolute && body.joint != TreeBody::Joint::prismatic) continue;
    body.axis = array(items_[i].joint->GlobalAxis(0));
    body.anchor = array(items_[i].joint->WorldPose().Pos());
  }
  tree_.mobility(out);
}

}  // namespace vsa::plugins
