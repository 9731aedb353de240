// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A plate of 10 kg over a fixed base, along or about z: what a linear actuator drives, in every simulator.
#pragma once

#include <string>

namespace vsa::test {

/// `joint`: prismatic or revolute; its name is "slide", the model's "press".
inline std::string press_model(const std::string& joint, const std::string& type) {
  return "<model name='press'><link name='base'><inertial><mass>5</mass></inertial></link>"
         "<link name='plate'><pose>0 0 0.3 0 0 0</pose><inertial><mass>10</mass></inertial></link>"
         "<joint name='foot' type='fixed'><parent>world</parent><child>base</child></joint>"
         "<joint name='slide' type='" +
         joint +
         "'><parent>base</parent><child>plate</child><axis><xyz>0 0 1</xyz></axis></joint>"
         "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator name='ram'><joint>slide</joint><type>" +
         type + "</type></actuator></plugin></model>";
}

/// Where linear_sea_example holds it: its weight over the servo's 10 kN/m, within what friction hides.
inline constexpr double kPressSag_m = 10 * 9.8 / 1e4, kPressSlack_m = 4e-4;

}  // namespace vsa::test
