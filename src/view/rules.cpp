// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "vsa/elastic/travel.hpp"
#include "vsa/units.hpp"
#include "vsa/view/request.hpp"

namespace vsa::view {
namespace {

/// What the unit lets its motors do; a turn where it doesn't limit them.
Span equilibrium_span(const device::UnitConfig& unit, int motors) {
  Span out{-kPi, kPi};
  for (int i = 0; i < motors && unit.references_limited(); ++i) {
    const auto [low, high] = unit.reference_range_raw(i);
    out = {std::max(out.min, radians(Raw{low})), std::min(out.max, radians(Raw{high}))};
  }
  // A shaft that slides goes its lead with each radian of a motor.
  const double lead = unit.actuator.linear() ? elastic::shaft_per_pulley(*unit.actuator.transmission, 0) : 1.0;
  if (lead != 1) out = {std::min(out.min * lead, out.max * lead), std::max(out.min * lead, out.max * lead)};
  return out;
}

}  // namespace

Rules rules_of(const host::Simulation& world, const motion::Gait* gait, bool control) {
  Rules out;
  for (std::size_t r = 0; r < world.robot_count(); ++r) {
    for (const host::ActuatorConfig& a : world.robot(r).config().actuators) {
      const auto& law = a.unit.actuator.transmission;
      const bool has_preset = law && !a.unit.preset_unit().empty();
      out.actuators.push_back({equilibrium_span(a.unit, law ? law->motor_count() : 1), {0, has_preset ? a.unit.preset_max : 0}});
    }
  }
  for (const scene::LinkInfo& link : world.links()) out.moves.push_back(!link.is_static);
  out.gait = gait != nullptr;
  out.control = control;
  out.hands = world.has_hands();
  out.contacts = world.has_contacts();
  if (gait == nullptr) return out;
  for (const motion::GaitGroup& group : gait->params().groups) out.gait_groups.push_back(group.name);
  return out;
}

}  // namespace vsa::view
