// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A servo (vsa/control/servo.hpp) as a linear controller about a plant whose inputs are voltages: without its limits and its dead
// zone, with counts as fine as one likes.
//
//   averaged  ċ = A c + B y + E r         sampled  c(k+1) = …        V = C c + D y + F r
//
// y: the unit's states (shaft angle and speed, then each motor's); r: references of a position servo's motors, a torque servo's
// equilibrium, the voltages themselves. Averaged, a difference over T is a speed that is T/2 late: ω̂' = (ω − ω̂)/(T_f + T/2).
#pragma once

#include "linear/plant.hpp"

namespace vsa::linear {

struct ServoLoop {
  Eigen::MatrixXd a, b, e, c, d, f;
  std::vector<Signal> states, inputs;
};

/// `preset`: the command at the point. Of a unit that has a servo.
[[nodiscard]] ServoLoop servo_loop(const device::UnitConfig& unit, const Plant& plant, double preset, Firmware firmware);

/// A loop among a system's states and inputs: where the unit's own are.
struct PlacedServo {
  ServoLoop loop;
  std::vector<Eigen::Index> states;  ///< of y
  Eigen::Index input = 0;            ///< of the first motor's voltage
  std::string owner;                 ///< leads its signals' names
};
/// Closes it: its states come behind the others, its inputs in place of the voltages.
void close(System& system, const PlacedServo& servo);
/// At the shaft, in the long run: 0 where a load drives it away for ever.
[[nodiscard]] double servo_stiffness(const device::UnitConfig& unit, const Plant& plant, double preset);
/// Of a unit by itself.
[[nodiscard]] PlacedServo alone(ServoLoop loop, const Plant& plant);

}  // namespace vsa::linear
