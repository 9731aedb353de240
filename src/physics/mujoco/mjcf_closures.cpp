// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which of an MJCF's equalities are a joint that closes a loop.
#include <algorithm>
#include <utility>

#include "physics/mujoco/mjcf_file.hpp"
#include "physics/mujoco/versions.hpp"

namespace vsa::physics {
namespace {

constexpr double kSamePlace = 1e-6;  // m, of places up to 1 m

/// A body that is fixed to the world is the world.
int mover(const mjModel& m, int body) { return m.body_weldid[body] == 0 ? 0 : body; }

/// The connect's point, in the world.
Vec3 point_of(const mjModel& m, const mjData& d, int equality) {
  const int one = m.eq_obj1id[equality];
  const mjtNum* of = m.eq_data + static_cast<std::ptrdiff_t>(mjNEQDATA) * equality;
  mjtNum at[3];
  if (holds_sites(m, equality)) {
    mju_copy3(at, d.site_xpos + 3 * one);
  } else {
    mju_rotVecQuat(at, of, d.xquat + 4 * one);
    mju_addTo3(at, d.xpos + 3 * one);
  }
  return {at[0], at[1], at[2]};
}

}  // namespace

int closures_of(const mjModel& m, const mjData& d, const description::Joint& joint, int parent, int child) {
  using JointKind = description::Joint::Kind;
  const std::pair ends = std::minmax({mover(m, parent), mover(m, child)});
  const Vec3 place = joint.pose.Pos();
  int out = 0;
  for (int e = 0; e < m.neq && !without_equalities(m); ++e) {
    if (m.eq_type[e] != (joint.kind == JointKind::fixed ? mjEQ_WELD : mjEQ_CONNECT) || !starts_active(m, e)) continue;
    const int one = body_held(m, e, m.eq_obj1id[e]), two = body_held(m, e, m.eq_obj2id[e]);
    if (std::pair(std::minmax({mover(m, one), mover(m, two)})) != ends) continue;
    Vec3 off = joint.kind == JointKind::fixed ? Vec3() : point_of(m, d, e) - place;
    if (joint.kind == JointKind::hinge) off = off - joint.axes[0].xyz * off.Dot(joint.axes[0].xyz);
    if (off.Length() <= kSamePlace * (1 + place.Length())) ++out;
  }
  return out;
}

}  // namespace vsa::physics
