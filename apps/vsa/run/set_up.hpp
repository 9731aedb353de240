// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa run`'s options ask for, made: the world, the record's options, the faults, the speed. Each throws InputError.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/run.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/record/recorder.hpp"

namespace vsa::app {

[[nodiscard]] engine::World load_world(const RunOptions& options);

/// The options with their seed in every fault's text that has none.
[[nodiscard]] RunOptions seeded(RunOptions options);

/// Each text goes to the robots that have its actuator.
void break_robots(engine::World& world, const std::vector<std::string>& faults);

/// Simulated by wall time; none: as fast as it can.
[[nodiscard]] std::optional<double> speed_of(const RunOptions& options);

[[nodiscard]] record::RecorderOptions recorder_options(const RunOptions& options);

/// The first robot's model, if a body of it flies free: the way of one that is bolted down says nothing. Empty: none.
[[nodiscard]] std::string travelling_model(const engine::World& world);

/// What a distance is averaged over: the gait's period, or what is close to Table II's.
[[nodiscard]] double travel_window_s(const std::optional<motion::Gait>& gait);

}  // namespace vsa::app
