// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Many units on the joints of one set of bodies, about a point at which all stand still: each unit's linear model (linear.hpp)
// with the bodies in place of its inertia,
//
//   M q̈ + D q̇ + (K + C) q = τ_load + τ_units           q: deviations of the joints' angles, rad (a prismatic joint's: m)
//
//   M   mass matrix there; with it one joint's torque accelerates all
//   K   ∂/∂q of what gravity asks of the joints: gravity's own stiffness, negative where a weight stands above its joint
//   C, D  diagonal: springs and dampers that the joints have besides
//   τ_units  −H_qq q − Σ H_qi x_i of each unit, as linear.hpp has it; joints without a unit have none
//
// STATES: angle and speed of joint after joint, then the motors of unit after unit, each as linear.hpp has them; sampled: the last
// loop's angles after them. INPUTS: a load torque per joint, then each unit's voltages or references. OUTPUTS: angle and speed of
// each joint, then spring torque and motor angles of each unit. With one joint these are linear.hpp's own.
#pragma once

#include "vsa/linear/linear.hpp"

namespace vsa::linear {

/// A joint of the bodies, whether or not a unit turns it.
struct BodyJoint {
  std::string name;        ///< scoped
  bool prismatic = false;  ///< its angle and stiffness are in m, N/m and N·s/m
  double angle = 0;        ///< where it stands, rad or m
  double damping = 0;      ///< ≥ 0, N·m·s/rad
  double stiffness = 0;    ///< ≥ 0, N·m/rad
};

/// The bodies that the units move, about the point.
struct Bodies {
  std::vector<BodyJoint> joints;      ///< in the order of `mass` and of every vector
  Eigen::MatrixXd mass;               ///< M, symmetric and positive definite
  Eigen::MatrixXd gravity_stiffness;  ///< K, symmetric
};

/// A unit on a joint. Its point's inertia and damping don't count.
struct MountedUnit {
  std::string name;         ///< of the actuator
  device::UnitConfig unit;  ///< its parameters
  OperatingPoint point;     ///< its point; inertia and damping come from the bodies
  std::size_t joint = 0;    ///< into Bodies::joints; at most one unit a joint
};

/// Units on the joints of one set of bodies, about a point: M q̈ + D q̇ + (K + C) q = τ_load + τ_units.
struct RobotModel : System {
  Bodies bodies;  ///< as they were given
  /// How one of the units stands there.
  struct UnitRest {
    std::string name;       ///< of the actuator
    std::size_t joint = 0;  ///< into `bodies.joints`
    int motors = 0;         ///< 1 or 2
    Rest rest;              ///< at the point
    /// Of the unit by itself.
    double held_stiffness_Nm_per_rad = 0, static_stiffness_Nm_per_rad = 0;  ///< of the unit by itself
  };
  std::vector<UnitRest> units;       ///< in the order of the states
  Eigen::MatrixXd held_stiffness;    ///< joints × joints: K + C and the units' with pulleys held
  Eigen::MatrixXd static_stiffness;  ///< the same with motors that yield
};

/// Throws InputError: what linearize() of one unit refuses, each problem led by the unit's name; matrices of another size, a mass
/// matrix that isn't positive definite; sampled: no unit, or units whose loops have different periods.
[[nodiscard]] RobotModel linearize(const Bodies& bodies, const std::vector<MountedUnit>& units, Firmware firmware,
                                   DryFriction friction = DryFriction::sliding);

/// What answers sinusoidal torques at the joints, each joints × joints.
struct RobotResponse {
  double frequency_Hz = 0;      ///< of the torques
  Eigen::MatrixXcd compliance;  ///< q_i over τ_j, the other joints free to move
  Eigen::MatrixXcd impedance;   ///< Z: τ = Z q̇, N·m·s/rad
  /// What a torque at one joint feels there, 1/(Z⁻¹)_jj: the other joints yield.
  Eigen::VectorXcd driving_point;
};
/// At frequencies as answers().
[[nodiscard]] RobotResponse response(const RobotModel& model, double frequency_Hz);

}  // namespace vsa::linear
