// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "entities.hpp"
#include "joint_components.hpp"
#include "model_links.hpp"
#include "robot_system.hpp"

namespace vsa::plugins {
namespace {

using host::TreeBody;
namespace components = sim::components;

std::array<double, 3> array(const math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

std::optional<TreeBody::Joint> kind(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::FIXED:
      return TreeBody::Joint::fixed;
    case sdf::JointType::REVOLUTE:
    case sdf::JointType::CONTINUOUS:
      return TreeBody::Joint::revolute;
    case sdf::JointType::PRISMATIC:
      return TreeBody::Joint::prismatic;
    default:
      return std::nullopt;
  }
}

/// Whether gravity pulls at a link: where the physics asks for that at all.
bool falls([[maybe_unused]] sim::Entity link, [[maybe_unused]] const sim::EntityComponentManager& ecm) {
#ifdef VSA_HAS_LINK_GRAVITY
  return ecm.ComponentData<components::GravityEnabled>(link).value_or(true);
#else
  return true;
#endif
}

/// What an actuator has whose joint is gone: no other joint feels it.
constexpr TreeBody kNobody{.joint = TreeBody::Joint::revolute, .axis = {0, 0, 1}, .inertia_kgm2 = {1, 0, 0, 0, 1, 0, 0, 0, 1}};

/// The link that a joint names, seen from the joint's own model; null: the world, or unknown.
sim::Entity named_link(sim::Entity joint, const std::string& name, const sim::EntityComponentManager& ecm) {
  const auto found = sim::entitiesFromScopedName(name, ecm, ecm.ParentEntity(joint));
  return found.empty() ? sim::kNullEntity : *found.begin();
}

}  // namespace

EntityTree::EntityTree(sim::Entity model, const ModelRobot::Joints& driven, sim::EntityComponentManager& ecm)
    : ecm_(ecm), driven_(driven) {
  std::vector<sim::Entity> links, joints;
  for (const NamedEntity& e : entities_below<components::Link>(model, ecm)) links.push_back(e.entity);
  for (const NamedEntity& e : entities_below<components::Joint>(model, ecm)) joints.push_back(e.entity);
  std::vector<TreeBody> bodies;
  if (!build(links, joints, bodies)) return;
  std::vector<std::size_t> body_of;
  for (const sim::Entity joint : driven) {
    if (joint == sim::kNullEntity) {
      body_of.push_back(bodies.size());
      bodies.push_back(kNobody);
      continue;
    }
    const auto at = std::find_if(items_.begin(), items_.end(), [&](const Item& item) { return item.joint == joint; });
    if (at == items_.end()) return;
    body_of.push_back(static_cast<std::size_t>(at - items_.begin()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool moves = bodies[i].joint == TreeBody::Joint::revolute || bodies[i].joint == TreeBody::Joint::prismatic;
    if (moves && std::find(body_of.begin(), body_of.end(), i) == body_of.end()) passive_.push_back(i);
  }
  tree_ = seat::DrivenTree(std::move(bodies), std::move(body_of));
  feel();  // so that the physics fills their components from now on
}

/// Parents first. False: no tree.
bool EntityTree::build(const std::vector<sim::Entity>& links, const std::vector<sim::Entity>& joints,
                       std::vector<TreeBody>& bodies) {
  struct Waiting {
    Item item;
    TreeBody body;
    sim::Entity parent = sim::kNullEntity;
  };
  std::vector<Waiting> waiting(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) waiting[i].item.link = links[i];
  for (const sim::Entity joint : joints) {
    const auto child = ecm_.ComponentData<components::ChildLinkName>(joint);
    const auto parent = ecm_.ComponentData<components::ParentLinkName>(joint);
    const auto type = ecm_.ComponentData<components::JointType>(joint);
    if (!child || !parent || !type || !kind(*type)) return false;
    const sim::Entity link = named_link(joint, *child, ecm_);
    if (link == sim::kNullEntity) continue;  // it went with its model
    const auto at = std::find_if(waiting.begin(), waiting.end(), [&](const Waiting& w) { return w.item.link == link; });
    if (at == waiting.end() || at->item.joint != sim::kNullEntity) return false;  // another model's link, or a loop
    at->item.joint = joint;
    at->item.joint_pose = ecm_.ComponentData<components::Pose>(joint).value_or(math::Pose3d::Zero);
    const auto axis = ecm_.ComponentData<components::JointAxis>(joint).value_or(sdf::JointAxis());
    at->item.axis = axis.Xyz();
    at->body.damping = axis.Damping();
    at->body.stiffness = axis.SpringStiffness();
    at->body.joint = *kind(*type);
    at->parent = *parent == "world" ? sim::kNullEntity : named_link(joint, *parent, ecm_);
    if (*parent != "world" && at->parent == sim::kNullEntity) return false;
  }
  while (!waiting.empty()) {
    const auto next = std::find_if(waiting.begin(), waiting.end(), [&](Waiting& w) {
      if (w.parent == sim::kNullEntity) return true;
      const auto at = std::find_if(items_.begin(), items_.end(), [&](const Item& item) { return item.link == w.parent; });
      w.body.parent = static_cast<std::size_t>(at - items_.begin());
      return at != items_.end();
    });
    if (next == waiting.end()) return false;
    items_.push_back(next->item);
    bodies.push_back(next->body);
    waiting.erase(next);
  }
  return true;
}

void EntityTree::look() {
  const double dt_s = world_step_s(ecm_);
  const math::Vector3d gravity = world_gravity(ecm_);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const auto* inertial = ecm_.Component<components::Inertial>(items_[i].link);
    if (inertial == nullptr) continue;
    const math::Pose3d link = sim::worldPose(items_[i].link, ecm_);
    const math::Pose3d center = link * inertial->Data().Pose();
    const math::Matrix3d turn(center.Rot());
    const math::Matrix3d inertia = turn * inertial->Data().MassMatrix().Moi() * turn.Transposed();
    TreeBody& body = tree_.bodies()[i];
    for (unsigned r = 0; r < 3; ++r) {
      for (unsigned c = 0; c < 3; ++c) body.inertia_kgm2[3 * r + c] = inertia(r, c);
    }
    body.mass_kg = inertial->Data().MassMatrix().Mass();
    body.center_of_mass = array(center.Pos());
    const math::Pose3d joint = link * items_[i].joint_pose;
    body.axis = array(joint.Rot().RotateVector(items_[i].axis));
    body.anchor = array(joint.Pos());
    body.weight_N = array(falls(items_[i].link, ecm_) ? body.mass_kg * gravity : math::Vector3d::Zero);
    body.implicit_s = dt_s;  // DART takes springs and dampers so
  }
  tree_.update();
}

void EntityTree::feel() {
  for (const std::size_t i : passive_) {
    if (!ecm_.HasEntity(items_[i].joint)) continue;  // components of what is gone are errors on the log
    tree_.positions()[i] = first_number<components::JointPosition>(items_[i].joint, ecm_);
    tree_.speeds()[i] = first_number<components::JointVelocity>(items_[i].joint, ecm_);
  }
}

/// A robot that goes has its neighbours' trees found anew by itself, when it is called.
bool EntityTree::are_there() const {
  const auto gone = [this](sim::Entity e) { return !ecm_.HasEntity(e); };
  if (std::any_of(driven_.begin(), driven_.end(), [&](sim::Entity e) { return e != sim::kNullEntity && gone(e); })) return true;
  return std::none_of(items_.begin(), items_.end(), [&](const Item& item) { return gone(item.link); });
}

}  // namespace vsa::plugins
