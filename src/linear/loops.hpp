// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The firmware's position loops, closed about a plant whose inputs are voltages.
#pragma once

#include "linear/plant.hpp"

namespace vsa::linear {

/// One motor's loop as its bridge has it.
struct MotorLoop {
  Eigen::Index angle = 0, input = 0;  ///< of its angle among the states, its voltage among the inputs; its speed is the next state
  double p_V_per_rad = 0, d_V_per_rad = 0;  ///< of error; that an angle falls from loop to loop
};

struct Loops {
  double period_s = 0;
  std::vector<MotorLoop> motors;
};

/// Those of a unit by itself, and a notice for each motor that they don't reach. Throws InputError, as linearize().
[[nodiscard]] Loops find_loops(const device::UnitConfig& unit, const Plant& plant, std::vector<std::string>& notices);

/// In continuous time.
void average(System& system, const Loops& loops);
/// From loop to loop; the last loop's angles are new states.
void sample(System& system, const Loops& loops);

/// Tells of a growing pole too fast for averaging: beyond a tenth of the loops' rate its damping is the average's error.
void tell_of_averaging(const System& system, std::vector<std::string>& notices);

/// "motor 1 speed"
[[nodiscard]] std::string motor_signal(int motor, const char* what);

/// Stiffness at the shaft, the motors' angles eliminated from the springs, each held by its own stiffness; without one they follow
/// the shaft. No loops: frozen.
[[nodiscard]] double static_stiffness(const Plant& plant, const Loops& loops);

/// Signals of a linear actuator's shaft in m and N; its motors' stay.
void slide(std::vector<Signal>& signals);

}  // namespace vsa::linear
