// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Chains of modules in series that hang from the world.
#pragma once

#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/config/plugin_draft.hpp"

namespace vsa::test {

struct SerialWorld {
  int joints = 2;
  std::string type = "qbmove_maker_pro_6_1";
  double preset = 0.785;
  double step_s = 1e-3;
  bool gravity = false;
  bool alternating = false;  ///< axes y, x, y, x …; else all y
  double mass_kg = 0.45, inertia_kgm2 = 3.3e-4, length_m = 0.08;
  double last_mass_kg = 0, last_inertia_kgm2 = 0;  ///< of the last link, where they differ
  double damping = 0, spring = 0;                  ///< of the host's own at every driven joint, N·m·s/rad and N·m/rad
  double passive_damping = 0, passive_spring = 0;  ///< of the others'
  bool passive_first = false;                      ///< j1 isn't driven
  bool implicit_damper = false;                    ///< asks ODE in Gazebo Classic to take springs and dampers implicitly
  std::string overrides;                           ///< <override …/> elements for every actuator
  std::vector<int> robots;                         ///< how many joints each drives; empty: one drives all. What is left is passive

  [[nodiscard]] int driven() const {
    return robots.empty() ? joints - first_driven() + 1 : std::accumulate(robots.begin(), robots.end(), 0);
  }
  [[nodiscard]] int first_driven() const { return passive_first ? 2 : 1; }
  [[nodiscard]] bool drives(int joint) const { return joint >= first_driven() && joint < first_driven() + driven(); }
};

/// <model name='m'> with links l0, l1 … and joints j1, j2 …, and its robots. Joints slide where the type does; one that has no preset
/// gets none.
inline std::string serial_model(const SerialWorld& w) {
  const device::UnitConfig unit = config::TypeLibrary().load(w.type).unit;
  std::ostringstream s;
  s.precision(17);
  s << "<model name='m'><link name='l0'><inertial><mass>1</mass></inertial></link>"
    << "<joint name='fix' type='fixed'><parent>world</parent><child>l0</child></joint>";
  for (int i = 1; i <= w.joints; ++i) {
    const bool last = i == w.joints;
    const double mass = last && w.last_mass_kg > 0 ? w.last_mass_kg : w.mass_kg;
    const double inertia = last && w.last_inertia_kgm2 > 0 ? w.last_inertia_kgm2 : w.inertia_kgm2;
    s << "<link name='l" << i << "'><pose>0 0 " << -w.length_m * (i - 1) << " 0 0 0</pose><inertial><pose>0 0 " << -w.length_m / 2
      << " 0 0 0</pose><mass>" << mass << "</mass><inertia><ixx>" << inertia << "</ixx><iyy>" << inertia << "</iyy><izz>" << inertia
      << "</izz></inertia></inertial></link><joint name='j" << i << "' type='"
      << (unit.actuator.linear() ? "prismatic" : "revolute") << "'><parent>l" << i - 1 << "</parent><child>l" << i
      << "</child><axis><xyz>" << (w.alternating && i % 2 == 0 ? "1 0 0" : "0 1 0") << "</xyz>";
    const double damping = w.drives(i) ? w.damping : w.passive_damping, spring = w.drives(i) ? w.spring : w.passive_spring;
    if (damping > 0 || spring > 0)
      s << "<dynamics><damping>" << damping << "</damping><spring_reference>0</spring_reference><spring_stiffness>" << spring
        << "</spring_stiffness></dynamics>";
    s << "</axis>";
    if (w.implicit_damper) s << "<physics><ode><implicit_spring_damper>1</implicit_spring_damper></ode></physics>";
    s << "</joint>";
  }
  int i = w.first_driven() - 1;
  for (const int count : w.robots.empty() ? std::vector{w.driven()} : w.robots) {
    s << "<plugin name='vsa::Robot' filename='libvsa-robot.so'>";
    for (const int end = i + count; i < end;) {
      ++i;
      s << "<actuator><joint>j" << i << "</joint><type>" << w.type << "</type><bus id='" << i << "'>b</bus><initial "
        << (unit.actuator.linear() ? "equilibrium_m" : "equilibrium_rad") << "='0'";
      const std::string preset = config::preset_attribute(unit.preset_unit());
      if (!preset.empty()) s << " " << preset << "='" << w.preset << "'";
      s << "/>" << w.overrides << "</actuator>";
    }
    s << "<bus name='b'/></plugin>";
  }
  s << "</model>";
  return s.str();
}

inline std::string serial_world(const SerialWorld& w) {
  std::ostringstream s;
  s.precision(17);
  s << "<sdf version='1.7'><world name='w'><gravity>0 0 " << (w.gravity ? "-9.81" : "0")
    << "</gravity><physics name='p' type='ode'><max_step_size>" << w.step_s << "</max_step_size></physics>" << serial_model(w)
    << "</world></sdf>";
  return s.str();
}

}  // namespace vsa::test
