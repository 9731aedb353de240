// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Strong dampers of light links (dt·d beyond the inertia) beside followers, which MuJoCo has as constraints: by itself it
// solves those as if there were no dampers in the step, and such robots gained energy.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

std::string finger(const std::string& name, const std::string& parent, double y, const std::string& axis) {
  return "<link name='" + name + "'><pose>0 " + std::to_string(y) + " 0 0 0 0</pose>" + inertial(0.017, 5e-6, "0 0 -0.02 0 0 0") +
         "</link><joint name='j_" + name + "' type='revolute'><parent>" + parent + "</parent><child>" + name + "</child><axis>" +
         "<xyz>1 0 0</xyz>" + axis + "</axis></joint>";
}

std::string follows(double multiplier) {
  return "<mimic joint='j_leader'><multiplier>" + std::to_string(multiplier) + "</multiplier></mimic>";
}

/// Two fingers of two links each, as parallel grippers have them: all follow one joint.
World gripper(double damping, int followers, double step_s) {
  std::ostringstream s;
  s << "<sdf version='1.11'><world name='w'><gravity>0 0 -9.81</gravity><physics name='p' type='ode'><max_step_size>" << step_s
    << "</max_step_size></physics><model name='m'><link name='palm'>" << inertial(1, 1e-2)
    << "</link><joint name='fix' type='fixed'><parent>world</parent><child>palm</child></joint>"
    << finger("leader", "palm", 0, "<dynamics><damping>" + std::to_string(damping) + "</damping></dynamics>")
    << finger("left", "palm", 0.03, follows(1));
  if (followers > 1) s << finger("left_tip", "left", 0.03, follows(-1));
  if (followers > 2) s << finger("right", "palm", -0.03, follows(-1)) << finger("right_tip", "right", -0.03, follows(1));
  s << "</model></world></sdf>";
  return World::load_string(s.str());
}

double total(const World& w) {
  const scene::Energy e = w.energy();
  return e.kinetic + e.gravitational + e.springs;
}

TEST(Dampers, OfALeaderTakeEnergyFromItsFollowersToo) {
  for (const double damping : {0.003, 0.03, 0.3, 3.0}) {
    for (const int followers : {1, 2, 4}) {
      for (const double step_s : {1e-3, 4e-3}) {
        World w = gripper(damping, followers, step_s);
        w.set_joint(w.joint("m::j_leader"), 0.3, 2.0);
        const double begun = total(w);
        double most = begun, fastest = 0;
        for (double t = 0; t < 1; t += step_s) {
          w.step();
          most = std::max(most, total(w));
          fastest = std::max(fastest, std::abs(w.joint_speed("m::j_left")));
        }
        // 0.3 rad in a soft tie of 4 ms is a millijoule at most; what gained energy had joules.
        EXPECT_LT(most - begun, 2e-4) << damping << ", " << followers << ", " << step_s;
        EXPECT_LT(fastest, 2 * 2.0 + 1) << damping << ", " << followers << ", " << step_s;
      }
    }
  }
}

}  // namespace
}  // namespace vsa::engine::testing
