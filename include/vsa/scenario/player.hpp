// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a scenario commands: its gait, and its commands in simulated time. Who commands a channel of an actuator has it to itself: a
// gait leaves it from then on; keyframes that have it are a mistake.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/scenario/scenario.hpp"

namespace vsa::scenario {

/// Plays what a scenario commands, its gait and its commands, on one world, before every step.
class Player {
 public:
  /// Throws InputError: the motion's problems, and every actuator that isn't there or that keyframes command.
  Player(const Scenario& scenario, const engine::World& world);

  void apply(engine::World& world);  ///< before every step
  void reset();                      ///< from the start
  /// Null: it has none.
  [[nodiscard]] motion::Gait* gait() noexcept { return gait_ ? &*gait_ : nullptr; }

 private:
  struct Order {
    Command command;
    engine::ActuatorRef actuator;
    std::string in_gait;  ///< the actuator as the gait calls it; empty: it isn't the gait's
  };
  std::optional<motion::Gait> gait_;
  std::vector<Order> orders_;
  std::size_t next_ = 0;
};

}  // namespace vsa::scenario
