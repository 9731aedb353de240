// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an MJCF says of a unit, and the robot that all of a model make. Nothing of MuJoCo's, and no XML: a library of MuJoCo's may have
// another tinyxml2 in it than the one that vsasim is compiled with, and the program takes whichever it met first.
//
//   type          actuator type: a name, or a TOML file (a path with "/" or ".toml", seen from where the program runs)      required
//   override      "drive.friction_Nm=0.7 shaft.friction_Nm=0.1": values that replace the type's
//   equilibrium   where the unit begins, rad, of a linear actuator m; default: where its joint begins
//   preset        with which it begins, in the type's preset unit; default 0
//   bus           name of its RS-485 line; units that name one share it. Default: a line of its own
//   id            its device id there, 1 … 254; default: the lowest that is free
//   baud          of the line, bit/s; default 2000000. Units of one line that say it say the same
//   cycle_s       of the line's master, s, or auto; as baud
//   faults        "noise_rad=0.001 seed=3": broken on purpose, from the first step on (config/faults_text.hpp)
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/host/robot_config.hpp"

namespace vsa::mujoco {

inline constexpr std::array<const char*, 9> kKeys{"type", "override", "equilibrium", "preset", "bus",
                                                  "id",   "baud",     "cycle_s",     "faults"};

struct UnitSpec {
  std::string name;                                      ///< the instance's, and the actuator's
  std::map<std::string, std::string, std::less<>> said;  ///< by kKeys; what isn't said, or empty, isn't there

  /// Empty: not said.
  [[nodiscard]] std::string_view get(std::string_view key) const;
};

/// Types by the standard directories, and before them the folders of types given as files.
[[nodiscard]] config::TypeLibrary library_for(std::span<const UnitSpec> units);

/// The type of a unit with its overrides. Throws InputError.
[[nodiscard]] config::ActuatorType type_of(const UnitSpec& unit, const config::TypeLibrary& library);

/// How many controls a unit of that type takes: its motors' voltages where they are its commands; else an equilibrium and, where there
/// is one, a preset.
[[nodiscard]] std::size_t controls_of(const config::ActuatorType& type);

/// The robot, with each unit on the joint at its place in `joints`. Throws InputError with every problem.
[[nodiscard]] host::RobotConfig robot_of(std::span<const UnitSpec> units, std::span<const std::string> joints,
                                         const config::TypeLibrary& library);

/// "vsasim.unit elbow", which leads what is wrong with it.
[[nodiscard]] std::string where(const UnitSpec& unit);

}  // namespace vsa::mujoco
