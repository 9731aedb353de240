// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Loops whose joints start where they don't close. With G_p, G_c, how a joint's parent and child have moved from where all joints are at
// 0, and the joint's place p and axis e there, the ends are |G_p p − G_c p| apart, and turned by the angle between G_p e and G_c e.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/world_impl.hpp"
#include "vsa/units.hpp"

namespace vsa::engine {
namespace {

using description::Joint;
using description::Pose3;
using description::Quat;
using description::Vec3;

constexpr double kClosed_m = 1e-4, kClosed_rad = 1e-3;

struct Gap {
  double apart_m = 0, turned_rad = 0,
         angle_rad = 0;  ///< of a hinge
};

double angle_of(const Quat& q) { return 2 * std::atan2(Vec3(q.X(), q.Y(), q.Z()).Length(), std::abs(q.W())); }

Gap gap_of(const Joint& joint, const Pose3& parent, const Pose3& child) {
  const Vec3 at = joint.pose.Pos();
  Gap out;
  out.apart_m = ((parent * Pose3(at, {})).Pos() - (child * Pose3(at, {})).Pos()).Length();
  const Quat turn = parent.Rot().Inverse() * child.Rot();
  if (joint.kind == Joint::Kind::fixed) out.turned_rad = angle_of(turn);
  if (joint.kind == Joint::Kind::hinge) {
    const Vec3 axis = joint.axes[0].xyz, moved = turn * axis;
    out.turned_rad = std::atan2(axis.Cross(moved).Length(), axis.Dot(moved));
    out.angle_rad = std::remainder(2 * std::atan2(axis.Dot(Vec3(turn.X(), turn.Y(), turn.Z())), turn.W()), 2 * kPi);
  }
  return out;
}

}  // namespace

void World::Impl::tell_open_loops() {
  const auto moved = [&](std::optional<std::size_t> link) {
    if (!link) return Pose3();
    const scene::Pose now = physics->pose(*link);
    const auto& p = now.position;
    const auto& q = now.quaternion;
    return Pose3({p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}) * world->links[*link].pose.Inverse();
  };
  for (const Joint& joint : world->joints) {
    if (!joint.closes) continue;
    const Gap gap = gap_of(joint, moved(joint.parent), moved(joint.child));
    if (gap.apart_m > kClosed_m || gap.turned_rad > kClosed_rad) {
      warnings.push_back(
          fmt::format("the loop that {} closes is open at the start, by {:.3g} mm and {:.3g} rad: it is pulled together",
                      joint.name, gap.apart_m * 1e3, gap.turned_rad));
    } else if (const auto start = joint.axes.empty() ? std::nullopt : joint.axes[0].start;
               start && std::abs(std::remainder(gap.angle_rad - *start, 2 * kPi)) > kClosed_rad) {
      warnings.push_back(fmt::format("{} closes a loop and starts at {:.3g} rad, where the loop has it, and not at {:.3g}",
                                     joint.name, gap.angle_rad, *start));
    }
  }
}

}  // namespace vsa::engine
