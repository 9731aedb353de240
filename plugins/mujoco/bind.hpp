// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which joint of a MuJoCo model a unit drives, and whether it can.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "units.hpp"
#include "vsa/errors.hpp"

namespace vsa::mujoco {

/// The joint of a unit's actuators; adds what is wrong with them, −1 where there is no such joint. `controls`: how many its type takes.
[[nodiscard]] int joint_of(const mjModel& m, const Unit& unit, std::size_t controls, Problems& problems);

/// Adds what of the model's options units can't be stepped with.
void check_options(const mjModel& m, Problems& problems);
/// Whether its integrator asks for torques once a step, as units give them. Programs change it after a model is loaded.
[[nodiscard]] bool has_one_torque_a_step(const mjModel& m) noexcept;

/// Joints that move each other, by trees: indices into `joints` (ids; one-axis joints).
[[nodiscard]] std::vector<std::vector<std::size_t>> trees_of(const mjModel& m, const std::vector<int>& joints);

/// "elbow", or "joint 3" of one without a name.
[[nodiscard]] std::string joint_name(const mjModel& m, int joint);

}  // namespace vsa::mujoco
