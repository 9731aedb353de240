// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a robot is made of: actuators on buses.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vsa/device/unit.hpp"

namespace vsa::host {

using vsa::device::UnitConfig;

/// What was put into an actuator type: keys and values as text.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// One actuator of a robot, as the plug-in XML lists it.
struct ActuatorConfig {
  std::string name;                    ///< unique in the robot
  std::string joint;                   ///< scoped joint name, e.g. "module_1::shaft"
  std::string type;                    ///< name of the actuator type it was made from
  UnitConfig unit;                     ///< validated parameters
  std::size_t bus = 0;                 ///< index into RobotConfig::buses
  int id = 1;                          ///< device id on that bus, 1–254
  double initial_equilibrium_rad = 0;  ///< of the firmware's first references
  double initial_preset = 0;           ///< in UnitConfig::preset_unit()
  /// False: the text names no initial equilibrium, and a host whose joint starts elsewhere may put it there.
  bool equilibrium_given = true;
  std::shared_ptr<const Settings> changed{};  ///< with which `unit` was made of `type`; none: nothing was
  /// Of `unit` as it is, with what its motors need for the host's steps worked out; none: the first step does that. Who changes
  /// `unit` resets this: where it is, nothing is checked.
  std::shared_ptr<const actuator::Actuator> prepared{};
};

/// A line (RS-485 pair) that some of a robot's actuators share, each with an id of its own.
struct BusConfig {
  std::string name;               ///< unique in the robot
  double baud_Hz = 2'000'000;     ///< of its units and of its master
  std::optional<double> cycle_s;  ///< none: automatic, max(wire time, 1 ms × units)
  /// The bus belongs to an external client on this virtual serial port: no master, commands to its actuators are not taken, units
  /// hold their initial references until the client tells them otherwise. The port itself is opened by the host's program.
  std::optional<std::string> serial_port = std::nullopt;
  /// For clients that can't set a rate: whatever theirs is, they are heard. Else one at another rate than the units' sends noise.
  bool any_rate = false;
};

/// What the element orders to be written while the robot runs. For the host's program, as the serial port is.
struct RecordConfig {
  std::string directory;  ///< where to, as the text has it
  double rate_Hz = 100;   ///< samples per simulated second
};

inline constexpr int kMostSubsteps = 64;                                               ///< of RobotConfig::substeps
inline constexpr std::int64_t kLongestStep_ns = 16'000'000;                            ///< of Robot::advance
inline constexpr double kLongestStep_s = 1e-9 * static_cast<double>(kLongestStep_ns);  ///< the same in s

/// All of a robot, as config::parse_plugin() reads it from the plug-in element and a Robot takes it.
struct RobotConfig {
  std::vector<ActuatorConfig> actuators;  ///< in the order of all spans of Robot
  std::vector<BusConfig> buses;           ///< at least one; ActuatorConfig::bus leads here
  double state_rate_Hz = 100;             ///< of the topic joint_state and its like, per simulated second
  /// Steps that the host makes of each of its own, engine and actuators together, 1 … kMostSubsteps: advance() is then called for
  /// each. None: as the host likes. A host that can't do it refuses the robot.
  std::optional<int> substeps = std::nullopt;
  std::optional<RecordConfig> record = std::nullopt;      ///< none: nothing is recorded
  std::optional<std::uint16_t> view_port = std::nullopt;  ///< of the live page; 0: any free one. None: no page
  std::vector<std::string> notices{};                     ///< what its text has and should be told of: old spellings
};

/// Adds what no robot could have: its units' problems, IDs, buses, rates; what is there twice.
void validate(const RobotConfig& config, std::string_view where, Problems& problems);

}  // namespace vsa::host
