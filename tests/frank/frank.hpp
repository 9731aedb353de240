// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/units.hpp"

namespace vsa::engine {

using motion::Gait;

inline World world(const std::string& name) {
  return World::load(std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds" / (name + ".sdf"));
}
inline Gait motion(const std::string& name) {
  return Gait::load(std::filesystem::path(VSA_SOURCE_DIR) / "models/gaits" / (name + ".toml"));
}

/// Until that time of the world.
template <typename Look>
void play(World& w, Gait& g, double until_s, const Look& look) {
  while (w.time_s() < until_s - w.step_s() / 2) {
    g.apply(w);
    w.step();
    look();
  }
}
inline void play(World& w, Gait& g, double until_s) {
  play(w, g, until_s, [] {});
}

inline Pose pose(const World& w, const std::string& link) {
  std::vector<Pose> poses(w.links().size());
  w.poses(poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (w.links()[i].name == link) return poses[i];
  }
  throw std::runtime_error("no link " + link);
}

/// A vector of a link's frame in the world.
inline std::array<double, 3> turned(const Pose& p, const std::array<double, 3>& v) {
  const auto& [w, x, y, z] = p.quaternion;
  const std::array<double, 3> t{2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])};
  return {v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]};
}

/// The body's lean from upright and how far it has moved.
inline double lean_rad(const World& w) { return std::acos(std::min(1.0, turned(pose(w, "frank::body"), {0, 0, 1})[2])); }
inline double shift_m(const World& w) {
  const auto at = pose(w, "frank::body").position;
  return std::hypot(at[0], at[1]);
}

}  // namespace vsa::engine
