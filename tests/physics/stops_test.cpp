// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Joint stops under an actuator's torque.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "vsa/engine/world.hpp"

namespace {

using vsa::engine::World;

/// A finger of this inertia whose joint ends at 0.3 rad, pressed against its stop by a unit that wants to be at 0.9 rad.
std::string pressed(double inertia_kgm2, double step_s) {
  std::ostringstream s;
  s << "<sdf version='1.7'><world name='w'><gravity>0 0 0</gravity><physics name='p' type='ode'><max_step_size>" << step_s
    << "</max_step_size></physics><model name='m'><link name='base'><inertial><mass>1</mass></inertial></link>"
    << "<joint name='fix' type='fixed'><parent>world</parent><child>base</child></joint><link name='finger'><inertial><mass>0.01"
    << "</mass><inertia><ixx>" << inertia_kgm2 << "</ixx><iyy>" << inertia_kgm2 << "</iyy><izz>" << inertia_kgm2
    << "</izz></inertia></inertial></link><joint name='j' type='revolute'><parent>base</parent><child>finger</child><axis><xyz>0 1 "
       "0"
    << "</xyz><limit><lower>-0.3</lower><upper>0.3</upper></limit></axis></joint>"
    << "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator "
       "name='a'><joint>j</joint><type>qbmove_maker_pro_6_1</type>"
    << "<bus id='1'>b</bus><initial equilibrium_rad='0' preset_rad='0.3'/></actuator><bus "
       "name='b'/></plugin></model></world></sdf>";
  return s.str();
}

TEST(Stops, HoldALightFingerThatAnActuatorPressesAgainstThem) {
  for (const double inertia : {4e-6, 2e-5, 1e-3}) {
    for (const double step_s : {1e-3, 2e-3, 4e-3}) {
      World world = World::load_string(pressed(inertia, step_s));
      world.command("a", 0.9, 0.3);
      world.run(2.0);
      const auto reading = world.read("a");
      EXPECT_GT(reading.mean_torque_Nm, 0.8) << inertia << " kg·m², " << step_s << " s: it presses";
      EXPECT_LT(world.joint_angle("m::j"), 0.3 + (step_s > 2e-3 ? 3e-3 : 1e-3)) << inertia << " kg·m², " << step_s << " s";
      EXPECT_GT(world.joint_angle("m::j"), 0.3) << inertia << " kg·m², " << step_s << " s";
      EXPECT_LT(std::abs(world.joint_speed("m::j")), 1e-3) << inertia << " kg·m², " << step_s << " s";
    }
  }
}

}  // namespace
