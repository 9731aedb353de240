// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The plug-in element as written, form checked, and what makes a robot of it: types, names, buses, ids. For who has a robot's words
// otherwise than in an element (plugins/mujoco).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::config {

inline constexpr int kMaxId = 254;                           ///< largest device id on a line; the smallest is 1
inline constexpr std::string_view kPresetPrefix = "preset";  ///< of the attribute that says an initial preset: "preset_rad"
inline constexpr const char* kDefaultBus = "bus";            ///< name of the only line of an element that declares none

/// An actuator as it is said: whether its words are right in themselves, not yet whether they go together.
struct ActuatorDraft {
  std::string path;                            ///< "actuator[shoulder]", for problems
  std::string name;                            ///< of the actuator
  std::string joint;                           ///< that it drives, scoped
  std::string type;                            ///< its actuator type
  bool name_ok = false;                        ///< the name is one; else what is wrong with it has been told
  std::string bus;                             ///< empty: the only one
  std::optional<int> id;                       ///< none: the next free one
  bool id_ok = true;                           ///< as name_ok
  double initial_equilibrium = 0;              ///< rad, of a linear actuator m
  double initial_preset = 0;                   ///< in the preset unit of the law
  bool equilibrium_given = false;              ///< else its joint's start counts, where there is one
  std::string equilibrium_key;                 ///< "equilibrium_rad", "equilibrium_m"; empty: not given
  std::string initial_preset_key;              ///< "preset_rad"; empty: not given
  std::vector<Override> overrides;             ///< of the type's values, in the order that they are said
  std::map<std::string, std::string> tag_of;   ///< keys of overrides that an older plug-in's tag gave, and that tag
  bool motor_at_pulley = false;                ///< such a tag gave values of a motor without a gearbox
  std::map<std::string, std::string> flag_of;  ///< keys of overrides that a Replacement gave, and its flag
  bool replaced = false;                       ///< the type isn't the element's own: its initial preset may not fit
};

/// An RS-485 line as it is said.
struct BusDraft {
  std::string path;                        ///< "bus[arm]", for problems
  std::string name;                        ///< that actuators give
  double baud_Hz = 2'000'000;              ///< bits per second
  std::optional<double> cycle_s;           ///< of the line's master; none: by the wire and the units ("auto")
  std::optional<std::string> serial_port;  ///< given: an external client is the master
  bool any_rate = false;                   ///< that client is heard whatever rate its port is set to
};

/// All that an element says of a robot.
struct RobotDraft {
  std::vector<ActuatorDraft> actuators;      ///< in the order of topics and recordings
  std::vector<BusDraft> buses;               ///< empty: one by the name of kDefaultBus
  double state_rate_Hz = 100;                ///< of the state topics
  std::optional<int> substeps;               ///< of a step of the world; none: what another robot of it asks for, or 1
  std::optional<host::RecordConfig> record;  ///< none: nothing is recorded
  std::optional<std::uint16_t> view_port;    ///< none: no live page; 0: any free port
  std::vector<std::string> notices;          ///< for the user, once
  bool answered = false;                     ///< the element is an older plug-in's, and the problem says so
};

/// How `<initial>` calls a preset of that unit: "preset_rad", of N·m/rad "preset_Nm_per_rad". Empty: there is no preset.
[[nodiscard]] std::string preset_attribute(std::string_view unit);

/// Adds every problem, each behind `where` and its draft's path; the robot is complete only where there was none.
[[nodiscard]] host::RobotConfig finish(const RobotDraft& draft, std::string_view where, const TypeLibrary& types,
                                       Problems& problems);

}  // namespace vsa::config
