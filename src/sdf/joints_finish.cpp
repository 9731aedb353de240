// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What can only be said of a joint when all joints are known.
//
//   limits without room   lower = upper = c: the joint is a weld, with what hangs on it turned or shifted by c
//   the start             <initial_position>, or 0; where the limits exclude 0, the limit next to it
//   mimic                 a follower starts at multiplier·start(leader) + offset; it leads others only behind its own leader
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sdf/reading.hpp"

namespace vsa::reader {
namespace {

std::string range_of(const Axis& axis) { return fmt::format("{} … {}", (*axis.range)[0], (*axis.range)[1]); }

/// Links that hang on joint `j`'s child, by joints other than `j`.
std::vector<bool> beyond(const description::World& world, std::size_t j) {
  std::vector<bool> there(world.links.size(), false);
  std::vector<std::size_t> open;
  const auto enter = [&](std::optional<std::size_t> link) {
    if (!link || there[*link] || world.links[*link].is_static) return;
    there[*link] = true;
    open.push_back(*link);
  };
  enter(world.joints[j].child);
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (std::size_t k = 0; k < world.joints.size(); ++k) {
      const Joint& other = world.joints[k];
      if (k == j) continue;
      if (other.parent == open[i]) enter(other.child);
      if (other.child == open[i]) enter(other.parent);
    }
  }
  return there;
}

/// Moves what hangs on the joint as the joint at `position` would.
void pose_beyond(description::World& world, std::size_t j, double position) {
  const std::vector<bool> moved = beyond(world, j);
  const Joint& joint = world.joints[j];
  const Vec3 axis = joint.axes[0].xyz, at = joint.pose.Pos();
  const Quat turn = joint.kind == Joint::Kind::hinge ? Quat::about(axis, position) : Quat();
  const Pose3 move(joint.kind == Joint::Kind::hinge ? at - turn * at : axis * position, turn);
  for (std::size_t l = 0; l < world.links.size(); ++l) {
    if (moved[l]) world.links[l].pose = move * world.links[l].pose;
  }
  for (std::size_t k = 0; k < world.joints.size(); ++k) {
    Joint& other = world.joints[k];
    const bool both = (!other.parent || moved[*other.parent]) && (!other.child || moved[*other.child]);
    if (k == j || !(both || (other.parent && moved[*other.parent]))) continue;
    other.pose = move * other.pose;
    for (Axis& a : other.axes) a.xyz = turn * a.xyz;
  }
}

void weld(Reading& c) {
  for (std::size_t j = 0; j < c.out.joints.size(); ++j) {
    Joint& joint = c.out.joints[j];
    if (!joint.one_axis() || !joint.axes[0].range) continue;
    const double lower = (*joint.axes[0].range)[0], upper = (*joint.axes[0].range)[1];
    if (lower != upper) continue;
    const double start = joint.axes[0].start.value_or(lower);
    if (start != lower)
      c.problems.add({c.file, joint.name + "/initial_position", fmt::format("{}", start), "is outside the joint's limits",
                      range_of(joint.axes[0])});
    if (lower != 0 && in_loop(c.out, j))
      c.problems.add({c.file, joint.name, range_of(joint.axes[0]), "leaves no room in a kinematic loop, away from 0",
                      "limits with room, or a fixed joint"});
    if (lower != 0) pose_beyond(c.out, j, lower);
    c.notes.add("joints whose limits leave no room are welded", fmt::format("{} at {}", joint.name, lower));
    joint.kind = Joint::Kind::fixed;
    joint.axes.clear();
  }
}

void find_start(Reading& c, const Joint& joint, Axis& axis) {
  if (!joint.one_axis()) {
    const bool excluded = axis.range && ((*axis.range)[0] > 0 || (*axis.range)[1] < 0 || (*axis.range)[0] == (*axis.range)[1]);
    if (axis.start.value_or(0) != 0 || excluded)
      c.problems.add({c.file, joint.name, "", "a joint with two axes starts at 0 and needs room there", "limits around 0"});
    return;
  }
  if (!axis.range) return;
  const double nearest = std::clamp(axis.start.value_or(0), (*axis.range)[0], (*axis.range)[1]);
  if (nearest == axis.start.value_or(0)) return;
  if (axis.start) {
    c.problems.add({c.file, joint.name + "/initial_position", fmt::format("{}", *axis.start), "is outside the joint's limits",
                    range_of(axis)});
    return;
  }
  axis.start = nearest;
  c.notes.add("joints whose limits exclude 0 start at the limit next to it", fmt::format("{} at {}", joint.name, nearest));
}

class Couplings {
 public:
  explicit Couplings(Reading& c) : c_(c) {}

  void all() {
    for (const Mimic& m : c_.mimics) add(m);
    // A chain of n followers is right after n rounds; one that isn't then is a circle.
    const std::size_t rounds = c_.out.couplings.size() + 1;
    for (std::size_t i = 0; i < rounds; ++i) {
      if (!pass()) return check_ranges();
    }
    for (const Mimic& m : c_.mimics)
      c_.problems.add({m.file, m.follower + "/mimic", m.leader, "follows itself, or in a circle",
                       "joints that lead to one that isn't a follower"});
  }

 private:
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const {
    const auto& joints = c_.out.joints;
    const auto it = std::find_if(joints.begin(), joints.end(), [&](const Joint& j) { return j.name == name; });
    return it == joints.end() || !it->one_axis() ? std::nullopt : std::optional(static_cast<std::size_t>(it - joints.begin()));
  }

  void add(const Mimic& m) {
    const auto follower = find(m.follower), leader = find(m.leader);
    if (!follower || !leader) {
      const std::string& which = follower ? m.leader : m.follower;
      c_.problems.add(
          {m.file, m.follower + "/mimic", which, "no such joint that moves about one axis", "revolute, continuous, prismatic"});
      return;
    }
    for (const Coupling& other : c_.out.couplings) {
      if (other.follower == *follower) c_.problems.add({m.file, m.follower + "/mimic", m.leader, "follows two joints", "one"});
    }
    c_.out.couplings.push_back({*follower, *leader, m.multiplier, m.offset});
  }

  /// True where a follower's start still moved.
  bool pass() {
    bool moved = false;
    for (const Coupling& k : c_.out.couplings) {
      std::optional<double>& to = c_.out.joints[k.follower].axes[0].start;
      const double start = k.multiplier * c_.out.joints[k.leader].axes[0].start.value_or(0) + k.offset;
      moved = moved || to.value_or(0) != start || depth_of(k) > c_.out.couplings.size();
      to = start;
    }
    return moved;
  }

  /// How many leaders stand above a follower; more than there are: a circle.
  [[nodiscard]] std::size_t depth_of(const Coupling& k) const {
    std::size_t depth = 0, at = k.leader;
    for (bool up = true; up && depth <= c_.out.couplings.size(); ++depth) {
      up = false;
      for (const Coupling& other : c_.out.couplings) {
        if (other.follower != at) continue;
        at = other.leader;
        up = true;
        break;
      }
    }
    return depth;
  }

  void check_ranges() {
    for (const Coupling& k : c_.out.couplings) {
      const Joint& follower = c_.out.joints[k.follower];
      const Axis& axis = follower.axes[0];
      if (!axis.range || (*axis.start >= (*axis.range)[0] && *axis.start <= (*axis.range)[1])) continue;
      c_.problems.add(
          {c_.file, follower.name, fmt::format("{}", *axis.start), "its mimic starts it outside its limits", range_of(axis)});
    }
  }

  Reading& c_;
};

}  // namespace

void finish_joints(Reading& c) {
  weld(c);
  for (Joint& joint : c.out.joints) {
    for (Axis& axis : joint.axes) find_start(c, joint, axis);
  }
  Couplings(c).all();
}

}  // namespace vsa::reader
