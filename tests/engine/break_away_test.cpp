// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Shafts that rub dry, with hardly a bristle, on light links: friction's edge is narrow beside what a step moves them.
#include <algorithm>
#include <cmath>

#include "worlds.hpp"

namespace vsa::engine::testing {
namespace {

/// Links of 1e-4 kg·m² on parallel axes, without gravity.
std::string chain(int joints, const std::string& type, const std::string& friction_Nm, const std::string& presliding_rad) {
  std::string links, actuators;
  for (int k = 0; k < joints; ++k) {
    const std::string n = std::to_string(k), parent = k == 0 ? "world" : "l" + std::to_string(k - 1);
    links += "<link name='l" + n + "'><pose>" + std::to_string(0.1 * k) + " 0 0 0 0 0</pose>" + inertial(0.01, 1e-4) +
             "</link><joint name='j" + n + "' type='revolute'><parent>" + parent + "</parent><child>l" + n +
             "</child><axis><xyz>0 0 1</xyz></axis></joint>";
    actuators += "<actuator><joint>j" + n + "</joint><type>" + type + "</type><override key='shaft.friction_Nm' value='" +
                 friction_Nm + "'/><override key='shaft.presliding_rad' value='" + presliding_rad + "'/></actuator>";
  }
  return world("<model name='m'>" + links + "<plugin name='vsa::Robot' filename='x'>" + actuators + "</plugin></model>", "0 0 0");
}

struct Seen {
  double fastest = 0, coupling = 0, moved = 0;
};
Seen commanded(const std::string& text, double step_s) {
  WorldOptions options;
  options.step_s = step_s;
  World w = World::load_string(text, options);
  Seen seen;
  for (int swing = 0; swing < 3; ++swing) {
    for (const ActuatorRef& a : w.actuators()) w.command(a, swing % 2 == 0 ? 0.6 : -0.6, 0.47);
    for (long k = std::lround(0.6 / step_s); k > 0; --k) {
      w.step();
      for (const ActuatorRef& a : w.actuators())
        seen.fastest = std::max(seen.fastest, std::abs(w.read(a.name).shaft_speed_rad_per_s));
    }
  }
  seen.coupling = w.ledger().coupling;
  seen.moved = w.ledger().moved();
  for (const host::Notice& n : w.robot(0).take_notices())
    for (const char* wrong : {"settle", "energy"}) EXPECT_EQ(n.text.find(wrong), std::string::npos) << step_s << " s: " << n.text;
  return seen;
}

class BreakAway : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Joints, BreakAway, ::testing::Values(1, 2, 4));

TEST_P(BreakAway, IsAsFastWithLongStepsAsWithShort) {
  for (const char* type : {"qbmove_maker_pro_6_1", "sea_example"}) {
    for (const char* presliding : {"0", "1e-4", "1e-3"}) {
      const std::string text = chain(GetParam(), type, "1", presliding);
      const Seen fine = commanded(text, 0.0005);
      for (const double step_s : {0.004, 0.002, 0.001}) {
        const Seen seen = commanded(text, step_s);
        EXPECT_LT(seen.fastest, 1.3 * fine.fastest + 0.5) << type << ", " << presliding << " rad, " << step_s << " s";
        EXPECT_GT(seen.coupling, -1e-3 * seen.moved) << type << ", " << presliding << " rad, " << step_s << " s";
      }
    }
  }
}

}  // namespace
}  // namespace vsa::engine::testing
