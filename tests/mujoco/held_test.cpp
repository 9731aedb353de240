// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Springs that a step doesn't resolve, on joints that stops, friction and the ground hold: in a MuJoCo that steps the plug-in's units they
// rest, as in the embedded engine (docs/explanation/7-host.md, "What holds stiff joints").
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "rig.hpp"

namespace vsa::mujoco::test {
namespace {

struct Held {
  std::string type, joint, around;  // actuator type, the hinge's attributes, what else is in the world
  double moment_kgm2, step_s, begin_rad, command_rad;
};

constexpr const char* kTwoControls = "anydrive_ad119e20";  // the second is its stiffness

/// One light link about y with a ball at its end, 0.1 m from the hinge.
std::string mjcf(const Held& h) {
  constexpr double kCentre_m = 0.07;
  const double half = h.moment_kgm2 / 2;
  std::ostringstream out;
  out << "<mujoco><extension><plugin plugin=\"vsasim.unit\"><instance name=\"u\"><config key=\"type\" value=\"" << h.type
      << "\"/></instance></plugin></extension><option gravity=\"0 0 0\" timestep=\"" << h.step_s << "\"/><worldbody>" << h.around
      << "<body><joint name=\"j\" axis=\"0 1 0\" " << h.joint << "/><inertial mass=\"" << half / (kCentre_m * kCentre_m)
      << "\" pos=\"" << kCentre_m << " 0 0\" diaginertia=\"" << half << ' ' << half << ' ' << half
      << "\"/><geom type=\"sphere\" size=\"0.01\" pos=\"0.1 0 0\" mass=\"0\"/></body></worldbody><actuator>";
  for (const char* name : {"e", "p"}) {
    if (*name == 'e' || h.type == kTwoControls)
      out << "<plugin name=\"" << name << "\" joint=\"j\" plugin=\"vsasim.unit\" instance=\"u\"/>";
  }
  out << "</actuator></mujoco>";
  return out.str();
}

/// rms speed of the last 0.3 s of 3 s, rad/s.
double restlessness(const Held& h) {
  const Rig rig(mjcf(h));
  Data data(rig);
  data.d().qpos[0] = h.begin_rad;
  data.d().ctrl[0] = h.command_rad;
  const int last = static_cast<int>(std::lround(0.3 / h.step_s));
  for (int k = static_cast<int>(std::lround(2.7 / h.step_s)); k > 0; --k) data.step();
  double squares = 0;
  for (int k = 0; k < last; ++k) {
    data.step();
    squares += data.d().qvel[0] * data.d().qvel[0];
  }
  for (const std::string& line : data.told)
    EXPECT_NE(line.find("swings with ω·dt"), std::string::npos)
        << h.type << ", " << h.moment_kgm2 << " kg·m², " << h.step_s << " s: " << line;
  return std::sqrt(squares / last);
}

constexpr const char* kStop =
    R"(limited="true" range="-17.188734 17.188734" solreflimit="0.004 1" solimplimit="0.9999 0.9999 0.001")";  // 0.3 rad, as exported

void expect_rest(const std::string& joint, const std::string& around, double begin_rad, double command_rad) {
  for (const char* type : {"tree_orange_100", "hebi_x8_9", kTwoControls}) {
    for (const double moment : {1e-4, 1e-3, 1e-2}) {
      for (const double step_s : {1e-3, 2e-3}) {
        EXPECT_LT(restlessness({type, joint, around, moment, step_s, begin_rad, command_rad}), 0.02)
            << type << ", " << moment << " kg·m², " << step_s << " s";
      }
    }
  }
}

TEST(Held, PressedOnAStopRests) { expect_rest(kStop, "", 0.29, 0.31); }

TEST(Held, ThrownAtAStopRests) { expect_rest(kStop, "", 0, 1.0); }

TEST(Held, OnABlockItRests) { expect_rest("", R"(<geom type="box" size="0.02 0.02 0.005" pos="0.1 0 -0.03"/>)", 0, 0.4); }

TEST(Held, InDryFrictionItRests) { expect_rest(R"(frictionloss="0.3")", "", 0, 0.2); }

/// Two fingers on a world's two hinges, each pressing from its side on a ball that nothing else holds.
TEST(Held, TwoFingersHoldAThing) {
  for (const char* type : {"tree_orange_100", "hebi_x8_9"}) {
    for (const double step_s : {5e-4, 1e-3, 2e-3}) {
      std::ostringstream out;
      out << "<mujoco><extension><plugin plugin=\"vsasim.unit\">";
      for (const char* name : {"a", "b"})
        out << "<instance name=\"" << name << "\"><config key=\"type\" value=\"" << type << "\"/></instance>";
      out << "</plugin></extension><option gravity=\"0 0 0\" timestep=\"" << step_s
          << "\"/><default><geom solref=\"0.004 1\"/></default><worldbody>";
      for (const char* name : {"a", "b"}) {
        const double x = *name == 'a' ? -0.025 : 0.025;
        out << "<body pos=\"" << x << " 0 0\"><joint name=\"" << name
            << "\" axis=\"0 1 0\"/><inertial mass=\"0.05\" pos=\"0 0 0.04\" diaginertia=\"3e-5 3e-5 3e-5\"/>"
            << "<geom type=\"capsule\" size=\"0.005\" fromto=\"0 0 0.01 0 0 0.08\" mass=\"0\"/></body>";
      }
      out << "<body pos=\"0 0 0.06\"><freejoint/><geom type=\"sphere\" size=\"0.0195\" "
             "mass=\"0.02\"/></body></worldbody><actuator>";
      for (const char* name : {"a", "b"})
        out << "<plugin joint=\"" << name << "\" plugin=\"vsasim.unit\" instance=\"" << name << "\"/>";
      out << "</actuator></mujoco>";
      const Rig rig(out.str());
      Data data(rig);
      data.d().ctrl[0] = 0.01;
      data.d().ctrl[1] = -0.01;
      for (int k = static_cast<int>(std::lround(1.5 / step_s)); k > 0; --k) data.step();
      const std::string what = std::string(type) + ", " + std::to_string(step_s) + " s";
      EXPECT_LT(std::abs(data.d().qvel[0]) + std::abs(data.d().qvel[1]), 0.05) << what;
      EXPECT_NEAR(data.d().qpos[2], 0, 0.004) << what;
      EXPECT_GE(data.d().ncon, 2) << what;
      for (const std::string& line : data.told) EXPECT_NE(line.find("swings with ω·dt"), std::string::npos) << what << ": " << line;
    }
  }
}

/// What torques are tried with leaves nothing behind that decides the future.
TEST(Held, ForwardChangesNothingHoweverOften) {
  const Rig rig(mjcf({"hebi_x8_9", kStop, "", 1e-4, 1e-3, 0, 1.0}));
  Data data(rig), other(rig);
  data.d().ctrl[0] = other.d().ctrl[0] = 1.0;
  for (int k = 0; k < 600; ++k) {
    const std::vector<double> here = other.all();
    other.forward();
    other.set_all(here);
    data.step();
    other.step();
    ASSERT_EQ(data.all(), other.all()) << "step " << k;
  }
  EXPECT_GT(data.d().qpos[0], 0.29);
}

}  // namespace
}  // namespace vsa::mujoco::test
