// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/rigid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vsa::physics {

RigidGroups::RigidGroups(const description::World& world) : world_(world), of_(world.links.size() + 1) {
  const std::size_t ground = world.links.size();
  std::iota(of_.begin(), of_.end(), std::size_t{0});
  for (std::size_t l = 0; l < ground; ++l)
    if (world.links[l].is_static) of_[l] = ground;
  for (const Joint& j : world.joints) {
    if (j.kind != Joint::Kind::fixed) continue;
    const std::size_t a = top(j.parent.value_or(ground)), b = top(j.child.value_or(ground));
    of_[std::min(a, b)] = std::max(a, b);  // the world stays on top
  }
  for (std::size_t l = 0; l < ground; ++l) of_[l] = top(l);
}

std::size_t RigidGroups::top(std::size_t link) const {
  while (of_[link] != link) link = of_[link];
  return link;
}

double RigidGroups::reach(std::optional<std::size_t> link, const Vec3& from) const {
  const std::size_t ground = world_.links.size(), group = top(link.value_or(ground));
  if (group == ground) return 0;
  const auto each = [&](auto&& work) {
    for (std::size_t l = 0; l < ground; ++l)
      if (top(l) == group) work(world_.links[l], (world_.links[l].pose * Pose3(world_.links[l].com, {})).Pos());
  };
  double mass = 0, moment = 0;  // moment: Σ m·r² of all points, about the centre: half the trace of the inertia
  Vec3 centre;
  each([&](const Link& l, const Vec3& at) {
    mass += l.mass;
    centre += at * l.mass;
  });
  centre = centre / mass;
  each([&](const Link& l, const Vec3& at) {
    const Vec3 off = at - centre;
    moment += (l.inertia(0, 0) + l.inertia(1, 1) + l.inertia(2, 2)) / 2 + l.mass * off.Dot(off);
  });
  return std::sqrt(moment / mass) + (centre - from).Length();
}

}  // namespace vsa::physics
