// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Actuators on the cranks of kinematic loops: commanded and left alone they come to rest, and no energy comes out of nothing.
#include <cmath>

#include "arm.hpp"
#include "four_bar.hpp"

namespace vsa::engine::testing {
namespace {

struct Rest {
  double speed = 0,  ///< rms of the joints with an angle, the last half of 5 s, rad/s
      created = 0,   ///< of what the actuators moved
      moved = 0;
};

Rest rest_of(const std::string& sdf, double step_s, double preset) {
  WorldOptions options;
  options.step_s = step_s;
  World w = World::load_string(sdf, options);
  for (const ActuatorRef& a : w.actuators()) w.command(a, 0.4, preset);
  double sum = 0;
  int n = 0;
  while (w.time_s() < 5) {
    w.step();
    for (const JointInfo& j : w.joints())
      if (j.one_axis() && w.time_s() > 4.5) sum += std::pow(w.joint_speed(j.name), 2), ++n;
  }
  return {std::sqrt(sum / n), -w.ledger().coupling / w.ledger().moved(), w.ledger().moved()};
}

std::string crank_driven(const FourBar& f, const std::string& gravity, const std::vector<std::string>& joints) {
  std::string all;
  for (const std::string& j : joints)
    all += "<actuator name='" + j + "'><joint>" + j + "</joint><type>qbmove_maker_pro_6_1</type><bus>arm</bus></actuator>";
  return four_bar(f, {.gravity = gravity, .more = plugin(all)});
}

TEST(LoopsAtRest, ADrivenCrankIsQuiet) {
  for (const char* gravity : {"0 0 0", "0 0 -9.81"})
    for (const double step_s : {1e-3, 4e-3})
      for (const double preset : {0.2, 0.785}) {
        const Rest r = rest_of(crank_driven({}, gravity, {"o"}), step_s, preset);
        EXPECT_LT(r.speed, 0.02) << gravity << ", " << step_s << " s, " << preset;
        EXPECT_LT(r.created, 1e-3) << gravity << ", " << step_s << " s, " << preset;
        EXPECT_GT(r.moved, 0.01);
      }
}

/// Two drives on one freedom, each against the other's spring.
TEST(LoopsAtRest, TwoDrivenJointsOfALoopAreQuiet) {
  for (const double step_s : {1e-3, 4e-3}) {
    const Rest r = rest_of(crank_driven({}, "0 0 -9.81", {"o", "p"}), step_s, 0.2);
    EXPECT_LT(r.speed, 0.05) << step_s;
    EXPECT_LT(r.created, 1e-3) << step_s;
  }
}

/// Bars of 20 g: what the constraint takes from B counts most.
TEST(LoopsAtRest, ALightOneToo) {
  for (const double step_s : {1e-3, 4e-3}) {
    const Rest r =
        rest_of(crank_driven({.crank_kg = 0.02, .coupler_kg = 0.03, .rocker_kg = 0.025}, "0 0 -9.81", {"o"}), step_s, 0.4);
    EXPECT_LT(r.speed, 0.02) << step_s;
    EXPECT_LT(r.created, 1e-3) << step_s;
  }
}

/// At preset 0.1 the unit alone swings on for 10 s, so its loop does, as much as one link with what the loop's inertia amounts to there.
TEST(LoopsAtRest, ADrivenCrankSwingsAsOneLinkOfTheReducedInertia) {
  const FourBar f;
  for (const double step_s : {1e-3, 4e-3})
    for (const double to : {-0.5, 0.2}) {
      const std::string link = world("<model name='m'><link name='l'>" + inertial(0.01, f.inertia(to)) + "</link>" +
                                         hinge("o", "world", "l") + plugin(actuator("o")) + "</model>",
                                     "0 0 0");
      std::vector<double> late;
      for (const std::string& sdf : {link, four_bar(f, {.gravity = "0 0 0", .more = plugin(actuator("o"))})}) {
        WorldOptions options;
        options.step_s = step_s;
        World w = World::load_string(sdf, options);
        w.command("o", to, 0.1);
        double sum = 0;
        int n = 0;
        for (; w.time_s() < 5; w.step(), ++n) sum += w.time_s() > 4.5 ? std::pow(w.joint_speed("m::o"), 2) : 0;
        late.push_back(std::sqrt(2 * sum / n));
      }
      EXPECT_GT(late[0], 0.03);
      EXPECT_NEAR(late[1], late[0], 0.1 * late[0]) << step_s << " s, " << to;
    }
}

TEST(LoopsAtRest, AnActuatorPutElsewhereIsPulledBackAndBlowsNothingUp) {
  World w = World::load_string(crank_driven({}, "0 0 -9.81", {"o"}));
  w.place("o", 0.2, 0.4);
  ASSERT_NO_THROW(w.run(1.0));
  const FourBar f;
  const FourBar::Posture zero = f.at(0);
  EXPECT_LT(distance(point(pose_of(w, "m::coupler"), {zero.b.x - zero.a.x, 0, zero.b.z - zero.a.z}),
                     point(pose_of(w, "m::rocker"), {zero.b.x - f.ground, 0, zero.b.z})),
            1e-4);
}

}  // namespace
}  // namespace vsa::engine::testing
