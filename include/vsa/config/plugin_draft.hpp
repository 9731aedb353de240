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

inline constexpr int kMaxId = 254;
inline constexpr std::string_view kPresetPrefix = "preset";
inline constexpr const char* kDefaultBus = "bus";

struct ActuatorDraft {
  std::string path;  ///< "actuator[shoulder]"
  std::string name, joint, type;
  bool name_ok = false;
  std::string bus;        ///< empty: the only one
  std::optional<int> id;  ///< none: the next free one
  bool id_ok = true;
  double initial_equilibrium = 0, initial_preset = 0;
  bool equilibrium_given = false;
  std::string equilibrium_key;     ///< "equilibrium_rad", "equilibrium_m"; empty: not given
  std::string initial_preset_key;  ///< "preset_rad"; empty: not given
  std::vector<Override> overrides;
  std::map<std::string, std::string> tag_of;   ///< keys of overrides that an older plug-in's tag gave, and that tag
  bool motor_at_pulley = false;                ///< such a tag gave values of a motor without a gearbox
  std::map<std::string, std::string> flag_of;  ///< keys of overrides that a Replacement gave, and its flag
  bool replaced = false;                       ///< the type isn't the element's own: its initial preset may not fit
};

struct BusDraft {
  std::string path, name;
  double baud_Hz = 2'000'000;
  std::optional<double> cycle_s;
  std::optional<std::string> serial_port;
  bool any_rate = false;
};

struct RobotDraft {
  std::vector<ActuatorDraft> actuators;
  std::vector<BusDraft> buses;
  double state_rate_Hz = 100;
  std::optional<int> substeps;
  std::optional<host::RecordConfig> record;
  std::optional<std::uint16_t> view_port;
  std::vector<std::string> notices;
  bool answered = false;  ///< the element is an older plug-in's, and the problem says so
};

/// How <initial> calls a preset of that unit: "preset_rad", of N·m/rad "preset_Nm_per_rad". Empty: there is no preset.
[[nodiscard]] std::string preset_attribute(std::string_view unit);

/// Adds every problem, each behind `where` and its draft's path; the robot is complete only where there was none.
[[nodiscard]] host::RobotConfig finish(const RobotDraft& draft, std::string_view where, const TypeLibrary& types,
                                       Problems& problems);

}  // namespace vsa::config
