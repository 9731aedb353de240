// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What every robot has: shaft joints, the plug-in that lists its actuators, and the C-flange that holds a module by both its faces.
#pragma once

#include "module.hpp"

namespace vsa::generate {

inline constexpr Vec kUp{0, 0, 1};
inline constexpr double kTurningRoom = 0.052;  // from the axis to the C-flange's back: a housing's corner is at 47 mm

/// A shaft: its pose and axis in the child's frame, no stops.
void write_joint(Xml& xml, const std::string& name, const std::string& parent, const std::string& child, const Vec& at,
                 const Vec& axis);
/// Holds a link to the world.
void write_mount(Xml& xml, const std::string& child);

struct PluginEntry {
  std::string name, joint;
};
/// Device ids 1, 2 … in the list's order, all on one bus.
void write_plugin(Xml& xml, const ActuatorSpec& a, const std::string& bus, double initial_preset,
                  const std::vector<PluginEntry>& list);

/// Begins a link with its pose in the model: x y z and yaw.
void begin_link(Xml& xml, const std::string& name, const Vec& at, double yaw_rad);

/// A C-flange around a module at the link's origin, whose shaft lies along `axis`, and a tube on it to the next module's housing at
/// `reach` along z (its sign is the way it goes). Frame: the shaft's middle.
void bracket_visuals(Xml& xml, const ModuleSpec& m, Axis axis, double reach);
/// Flange, C-flange and tube.
[[nodiscard]] Inertial bracket(const ModuleSpec& m, Axis axis, double reach, double mass_kg);
/// Flange and tube on a shaft along z, and the next module's housing at `reach` on top, its shaft along y.
[[nodiscard]] Inertial upright_module(const ModuleSpec& m, double reach);

}  // namespace vsa::generate
