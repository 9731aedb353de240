// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit between two loops of its firmware: a point of rest, and the slopes of all that acts there.
#pragma once

#include "vsa/linear/linear.hpp"

namespace vsa::linear {

/// One motor at rest.
struct MotorSlopes {
  double volts = 0, amps = 0;
  double amps_per_volt = 0;      ///< ∂I/∂V; with an inductance 1/R, in the steady state
  double amps_per_speed = 0;     ///< −∂I/∂ω, A·s/rad, likewise
  std::optional<double> lag_s;   ///< L/R where the current is a state
  double volts_per_percent = 0;  ///< G: mean voltage per % of the controller's output
  double stuck_stiffness = 0;    ///< of the gear's bristle, N·m/rad
  double tendon_stiffness = 0;   ///< κ between this pulley and the shaft, N·m/rad
};

struct Plant {
  int motors = 0;
  Rest rest;
  elastic::Hessian curvature;
  std::array<drive::MotorParams, 2> motor;  ///< at their pulleys
  std::array<MotorSlopes, 2> slopes;
  double inertia = 0, damping = 0;
  double shaft_stiffness = 0;  ///< of the shaft friction's bristle
  double tendon_damping_s = 0;
  std::vector<std::string> notices;

  /// Where motor i's states begin; of as many as there are motors, where they end.
  [[nodiscard]] int angle(int i) const noexcept {
    int at = 2;
    for (int k = 0; k < i; ++k) at += slopes[k].lag_s ? 3 : 2;
    return at;
  }
  [[nodiscard]] int states() const noexcept { return angle(motors); }
};

/// Throws InputError, as linearize().
[[nodiscard]] Plant find_plant(const device::UnitConfig& unit, const OperatingPoint& point, DryFriction friction);

/// ẋ = A x + B u with x = shaft angle and speed, then each motor's angle, speed and, where it is a state, current;
/// u = load torque, voltages.
[[nodiscard]] Eigen::MatrixXd state_matrix(const Plant& plant);
[[nodiscard]] Eigen::MatrixXd input_matrix(const Plant& plant);
/// C of shaft angle and speed, spring torque, each motor's angle, for so many states; those beyond the plant's aren't looked at.
[[nodiscard]] Eigen::MatrixXd output_matrix(const Plant& plant, Eigen::Index states);
/// At the shaft with the pulleys held, N·m/rad.
[[nodiscard]] double held_stiffness(const Plant& plant);

}  // namespace vsa::linear
