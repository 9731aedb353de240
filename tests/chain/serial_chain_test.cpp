// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Several stiff joints in series, kicked hard: the largest preset, links lighter than a qbmove.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "vsa/engine/world.hpp"

namespace {

using vsa::engine::World;

/// `links` links of 80 mm hanging on each other sideways, about parallel axes, every joint an unpowered unit at the largest preset.
std::string chain(const std::string& type, int links, double inertia_kgm2, double step_s) {
  std::ostringstream s;
  s << "<sdf version='1.7'><world name='w'><gravity>0 0 0</gravity><physics name='p' type='ode'><max_step_size>" << step_s
    << "</max_step_size></physics><model name='m'><link name='l0'><inertial><mass>1</mass></inertial></link>"
    << "<joint name='fix' type='fixed'><parent>world</parent><child>l0</child></joint>";
  for (int i = 1; i <= links; ++i) {
    s << "<link name='l" << i << "'><pose>" << 0.08 * (i - 1) << " 0 0 0 0 0</pose><inertial><pose>0.04 0 0 0 0 0</pose><mass>"
      << 200 * inertia_kgm2 << "</mass><inertia><ixx>" << inertia_kgm2 << "</ixx><iyy>" << inertia_kgm2 << "</iyy><izz>"
      << inertia_kgm2 << "</izz></inertia></inertial></link><joint name='j" << i << "' type='revolute'><parent>l" << i - 1
      << "</parent><child>l" << i << "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  }
  s << "<plugin name='vsa::Robot' filename='libvsa-robot.so'>";
  for (int i = 1; i <= links; ++i) {
    s << "<actuator><joint>j" << i << "</joint><type>" << type << "</type><bus id='" << i
      << "'>b</bus><initial equilibrium_rad='0' preset_rad='0.785'/></actuator>";
  }
  s << "<bus name='b'/></plugin></model></world></sdf>";
  return s.str();
}

/// The largest energy there ever was over what the kick put into the springs.
double growth(const std::string& type, int links, double inertia_kgm2, double step_s, double kick_rad) {
  World w = World::load_string(chain(type, links, inertia_kgm2, step_s));
  w.robot(0).set_supply(false);
  for (int i = 1; i <= links; ++i) w.set_joint("m::j" + std::to_string(i), i % 2 ? kick_rad : -kick_rad, 0);
  const auto energy = [&] { return w.energy().kinetic + w.ledger().stored(); };
  w.step();
  const double first = w.ledger().stored_at_start;
  double largest = 0;
  while (w.time_s() < 1.0) {
    w.step();
    largest = std::max(largest, energy());
  }
  return largest / first;
}

TEST(SerialChain, OfModulesKickedHardAtTheLargestPresetNeverGainsEnergy) {
  // 1e-3 kg·m², 0.2 kg: lighter than a qbmove. Half a radian at p = 0.785 rad is 11 J a joint.
  for (const char* type : {"qbmove_maker_pro_6_1", "qbmove_maker_pro_paper"}) {
    for (const int links : {2, 4, 8}) {
      EXPECT_LE(growth(type, links, 1e-3, 1e-3, 0.5), 1.0) << type << ' ' << links;
      EXPECT_LE(growth(type, links, 1e-3, 2e-3, 0.2), 1.0) << type << ' ' << links;
    }
  }
}

TEST(SerialChain, OfBareFlangesGainsNoMoreThanTheStepsInWhichItFolds) {
  // 0.02 kg: speeds of 100 rad/s fold the chain within few steps, and with it B.
  for (const char* type : {"qbmove_maker_pro_6_1", "qbmove_maker_pro_paper"}) {
    for (const int links : {2, 4, 8}) {
      for (const double step_s : {0.5e-3, 1e-3, 4e-3})
        EXPECT_LE(growth(type, links, 1e-4, step_s, 0.2), 1.01) << type << ' ' << links;
    }
  }
}

}  // namespace
