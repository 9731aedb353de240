// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An actuator type about a point, or a world of them: matrices, poles, frequency response (vsa/linear/linear.hpp, linear_world.hpp),
// and the results.json with them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/experiment/bench.hpp"
#include "vsa/linear/linear.hpp"
#include "vsa/linear_world/linear_world.hpp"

namespace vsa::study {

struct LinearizationOptions {
  experiment::Specimen specimen;
  linear::OperatingPoint point;
  linear::Firmware firmware = linear::Firmware::averaged;
  linear::DryFriction friction = linear::DryFriction::sliding;
};

struct Linearization {
  config::ActuatorType actuator;
  linear::Firmware firmware{};
  linear::DryFriction friction{};
  linear::Model model;
  std::vector<linear::Pole> poles;
  std::vector<linear::Response> responses;  ///< 0.01 Hz … 1 kHz, 50 a decade; sampled: below half the loop's rate
};

struct WorldLinearization {
  std::string name;  ///< the world's
  linear::Firmware firmware{};
  linear::DryFriction friction{};
  linear_world::WorldModel world;
  std::vector<linear::Pole> poles;
  std::vector<std::string> moves;                ///< of each pole: the angle that swings farthest
  std::vector<linear::RobotResponse> responses;  ///< as above, 10 a decade
};

/// Words as the command has them: frozen, averaged, sampled; sliding, stuck.
[[nodiscard]] std::string_view word(linear::Firmware firmware) noexcept;
[[nodiscard]] std::string_view word(linear::DryFriction friction) noexcept;

/// Throws InputError: an unknown type or override, and what linear::linearize() refuses.
[[nodiscard]] Linearization linearize(const LinearizationOptions& options);
/// Throws InputError, SimulationError: what linear_world::linearize() refuses.
[[nodiscard]] WorldLinearization linearize(const engine::World& world, const linear_world::WorldPoint& point,
                                           linear::Firmware firmware, linear::DryFriction friction);
/// Matrices by rows. A number that isn't finite is null.
[[nodiscard]] std::string to_json(const Linearization& l, const std::string& command);
[[nodiscard]] std::string to_json(const WorldLinearization& l, const std::string& command);

}  // namespace vsa::study
