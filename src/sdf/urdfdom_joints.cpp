// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sdf/urdfdom_reading.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

std::optional<Joint::Kind> kind_of(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::FIXED:
      return Joint::Kind::fixed;
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      return Joint::Kind::hinge;
    case urdf::Joint::PRISMATIC:
      return Joint::Kind::slide;
    default:
      return std::nullopt;
  }
}

void read_axis(UrdfReading& r, const urdf::Joint& joint, const std::string& key, Joint& out) {
  Axis a;
  const Vec3 local(joint.axis.x, joint.axis.y, joint.axis.z);
  if (!local.IsFinite() || local.Length() < 1e-9)
    return r.problem(nullptr, key + "/axis/xyz", "", "has no direction", "a finite vector other than zero");
  a.xyz = (out.pose.Rot() * local / local.Length()).Normalized();
  if (joint.dynamics) {
    a.damping = r.in_range(joint.dynamics->damping, 0, 0, kInfinite, r.file, key + "/axis/dynamics/damping");
    a.friction = r.in_range(joint.dynamics->friction, 0, 0, kInfinite, r.file, key + "/axis/dynamics/friction");
  }
  if (joint.limits && joint.type != urdf::Joint::CONTINUOUS)
    take_range(r, joint.limits->lower, joint.limits->upper, r.file, key + "/axis", a);
  if (joint.limits) {
    tell_of_limit(r, "effort", joint.limits->effort, key + "/axis");
    tell_of_limit(r, "velocity", joint.limits->velocity, key + "/axis");
  }
  read_gazebo_joint(r, joint.name, key, &a);
  out.axes.push_back(a);
}

/// A fixed joint that <disableFixedJointLumping> keeps is, as libsdformat has it, a revolute one without room.
bool without_room(const UrdfReading& r, const std::string& joint) {
  const auto of = r.extensions.find(joint);
  bool kept = false;
  if (of == r.extensions.end()) return kept;
  for (const tinyxml2::XMLElement* gazebo : of->second) {
    const auto says = [&](const char* name) {
      for (const auto* e = r.child(gazebo, name); e != nullptr; e = e->NextSiblingElement(name))
        if (r.flag(e)) return true;
      return false;
    };
    if (says("preserveFixedJoint")) return false;
    kept = kept || says("disableFixedJointLumping");
  }
  return kept;
}

}  // namespace

void read_urdf_joint(UrdfReading& r, const UrdfLump& lump, const ModelScope& scope, std::size_t link) {
  const auto& joint = lump.parts.front().link->parent_joint;
  if (!joint) return;
  const std::string key = scoped_name(scope.name, joint->name);
  if (scope.is_static) return r.notes.add("joints of static models are left out", key);
  const std::optional<Joint::Kind> kind = kind_of(*joint);
  if (!kind || !r.engine.takes(*kind)) return r.cannot(nullptr, key + "/type", "", "joint type isn't", movable(r.engine));
  Joint out;
  out.kind = *kind;
  out.name = key;
  out.pose = lump.pose;
  out.parent = lump.parent;
  out.child = link;
  if (out.kind != Joint::Kind::fixed) {
    read_axis(r, *joint, key, out);
    if (out.axes.empty()) return;
  } else if (without_room(r, joint->name)) {
    out.kind = Joint::Kind::hinge;
    Axis a;
    a.xyz = out.pose.Rot() * Vec3(0, 0, 1);
    a.range = {{0, 0}};
    read_gazebo_joint(r, joint->name, key, &a);
    out.axes.push_back(a);
  } else {
    read_gazebo_joint(r, joint->name, key, nullptr);
  }
  r.out.joints.push_back(std::move(out));
}

}  // namespace vsa::reader
