// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the worlds of these tests are told, in any simulator: a load that is thrown about, a snake that crawls.
#pragma once

#include <cmath>
#include <cstddef>

namespace vsa::mujoco::test {

struct Command {
  double equilibrium, preset;  // rad
};

inline constexpr int kCommandEvery = 10;  // steps

inline Command command_at(std::size_t unit, double t_s) {
  constexpr double kTurn = 6.283185307179586;
  return {0.5 * std::sin(kTurn * 0.7 * t_s - 0.5 * static_cast<double>(unit)), 0.25 + 0.15 * std::sin(3 * t_s)};
}

}  // namespace vsa::mujoco::test
