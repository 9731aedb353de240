// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Names, handles and references of a World, and whose they are.
#include <fmt/format.h>

#include <algorithm>

#include "engine/world_check.hpp"
#include "engine/world_impl.hpp"
#include "vsa/host/topics.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::engine {
namespace {

using description::Axis;
using description::Joint;
using description::Link;

JointInfo info_of(const Joint& joint) {
  using Type = JointInfo::Type;
  JointInfo info;
  info.name = joint.name;
  switch (joint.kind) {
    case Joint::Kind::fixed:
      break;
    case Joint::Kind::hinge:
      info.type = Type::revolute;
      break;
    case Joint::Kind::slide:
      info.type = Type::prismatic;
      break;
    case Joint::Kind::ball:
      info.type = Type::ball;
      break;
    case Joint::Kind::universal:
      info.type = Type::universal;
      break;
  }
  info.held = joint.held;
  info.pulled = joint.pulled;
  info.closes_loop = joint.closes;
  if (!joint.one_axis()) return info;
  const Axis& axis = joint.axes.front();
  info.range = axis.range;
  info.damping = axis.damping;
  info.stiffness = axis.stiffness;
  info.rest = axis.rest;
  info.dry_friction = axis.friction;
  return info;
}

/// The nearest of those there are, for the message: all.
[[noreturn]] void unknown(const char* key, std::string_view name, const char* message,
                          const std::map<std::string, std::size_t, std::less<>>& there) {
  std::vector<std::string> names;
  for (const auto& [known, index] : there)
    if (index != WorldNames::kSeveral) names.push_back(known);
  throw InputError(Problem{"", key, std::string(name), message, list(std::move(names))});
}

/// joint_2 before joint_10: where both have a number at the same place, the longer number is the larger.
bool counted_before(const std::string& a, const std::string& b) {
  const auto digit = [](const std::string& s, std::size_t i) { return i < s.size() && s[i] >= '0' && s[i] <= '9'; };
  std::size_t same = 0;
  while (same < a.size() && same < b.size() && a[same] == b[same]) ++same;
  std::size_t a_end = same, b_end = same;
  while (digit(a, a_end)) ++a_end;
  while (digit(b, b_end)) ++b_end;
  const bool both = a_end > same && b_end > same, within = same > 0 && digit(a, same - 1) && (a_end > same || b_end > same);
  if ((both || within) && a_end != b_end) return a_end < b_end;
  return a < b;
}

void hash(std::uint32_t& sum, std::string_view text) {
  constexpr std::uint32_t kPrime = 16777619;  // FNV-1a
  for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * kPrime;
  sum *= kPrime;
}

[[noreturn]] void foreign(const char* what, const std::string& theirs, const std::string& ours) {
  throw InputError(Problem{"", what, theirs, "another world's", ours});
}

std::string text(const Link& l) {
  const auto& i = l.inertia;
  const auto& at = l.pose.Pos();
  return fmt::format("link {}: {} kg, centre {} {} {}, moments {} {} {} kg·m², at {} {} {}, {} shapes{}", l.name, l.mass, l.com.X(),
                     l.com.Y(), l.com.Z(), i(0, 0), i(1, 1), i(2, 2), at.X(), at.Y(), at.Z(), l.collisions.size(),
                     l.is_static ? ", static" : "");
}
std::string text(const Joint& j) {
  return fmt::format("joint {}: kind {}, links {} and {}", j.name, static_cast<int>(j.kind), j.parent.value_or(0),
                     j.child.value_or(0));
}

bool same(const Link& a, const Link& b) {
  const bool same_mass = a.mass == b.mass && alike(a.com, b.com) && alike(a.inertia, b.inertia);
  return a.name == b.name && a.is_static == b.is_static && (a.is_static || same_mass) && alike(a.pose, b.pose) &&
         a.collisions.size() == b.collisions.size();
}
/// Where a joint moves something: its own frame's rotation is a matter of the file.
bool same(const Joint& a, const Joint& b) {
  const auto same_axis = [](const Axis& x, const Axis& y) {
    return description::alike(x.xyz, y.xyz) && x.range == y.range && x.rest == y.rest;
  };
  const bool same_place = a.kind == Joint::Kind::fixed || alike(a.pose.Pos(), b.pose.Pos());
  return a.name == b.name && a.kind == b.kind && a.closes == b.closes && a.parent == b.parent && a.child == b.child && same_place &&
         std::equal(a.axes.begin(), a.axes.end(), b.axes.begin(), b.axes.end(), same_axis);
}

template <class Part>
void check_parts(const char* what, const char* parts, const std::vector<Part>& theirs, const std::vector<Part>& ours) {
  if (theirs.size() != ours.size()) foreign(what, fmt::format("{} {}", theirs.size(), parts), fmt::format("{}", ours.size()));
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (!same(theirs[i], ours[i])) foreign(what, text(theirs[i]), text(ours[i]));
}

}  // namespace

std::string list(std::vector<std::string> names) {
  std::sort(names.begin(), names.end(), counted_before);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

std::uint32_t tag_of(const description::World& world) {
  std::uint32_t sum = 2166136261;
  for (const Link& l : world.links) hash(sum, l.name);
  for (const Joint& j : world.joints) {
    hash(sum, j.name);
    sum += static_cast<std::uint32_t>(j.kind);
  }
  return std::max<std::uint32_t>(sum, 1);
}

void check_same_world(const char* what, const description::World& theirs, const description::World& ours) {
  if (&theirs == &ours) return;
  check_parts(what, "links", theirs.links, ours.links);
  check_parts(what, "joints", theirs.joints, ours.joints);
}

void World::Impl::check(const Snapshot& s) const {
  check_same_world("snapshot", *s.world, *world);
  if (s.robots.size() != robots.size())
    foreign("snapshot", fmt::format("{} robots", s.robots.size()), fmt::format("{}", robots.size()));
  for (std::size_t i = 0; i < robots.size(); ++i) robots[i].seat->check(*s.robots[i]);
}

void World::Impl::index_names() {
  auto made = std::make_shared<WorldNames>();
  made->tag = tag_of(*world);
  for (std::size_t j = 0; j < world->joints.size(); ++j) {
    made->joints.push_back(info_of(world->joints[j]));
    made->joints.back().dof = physics->joint_dof(j);
    if (world->joints[j].one_axis()) made->joint.emplace(world->joints[j].name, j);
  }
  for (const description::Coupling& c : world->couplings) made->joints[c.follower].follows = c.leader;
  for (std::size_t l = 0; l < world->links.size(); ++l) made->link.emplace(world->links[l].name, l);
  made->first_actuator.resize(robots.size());
  for (std::size_t a = 0; a < actuators.size(); ++a) {
    const ActuatorRef& ref = actuators[a];
    if (ref.index == 0) made->first_actuator[ref.robot] = a;
    made->joints[robots[ref.robot].joints[ref.index]].actuator = a;
    const std::string outer = ref.model + "/" + ref.name, whole = joined_by(robots[ref.robot].seat->model(), "/") + "/" + ref.name;
    const auto note = [a](auto& names_of, const std::string& name) {
      if (!names_of.emplace(name, a).second) names_of[name] = WorldNames::kSeveral;
    };
    note(made->full, outer);
    note(made->actuator, ref.name);
    if (whole != outer) made->full[whole] = a;
  }
  names = std::move(made);
}

const ActuatorRef& World::actuator(std::string_view name) const {
  const WorldNames& known = *impl_->names;
  const auto in_full = known.full.find(name), in_short = known.actuator.find(name);
  if (in_full == known.full.end() && in_short == known.actuator.end()) unknown("actuator", name, "no such actuator", known.full);
  const std::size_t index = in_full != known.full.end() ? in_full->second : in_short->second;
  if (index != WorldNames::kSeveral) return impl_->actuators[index];
  std::vector<std::string> full;
  for (const ActuatorRef& a : impl_->actuators)
    if (a.name == name || a.model + "/" + a.name == name) full.push_back(name_of(a));
  throw InputError(Problem{"", "actuator", std::string(name), "several models have it", list(std::move(full))});
}

std::string World::name_of(const ActuatorRef& ref) const {
  const WorldNames& known = *impl_->names;
  static_cast<void>(at(ref));
  if (known.actuator.at(ref.name) != WorldNames::kSeveral) return ref.name;
  std::string outer = ref.model + "/" + ref.name;
  if (known.full.at(outer) != WorldNames::kSeveral) return outer;
  return joined_by(impl_->robots[ref.robot].seat->model(), "/") + "/" + ref.name;
}

const std::vector<JointInfo>& World::joints() const { return impl_->names->joints; }

JointHandle World::joint(std::string_view scoped) const {
  const auto& known = impl_->names->joint;
  const auto it = known.find(scoped);
  if (it != known.end()) return {it->second, impl_->names->tag};
  const auto closes = [&](const JointInfo& j) { return j.closes_loop && j.name == scoped; };
  const bool closing = std::any_of(joints().begin(), joints().end(), closes);
  unknown("joint", scoped, closing ? "closes a kinematic loop and has no angle" : "no such joint with one axis", known);
}

JointHandle World::joint(const ActuatorRef& ref) const {
  static_cast<void>(at(ref));
  return {impl_->robots[ref.robot].joints[ref.index], impl_->names->tag};
}

LinkHandle World::link(std::string_view scoped) const {
  const auto& known = impl_->names->link;
  const auto it = known.find(scoped);
  if (it == known.end()) unknown("link", scoped, "no such link", known);
  return {it->second, impl_->names->tag};
}

std::size_t World::at(JointHandle joint) const {
  if (joint.tag_ != impl_->names->tag)
    throw InputError(Problem{"", "joint", fmt::format("{}", joint.index()), "the handle is of another world", "World::joint()"});
  return joint.index();
}

std::size_t World::at(LinkHandle link) const {
  if (link.tag_ != impl_->names->tag)
    throw InputError(Problem{"", "link", fmt::format("{}", link.index()), "the handle is of another world", "World::link()"});
  return link.index();
}

std::size_t World::at(const ActuatorRef& ref) const {
  const auto& robots = impl_->robots;
  if (ref.robot < robots.size() && ref.index < robots[ref.robot].joints.size()) {
    const std::size_t at = impl_->names->first_actuator[ref.robot] + ref.index;
    if (impl_->actuators[at].name == ref.name && impl_->actuators[at].model == ref.model) return at;
  }
  throw InputError(Problem{"", "actuator", ref.model + "/" + ref.name, "the reference is of another world", "one of actuators()"});
}

}  // namespace vsa::engine
