// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Friction that depends on the direction, which MuJoCo's shapes don't have but its contacts do: between finding the contacts and
// making constraints of them, those of such shapes get the direction and both coefficients.
//   coefficients   of the two shapes the smaller, along and across
//   direction      of the shape that has one; of two, of the one with the smaller coefficient along (as Gazebo Classic)
//   tangent        the direction less its part along the normal; within 6° of the normal the smaller of both coefficients counts
#pragma once

#include <optional>
#include <vector>

#include "physics/mujoco/bodies.hpp"

namespace vsa::physics {

class DirectedFriction {
 public:
  DirectedFriction() = default;
  DirectedFriction(const std::vector<LinkObjects::Direction>& directions, const mjModel& model);
  /// Of the contacts in `d`. False: there was nothing to change.
  [[nodiscard]] bool turn(const mjModel& m, mjData& d) const;

 private:
  struct Pair {
    double along = 0, across = 0;
  };
  [[nodiscard]] Pair of(const mjModel& m, int geom) const;
  void turn(const mjModel& m, const mjData& d, mjContact& contact) const;

  std::vector<std::optional<LinkObjects::Direction>> by_geom_;  // empty: none has one
};

}  // namespace vsa::physics
