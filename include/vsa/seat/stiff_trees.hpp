// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Kinematic trees of stiff joints that may touch, like two fingers on one thing: the torques of each hang on the other's within a step, so
// they are solved as one tree (docs/explanation/7-host.md, "What holds stiff joints").
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vsa/host/robot.hpp"

namespace vsa::seat {

/// The step by which joints are taken for stiff when trees are joined, s: not the world's, whose states go to worlds of other steps.
inline constexpr double kUsualStep_s = 2e-3;
/// Beyond so many joints what touches acts a step late.
inline constexpr std::size_t kMostJoined = 32;

/// Whether a step of kUsualStep_s hardly resolves an actuator's spring (device::kHardlyResolved), unloaded and with the largest preset. `inverse_inertia`: B_jj of its joint, 1/(kg·m²). Throws InputError for an actuator that there isn't.
[[nodiscard]] bool may_be_stiff(const host::Robot& robot, std::size_t actuator, double inverse_inertia);

/// Makes one of those trees that have a stiff joint and may touch, where they have kMostJoined joints at most. By the numbers that the
/// trees hold, each below their size: `stiff`: which are; `neighbours`: equal numbers where they may touch, so in
/// one tree, too.
void join_stiff_trees(std::vector<std::vector<std::size_t>>& trees, std::span<const char> stiff,
                      std::span<const std::size_t> neighbours);

}  // namespace vsa::seat
