// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A scenario's commands, given in simulated time. Who commands a channel of an actuator has it to itself: a gait leaves it from then
// on; keyframes that have it are a mistake.
#pragma once

#include <string>
#include <vector>

#include "run/run.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"

namespace vsa::app {

class CommandPlayer {
 public:
  /// Binds the gait, too, which may be null. Throws InputError with every actuator that isn't there or that keyframes command.
  CommandPlayer(const RunOptions& options, const engine::World& world, motion::Gait* gait);

  void apply(engine::World& world, motion::Gait* gait);  ///< before every step, after the gait
  void reset(motion::Gait* gait);                        ///< from the start; before the gait's own reset

 private:
  struct Order {
    RunOptions::Command command;
    engine::ActuatorRef actuator;
    std::string in_gait;  ///< the actuator as the gait calls it; empty: it isn't the gait's
  };
  std::vector<Order> orders_;
  std::size_t next_ = 0;
};

}  // namespace vsa::app
