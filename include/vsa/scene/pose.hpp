// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where something is and how it moves, as plain numbers.
#pragma once

#include <array>

namespace vsa::scene {

/// A link's place in the world; its rotation is a unit quaternion.
struct Pose {
  std::array<double, 3> position{};              ///< m, world
  std::array<double, 4> quaternion{1, 0, 0, 0};  ///< w x y z
};

/// Whether all of its numbers are.
[[nodiscard]] bool finite(const Pose& pose) noexcept;

/// Linear velocity of a link's origin and angular velocity, both in world axes.
struct Twist {
  std::array<double, 3> linear_m_per_s{};     ///< of the link's origin
  std::array<double, 3> angular_rad_per_s{};  ///< of the link
};

}  // namespace vsa::scene
