// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What pushes and pulls at links.
#pragma once

#include <array>
#include <cstddef>

namespace vsa::scene {

/// Where two bodies touched in the last step.
struct Contact {
  std::array<double, 3> position{};  ///< m, world
  std::array<double, 3> force_N{};   ///< world; on `link` by `other`
  std::size_t link = 0,              ///< into the world's links; not static
      other = 0;                     ///< into the world's links
};

/// Two links whose colliding shapes are in each other.
struct Overlap {
  std::size_t link = 0,  ///< into the world's links
      other = 0;         ///< likewise, the higher one
  double depth_m = 0;    ///< of their deepest contact
};

/// A force at a point of a link and a torque on it, both in world axes; the point goes with the link.
struct Wrench {
  std::array<double, 3> force_N{};    ///< ±1e9
  std::array<double, 3> torque_Nm{};  ///< ±1e9
  std::array<double, 3> point_m{};    ///< in the link's frame, ±1e4
};

/// A spring from a point of a link to a place in the world, as a hand pulls: F = k·(target − p) − c·ṗ with its damper, never more
/// than force_max_N. Worked out implicitly, so that no stiffness of it shakes a light link.
struct Pull {
  std::size_t link = 0;              ///< into the world's links; one that isn't static
  std::array<double, 3> point_m{};   ///< in the link's frame
  std::array<double, 3> target_m{};  ///< in the world
  double stiffness_N_per_m = 100;    ///< k, 0 … 1e5
  double damping_Ns_per_m = 5;       ///< c, 0 … 1e4
  double force_max_N = 20;           ///< 0 … 1e4
};

}  // namespace vsa::scene
