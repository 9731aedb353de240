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

/// What is to be made linear, and about which point.
struct LinearizationOptions {
  experiment::Specimen specimen;                                ///< the actuator
  linear::OperatingPoint point;                                 ///< where it stands
  linear::Firmware firmware = linear::Firmware::averaged;       ///< how its program is taken
  linear::DryFriction friction = linear::DryFriction::sliding;  ///< how dry friction is taken
};

/// One actuator as a linear system about a point, with its poles and frequency response.
struct Linearization {
  config::ActuatorType actuator;            ///< as it was read
  linear::Firmware firmware{};              ///< as it was asked for
  linear::DryFriction friction{};           ///< as it was asked for
  linear::Model model;                      ///< matrices, and how it stands there
  std::vector<linear::Pole> poles;          ///< by frequency
  std::vector<linear::Response> responses;  ///< 0.01 Hz … 1 kHz, 50 a decade; sampled: below half the loop's rate
};

/// A world of actuators as a linear system about a point, with its poles and frequency response.
struct WorldLinearization {
  std::string name;                              ///< the world's
  linear::Firmware firmware{};                   ///< as it was asked for
  linear::DryFriction friction{};                ///< as it was asked for
  linear_world::WorldModel world;                ///< matrices, and what carries the weights
  std::vector<linear::Pole> poles;               ///< by frequency
  std::vector<std::string> moves;                ///< of each pole: the angle that swings farthest
  std::vector<linear::RobotResponse> responses;  ///< as above, 10 a decade
};

/// Words as the command has them: frozen, averaged, sampled; sliding, stuck.
[[nodiscard]] std::string_view word(linear::Firmware firmware) noexcept;
/// "sliding", "stuck".
[[nodiscard]] std::string_view word(linear::DryFriction friction) noexcept;

/// Throws InputError: an unknown type or override, and what linear::linearize() refuses.
[[nodiscard]] Linearization linearize(const LinearizationOptions& options);
/// Throws InputError, SimulationError: what linear_world::linearize() refuses.
[[nodiscard]] WorldLinearization linearize(const engine::World& world, const linear_world::WorldPoint& point,
                                           linear::Firmware firmware, linear::DryFriction friction);
/// Matrices by rows. A number that isn't finite is null.
[[nodiscard]] std::string to_json(const Linearization& l, const std::string& command);
/// Of a world.
[[nodiscard]] std::string to_json(const WorldLinearization& l, const std::string& command);

}  // namespace vsa::study
