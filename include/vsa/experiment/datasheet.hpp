// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The computed numbers of a data sheet, after Grioli and others, "Variable Stiffness Actuators: the User's Point of View" (IJRR 2015),
// and Wolf and others, "Variable Stiffness Actuators: Review on Design and Components" (IEEE/ASME T-Mech 2016): what law and drive
// alone tell (workspace.hpp). How long a change of stiffness takes and how fast a step is are simulated (bench.hpp).
//
// Not here, because no parameter tells it: size, and what the motors may give for long (heat). A mass is what the type's file states.
#pragma once

#include <array>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/experiment/workspace.hpp"

namespace vsa::experiment {

/// Of the attainable preset; all of it leaves no torque for a load.
inline constexpr std::array kPresetShares{0.0, 0.25, 0.5, 0.75, 0.9};

/// What depends on the direction in which the shaft is driven, where springs or motors are unequal.
struct OneWay {
  Reach peak;                               ///< at standstill, begins to move the load
  Reach holding;                            ///< at standstill, both motors at full voltage
  Reach unpowered;                          ///< at standstill, held by friction; NaN: the springs turn the motors back
  double no_load_speed_rad_per_s = 0;       ///< of the unloaded shaft
  BestPower power;                          ///< along the boundary
  double half_load_Nm = 0;                  ///< half of what it moves at its peak
  double stiffness_at_half_Nm_per_rad = 0;  ///< σ there
  Holding held_at_half;                     ///< at half of what it moves
  std::vector<WorkspacePoint> boundary;     ///< speeds at which it still moves something
};

/// The actuator at one attained preset, computed: driven towards +q, and backwards.
struct PresetColumn : OneWay {
  double preset = 0;                        ///< attained, in the law's unit
  double stiffness_at_rest_Nm_per_rad = 0;  ///< σ there, the shaft unloaded
  double energy_at_rest_J = 0;              ///< H with the shaft unloaded
  Holding held_at_rest;                     ///< unloaded
  std::vector<LawPoint> curve;              ///< the law alone, under a load
  OneWay back;                              ///< driven towards −q
  /// The direction in which it moves less.
  [[nodiscard]] const OneWay& weaker() const noexcept;
};

/// The position loop's errors, one motor without load.
struct LoopErrors {
  double moves_rad = 0;  ///< where the voltage overcomes dead band and friction; NaN: never
  double full_rad = 0;   ///< where the output is full
};

/// A data sheet's numbers, computed: of law and drive at a few presets.
struct DataSheet {
  config::ActuatorType type;          ///< that it is about
  std::array<MotorLine, 2> line;      ///< of each motor; where the law has one, it twice
  std::array<LoopErrors, 2> errors;   ///< of each motor
  double attainable_preset = 0;       ///< the largest that both motors wind the springs to
  double stiffest_Nm_per_rad = 0;     ///< at rest with that preset
  std::vector<PresetColumn> columns;  ///< kPresetShares of the attainable preset; one for a law without
  double most_energy_J = 0;           ///< over all reachable presets and loads
};

[[nodiscard]] DataSheet data_sheet(const config::ActuatorType& type);  ///< computed; nothing is simulated

}  // namespace vsa::experiment
