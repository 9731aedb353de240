// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/directed_friction.hpp"

#include <algorithm>

namespace vsa::physics {
namespace {

constexpr double kAlongNormal = 0.1;  // sine of the angle between direction and normal

}  // namespace

DirectedFriction::DirectedFriction(const std::vector<LinkObjects::Direction>& directions, const mjModel& model) {
  if (directions.empty()) return;
  by_geom_.resize(static_cast<std::size_t>(model.ngeom));
  for (const LinkObjects::Direction& d : directions) by_geom_[static_cast<std::size_t>(d.geom)] = d;
}

/// A geom has the larger of its two.
DirectedFriction::Pair DirectedFriction::of(const mjModel& m, int geom) const {
  const double mu = m.geom_friction[3 * geom];
  const auto& own = by_geom_[static_cast<std::size_t>(geom)];
  if (!own) return {mu, mu};
  const double most = std::max(own->mu, own->mu2);
  return {mu * (own->mu / most), mu * (own->mu2 / most)};
}

void DirectedFriction::turn(const mjModel& m, const mjData& d, mjContact& contact) const {
  const auto &first = by_geom_[static_cast<std::size_t>(contact.geom1)],
             &second = by_geom_[static_cast<std::size_t>(contact.geom2)];
  const Pair a = of(m, contact.geom1), b = of(m, contact.geom2);
  Pair mu{std::min(a.along, b.along), std::min(a.across, b.across)};
  const LinkObjects::Direction& direction = first && !(second && b.along < a.along) ? *first : *second;
  const mjtNum* normal = contact.frame;
  mjtNum tangent[3];
  mju_rotVecQuat(tangent, direction.along.data(), d.xquat + 4 * direction.body);
  mju_addToScl3(tangent, normal, -mju_dot3(tangent, normal));
  if (mju_normalize3(tangent) > kAlongNormal) {
    mju_copy3(contact.frame + 3, tangent);
    mju_cross(contact.frame + 6, normal, tangent);
  } else {
    mu.along = mu.across = std::min(mu.along, mu.across);
  }
  contact.friction[0] = std::max(mu.along, mjMINMU);
  contact.friction[1] = std::max(mu.across, mjMINMU);
}

bool DirectedFriction::turn(const mjModel& m, mjData& d) const {
  bool any = false;
  for (int i = 0; i < (by_geom_.empty() ? 0 : d.ncon); ++i) {
    mjContact& c = d.contact[i];
    if (c.dim < 3 || c.geom1 < 0 || c.geom2 < 0) continue;
    if (!by_geom_[static_cast<std::size_t>(c.geom1)] && !by_geom_[static_cast<std::size_t>(c.geom2)]) continue;
    turn(m, d, c);
    any = true;
  }
  return any;
}

}  // namespace vsa::physics
