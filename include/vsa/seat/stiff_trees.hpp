// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Kinematic trees of stiff joints that may touch, like two fingers on one thing: the torques of each hang on the other's within a step, so
// they are solved as one tree (docs/explanation/7-host.md, "What holds stiff joints").
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace vsa::seat {

/// By which joints are stiff when trees are joined. Not the step of the world, whose states go to worlds of other steps: trees are the
/// model's.
inline constexpr double kUsualStep_s = 1e-3;
/// Beyond so many joints what touches acts a step late.
inline constexpr std::size_t kMostJoined = 32;

/// Makes one of those trees that have a stiff joint, behind the others, where they have kMostJoined joints at most. `stiff`: by the
/// numbers that the trees hold, each below its size.
inline void join_stiff_trees(std::vector<std::vector<std::size_t>>& trees, std::span<const char> stiff) {
  const auto is_stiff = [&](const std::vector<std::size_t>& tree) {
    return std::any_of(tree.begin(), tree.end(), [&](std::size_t k) { return stiff[k] != 0; });
  };
  std::vector<std::size_t> all;
  for (const auto& tree : trees)
    if (is_stiff(tree)) all.insert(all.end(), tree.begin(), tree.end());
  if (all.empty() || all.size() > kMostJoined) return;
  std::erase_if(trees, is_stiff);
  trees.push_back(std::move(all));
}

}  // namespace vsa::seat
