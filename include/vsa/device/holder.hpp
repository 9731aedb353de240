// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What holds joints besides their actuators, contacts, stops and dry friction, holds or lets go by their torques, and what a stiff spring
// gives hangs on what holds within the step (host/robot.hpp). Who works it out is asked while the joints are solved:
//
//   Δy, τ with what held with the torques of the last step
//   while joints would go elsewhere with τ: Δy, τ with what holds then
#pragma once

#include <cstddef>
#include <span>

namespace vsa::device {

/// A host's constraints, while it steps joints.
class Holder {
 public:
  virtual ~Holder() = default;  ///< of a host's class
  /// Whether some of them may hold a tree in this step; trees as they were joined.
  [[nodiscard]] virtual bool holds(std::size_t tree) const noexcept = 0;
  /// Whether with these torques, N·m, others hold it than those that the accelerations and B were told with last, or it answers not in
  /// proportion. If so, fills both: the joints' accelerations with these torques, rad/s², and by rows how those change with them,
  /// 1/(kg·m²). Numbers that aren't finite are taken for none: the torques are those found before.
  virtual bool holds_else(std::size_t tree, std::span<const double> torques, std::span<double> accelerations,
                          std::span<double> mobility) noexcept = 0;
};

}  // namespace vsa::device
