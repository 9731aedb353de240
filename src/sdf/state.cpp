// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world's <state>, as Gazebo saves it: where models stand and joints are at the start.
//
//   model/pose          moves the model
//   model/joint/angle   where a joint with one axis starts
//   model/link/pose     in the world; joints start where these poses have them, and poses that no joints reach are refused. Of a ball
//                       or two axes there is no such start: only where it closes a loop, whose other joints turn it, may it be turned
// Speeds, accelerations and forces are left out, with a warning.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sdf/World.hh>

#include "sdf/read_context.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

constexpr double kFurthest = 1e9;        // rad or m, as of an <initial_position>
constexpr double kPoseTolerance = 1e-3;  // m and rad: files hold six digits

class ModelState {
 public:
  ModelState(ReadContext& c, const sdf::ElementPtr& element, std::string name)
      : c_(c), element_(element), name_(std::move(name)), key_("state/model[" + name_ + "]") {}

  void apply() {
    const auto known = c_.model_poses.find(name_);
    if (known == c_.model_poses.end()) return problem(element_, "", "", "no such model", "a model of the world");
    if (child(element_, "model"))
      problem(element_, "/model", "", "states of nested models aren't supported", "joints of the model itself");
    if (const sdf::ElementPtr scale = child(element_, "scale"); scale && !alike(scale->Get<SdfVec3>(), Vec3::One))
      problem(scale, "/scale", scale->Get<std::string>(), "isn't supported", "1 1 1");
    if (const sdf::ElementPtr pose = child(element_, "pose"))
      if (const auto to = pose_in(pose, "")) move(*to * known->second.Inverse());
    for (sdf::ElementPtr e = child(element_, "joint"); e; e = e->GetNextElement("joint")) joint(e);
    for (sdf::ElementPtr e = child(element_, "link"); e; e = e->GetNextElement("link")) link(e);
    solve();
  }

 private:
  void problem(const sdf::ElementPtr& e, const std::string& where, std::string value, std::string message, std::string allowed) {
    c_.problem(e, key_ + where, std::move(value), std::move(message), std::move(allowed));
  }

  void move(const Pose3& by) {
    for (Link& l : c_.out.links) {
      if (is_below(l.name, name_)) l.pose = by * l.pose;
    }
    for (Joint& j : c_.out.joints) {
      if (!is_below(j.name, name_)) continue;
      j.pose = by * j.pose;
      for (Axis& a : j.axes) a.xyz = by.Rot() * a.xyz;
    }
  }

  void joint(const sdf::ElementPtr& e) {
    const std::string name = e->GetAttribute("name")->GetAsString();
    const auto it = std::find_if(c_.out.joints.begin(), c_.out.joints.end(),
                                 [&](const Joint& j) { return j.name == scoped_name(name_, name); });
    if (it == c_.out.joints.end() || !it->one_axis())
      return problem(e, "/joint[" + name + "]", "", "no such joint with one axis", "a joint of the model");
    for (sdf::ElementPtr a = child(e, "angle"); a; a = a->GetNextElement("angle")) {
      const auto angle = a->Get<double>();
      if (!(std::abs(angle) <= kFurthest))
        return problem(a, "/joint[" + name + "]/angle", fmt::format("{}", angle), "isn't a number in range",
                       fmt::format("{} … {}", -kFurthest, kFurthest));
      it->axes[0].start = angle;
    }
  }

  void link(const sdf::ElementPtr& e) {
    const std::string name = e->GetAttribute("name")->GetAsString();
    const auto it =
        std::find_if(c_.out.links.begin(), c_.out.links.end(), [&](const Link& l) { return l.name == scoped_name(name_, name); });
    if (it == c_.out.links.end()) return problem(e, "/link[" + name + "]", "", "no such link", "a link of the model");
    for (const char* left : {"velocity", "acceleration", "wrench"}) {
      if (child(e, left)) c_.notes.add("speeds, accelerations and forces of a <state> are left out", key_);
    }
    if (const sdf::ElementPtr pose = child(e, "pose"))
      if (const auto at = pose_in(pose, "/link[" + name + "]")) poses_[static_cast<std::size_t>(it - c_.out.links.begin())] = *at;
  }

  std::optional<Pose3> pose_in(const sdf::ElementPtr& e, const std::string& of) {
    const auto pose = e->Get<SdfPose3>();
    if (pose.IsFinite()) return Pose3(pose);
    problem(e, of + "/pose", "", "isn't finite", "six finite numbers");
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Pose3> pose_of(std::optional<std::size_t> link) const {
    if (!link) return Pose3();
    if (c_.out.links[*link].is_static) return c_.out.links[*link].pose;
    const auto it = poses_.find(*link);
    return it == poses_.end() ? std::nullopt : std::optional(it->second);
  }

  void solve() {
    std::vector<bool> held(c_.out.links.size(), false);
    for (Joint& j : c_.out.joints) {
      if (j.child) held[*j.child] = true;
      const std::optional<Pose3> parent = pose_of(j.parent), end = pose_of(j.child);
      if (is_below(j.name, name_) && parent && end) start_of(j, *parent, *end);
    }
    for (const auto& [l, pose] : poses_) {
      const Pose3 off = c_.out.links[l].pose.Inverse() * pose;
      if (!held[l] && distance(off) > kPoseTolerance)
        problem(element_, "/link[" + c_.out.links[l].name + "]/pose", "", "isn't where the model's pose has it",
                "a pose that fits the model's");
    }
  }

  static double distance(const Pose3& p) {
    return std::max(p.Pos().Length(), 2 * std::atan2(Vec3(p.Rot().X(), p.Rot().Y(), p.Rot().Z()).Length(), std::abs(p.Rot().W())));
  }

  void start_of(Joint& j, const Pose3& parent, const Pose3& end) {
    const Pose3 zero_parent = j.parent ? c_.out.links[*j.parent].pose : Pose3(),
                zero_child = j.child ? c_.out.links[*j.child].pose : Pose3();
    const Pose3 in_parent = zero_parent.Inverse() * j.pose;
    // What the joint does, in its own frame.
    const Pose3 turn = in_parent.Inverse() * (parent.Inverse() * end) * (zero_parent.Inverse() * zero_child).Inverse() * in_parent;
    Pose3 reached;
    double start = 0;
    if (j.one_axis()) {
      const Vec3 axis = j.pose.Rot().Inverse() * j.axes[0].xyz;
      const auto& q = turn.Rot();
      start = j.kind == Joint::Kind::slide
                  ? turn.Pos().Dot(axis)
                  : std::remainder(2 * std::atan2(axis.Dot(Vec3(q.X(), q.Y(), q.Z())), q.W()), 2 * std::numbers::pi);
      if (j.kind == Joint::Kind::slide) {
        reached.Pos() = axis * start;
      } else {
        reached.Rot() = Quat::about(axis, start);
      }
    }
    const bool turns = j.kind == Joint::Kind::ball || j.kind == Joint::Kind::universal;
    if (turns && turn.Pos().Length() <= kPoseTolerance) {
      if (distance(turn) > kPoseTolerance)
        c_.turned.push_back({static_cast<std::size_t>(&j - c_.out.joints.data()), c_.file_of(element_), key_ + "/link"});
      return;
    }
    if (distance(reached.Inverse() * turn) > kPoseTolerance)
      return problem(element_, "/link", "", "poses that joint " + j.name + " can't reach", "poses of a saved world");
    if (j.one_axis() && !j.axes[0].start) j.axes[0].start = start;
  }

  ReadContext& c_;
  sdf::ElementPtr element_;
  std::string name_, key_;
  std::map<std::size_t, Pose3> poses_;
};

}  // namespace

void read_state(ReadContext& c, const sdf::World& world) {
  const sdf::ElementPtr state = child(world.Element(), "state");
  if (!state) return;
  for (const char* name : {"insertions", "deletions"}) {
    const sdf::ElementPtr e = child(state, name);
    if (e && e->GetFirstElement())
      c.problem(e, std::string("state/") + name, "", "isn't supported", "a world as it was saved, models in place");
  }
  for (sdf::ElementPtr m = child(state, "model"); m; m = m->GetNextElement("model"))
    ModelState(c, m, m->GetAttribute("name")->GetAsString()).apply();
}

}  // namespace vsa::reader
