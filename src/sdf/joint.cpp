// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sdf/Joint.hh>
#include <sdf/JointAxis.hh>

#include "sdf/read_context.hpp"
#include "sdf/unused.hpp"
#include "vsa/config/text.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

std::optional<Joint::Kind> kind_of(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::FIXED:
      return Joint::Kind::fixed;
    case sdf::JointType::REVOLUTE:
    case sdf::JointType::CONTINUOUS:
      return Joint::Kind::hinge;
    case sdf::JointType::PRISMATIC:
      return Joint::Kind::slide;
    case sdf::JointType::BALL:
      return Joint::Kind::ball;
    case sdf::JointType::UNIVERSAL:
      return Joint::Kind::universal;
    default:
      return std::nullopt;
  }
}

std::size_t axes_of(Joint::Kind kind) {
  return kind == Joint::Kind::universal ? 2 : kind == Joint::Kind::hinge || kind == Joint::Kind::slide ? 1 : 0;
}

/// <stiffness> and <dissipation> of a <limit>.
void read_stops(ReadContext& c, const sdf::ElementPtr& limit, const std::string& key, Axis& out) {
  for (const char* name : {"stiffness", "dissipation"}) {
    if (!child(limit, name)) continue;
    if (!c.engine.stop_springs) {
      c.notes.add("the stiffness of joint limits isn't used (the engine has its own)", key);
      continue;
    }
    const double value = c.number(limit, name, 0.0, 0.0, kInfinite, key + "/limit");
    (std::string_view(name) == "stiffness" ? out.stop_stiffness : out.stop_damping) = value;
  }
}

void read_range(ReadContext& c, const sdf::ElementPtr& element, const sdf::JointAxis& axis, const std::string& key, Axis& out) {
  const double lower = axis.Lower(), upper = axis.Upper();
  if (!take_range(c, lower, upper, c.file_of(element), key, out)) return;
  const sdf::ElementPtr limit = child(element, "limit");
  for (const char* name : {"effort", "velocity"})
    if (const sdf::ElementPtr e = child(limit, name)) tell_of_limit(c, name, e->Get<double>(), key);
  read_stops(c, limit, key, out);
}

/// Elements that libsdformat doesn't know come as text.
std::optional<double> own_number(ReadContext& c, const sdf::ElementPtr& parent, const std::string& name, const std::string& key) {
  const sdf::ElementPtr e = child(parent, "vsa:" + name) ? child(parent, "vsa:" + name) : child(parent, name);
  if (!e) return std::nullopt;
  const std::string text(config::trim(e->GetValue() ? e->GetValue()->GetAsString() : ""));
  const std::optional<double> value = config::parse_number(text);
  if (!value || std::abs(*value) > kOpenSide) {
    c.problem(e, key + "/" + name, text, "isn't a number in range", fmt::format("{} … {}", -kOpenSide, kOpenSide));
    return std::nullopt;
  }
  return value;
}

/// SDF 1.11's q = multiplier·(q_leader − reference) + offset.
void read_mimic(ReadContext& c, const sdf::ElementPtr& axis, const std::string& key, const Joint& joint) {
  const sdf::ElementPtr mimic = child(axis, "vsa:mimic");
  if (!mimic) return;
  if (!c.engine.followers) return c.cannot(mimic, key + "/mimic", "", "joints that follow others aren't", "joints of their own");
  const auto number = [&](const char* name, double fallback) {
    return own_number(c, mimic, name, key + "/mimic").value_or(fallback);
  };
  const double multiplier = number("multiplier", 1), offset = number("offset", 0), reference = number("reference", 0);
  const std::string leader = mimic->HasAttribute("joint") ? mimic->GetAttribute("joint")->GetAsString() : std::string{};
  if (mimic->HasAttribute("axis") && mimic->GetAttribute("axis")->GetAsString() != "axis")
    c.problem(mimic, key + "/mimic@axis", mimic->GetAttribute("axis")->GetAsString(), "a second axis can't lead", "axis");
  c.mimics.push_back(
      {c.file_of(mimic), joint.name, scoped_name(scope_of(joint.name), leader), multiplier, offset - multiplier * reference});
}

void read_axis(ReadContext& c, const sdf::Joint& joint, unsigned int index, const std::string& key, Joint& out) {
  const sdf::JointAxis* axis = joint.Axis(index);
  const std::string name = index == 0 ? "axis" : "axis2";
  if (axis == nullptr) {
    c.problem(joint.Element(), key + "/" + name, "", "is missing", "an axis for this type of joint");
    return;
  }
  Axis a;
  SdfVec3 resolved;
  const sdf::Errors errors = axis->ResolveXyz(resolved);
  const Vec3 local = resolved;
  if (!errors.empty() && c.parsed_clean) c.problem(joint.Element(), key + "/" + name + "/xyz", "", errors.front().Message());
  if (errors.empty() && (!local.IsFinite() || local.Length() < 1e-9)) {
    c.problem(joint.Element(), key + "/" + name + "/xyz", "", "has no direction", "a finite vector other than zero");
    return;
  }
  a.xyz = (out.pose.Rot() * local).Normalized();
  const sdf::ElementPtr element = child(joint.Element(), name);
  const sdf::ElementPtr dynamics = child(element, "dynamics");
  const std::string dynamics_key = key + "/" + name + "/dynamics";
  a.damping = c.number(dynamics, "damping", 0.0, 0.0, kInfinite, dynamics_key);
  a.friction = c.number(dynamics, "friction", 0.0, 0.0, kInfinite, dynamics_key);
  a.stiffness = c.number(dynamics, "spring_stiffness", 0.0, 0.0, kInfinite, dynamics_key);
  a.rest = c.number(dynamics, "spring_reference", 0.0, -kOpenSide, kOpenSide, dynamics_key);
  a.start = own_number(c, element, "initial_position", key + "/" + name);
  read_mimic(c, element, key, out);
  if (joint.Type() != sdf::JointType::CONTINUOUS) read_range(c, element, *axis, key + "/" + name, a);
  out.axes.push_back(a);
}

/// An axis that the joint hasn't. A direction alone changes nothing in a joint that has none, and exporters write one.
void tell_of_axes(ReadContext& c, const sdf::Joint& joint, std::size_t count, const std::string& key) {
  for (std::size_t i = count; i < 2; ++i) {
    const char* name = i == 0 ? "axis" : "axis2";
    const sdf::ElementPtr axis = child(joint.Element(), name);
    if (!axis) continue;
    const auto says = [&](const char* part) { return child(axis, part) && c.says_something(child(axis, part)); };
    const bool more = says("dynamics") || says("limit") || child(axis, "vsa:mimic") || child(axis, "vsa:initial_position");
    if (count > 0 || more)
      c.notes.add(fmt::format("<{}> of a {} joint is left out", name, *ReadContext::attribute(joint.Element(), "type")), key);
  }
}

/// An end of the joint: a link's index, or none for the world. False where the link isn't known.
bool find_end(ReadContext& c, const sdf::Joint& joint, bool is_child, const ModelScope& scope, std::optional<std::size_t>& out) {
  std::string name;
  const sdf::Errors errors = is_child ? joint.ResolveChildLink(name) : joint.ResolveParentLink(name);
  const std::string given = is_child ? joint.ChildLinkName() : joint.ParentLinkName();
  if (errors.empty() && name == "world") return true;
  if (errors.empty()) {
    const std::string full = scoped_name(scope.name, name);
    const auto it = std::find_if(c.out.links.begin(), c.out.links.end(), [&](const Link& l) { return l.name == full; });
    if (it != c.out.links.end()) {
      out = static_cast<std::size_t>(it - c.out.links.begin());
      return true;
    }
  }
  if (c.parsed_clean) {
    c.problem(joint.Element(), scoped_name(scope.name, joint.Name()) + (is_child ? "/child" : "/parent"), given, "no such link",
              "a link of the model, or world");
  }
  return false;
}

}  // namespace

void read_joint(ReadContext& c, const sdf::Joint& joint, const ModelScope& scope) {
  const std::string key = scoped_name(scope.name, joint.Name());
  if (scope.is_static) {
    c.notes.add("joints of static models are left out", key);
    return;
  }
  const std::optional<Joint::Kind> kind = kind_of(joint.Type());
  if (!kind || !c.engine.takes(*kind)) {
    const std::string type = joint.Element()->GetAttribute("type")->GetAsString();
    c.cannot(joint.Element(), key + "/type", type, "joint type isn't", movable(c.engine));
    return;
  }
  Joint out;
  out.kind = *kind;
  out.name = key;
  out.pose = scope.pose * c.resolve(joint.SemanticPose(), "__model__", joint.Element(), key);
  const bool ends = find_end(c, joint, false, scope, out.parent) && find_end(c, joint, true, scope, out.child);
  for (unsigned int i = 0; i < axes_of(*kind); ++i) read_axis(c, joint, i, key, out);
  tell_of_axes(c, joint, axes_of(*kind), key);
  tell_unused(c, joint.Element(), key, "joint");
  if (joint.SensorCount() > 0 || child(joint.Element(), "vsa:sensor")) c.notes.add("sensors are left out", key);
  for (sdf::ElementPtr p = child(joint.Element(), "physics"); p; p = p->GetNextElement("physics"))
    // libsdformat makes an empty one of any <gazebo reference> that names a joint.
    if (c.says_something(p)) c.notes.add("<physics> of joints is left out", key);
  if (ends && out.axes.size() == axes_of(*kind)) c.out.joints.push_back(std::move(out));
}

}  // namespace vsa::reader
