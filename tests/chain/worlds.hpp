// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Small worlds for tests of the whole chain: SDF → engine → robot.
#pragma once

#include <sstream>
#include <string>

namespace vsa::test {

struct FlangeWorld {
  double inertia_kgm2 = 4e-4;
  double preset_rad = 0.611;
  double step_s = 1e-3;
  bool losses = true;
  std::string type = "qbmove_maker_pro_6_1";
  bool gravity = false;
  double mass_kg = 0.05, arm_m = 0.0;  ///< centre of mass of the flange from the axis
  double friction_Nm = 0.8;
};

inline std::string over(const char* key, double value) {
  std::ostringstream s;
  s << "<override key='" << key << "' value='" << value << "'/>";
  return s.str();
}

/// One unit fixed to the world, its flange turning about y. Without losses the motors are locked by their own inertia.
inline std::string flange_world(const FlangeWorld& w) {
  std::ostringstream s;
  s.precision(17);
  // The inertia about the joint's axis is what the test asks for; the other axes only have to be physical.
  const double about_com = w.inertia_kgm2 - w.mass_kg * w.arm_m * w.arm_m;
  s << "<?xml version='1.0'?><sdf version='1.7'><world name='w'><gravity>0 0 " << (w.gravity ? "-9.81" : "0") << "</gravity>"
    << "<physics name='p' type='ode'><max_step_size>" << w.step_s << "</max_step_size></physics>"
    << "<model name='unit'><link name='housing'><inertial><mass>1</mass><inertia><ixx>1e-3</ixx><iyy>1e-3</iyy><izz>1e-3</izz>"
    << "</inertia></inertial></link><joint name='fix' type='fixed'><parent>world</parent><child>housing</child></joint>"
    << "<link name='flange'><inertial><pose>0 0 " << -w.arm_m << " 0 0 0</pose><mass>" << w.mass_kg << "</mass><inertia><ixx>"
    << about_com << "</ixx><iyy>" << about_com << "</iyy><izz>" << about_com << "</izz></inertia></inertial></link>"
    << "<joint name='shaft' type='revolute'><parent>housing</parent><child>flange</child><axis><xyz>0 -1 0</xyz></axis></joint>"
    << "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator name='a'><joint>shaft</joint><type>" << w.type
    << "</type><bus id='1'>b</bus><initial equilibrium_rad='0' preset_rad='" << w.preset_rad << "'/>";
  if (!w.losses) {
    // Locked pulleys: the bounds don't allow infinite inertia, so the gear ratio multiplies it.
    s << over("drive.friction_Nm", 0) << over("drive.load_loss", 0) << over("tendon.friction", 0)
      << over("drive.viscous_Nms_per_rad", 0) << over("shaft.friction_Nm", 0) << over("drive.inertia_kgm2", 0.1)
      << over("drive.gear_ratio", 1000) << over("drive.supply_V", 0) << over("drive.off_mode", 0);
  } else {
    s << over("drive.friction_Nm", w.friction_Nm);
  }
  s << "</actuator><bus name='b'/></plugin></model></world></sdf>";
  std::string text = s.str();
  const std::string numeric = over("drive.off_mode", 0);
  if (const auto at = text.find(numeric); at != std::string::npos)
    text.replace(at, numeric.size(), "<override key='drive.off_mode' value='coast'/>");
  return text;
}

}  // namespace vsa::test
