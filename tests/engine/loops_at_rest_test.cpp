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

double apart(const World& w, const FourBar& f) {
  const FourBar::Posture zero = f.at(0);
  return distance(point(pose_of(w, "m::coupler"), {zero.b.x - zero.a.x, 0, zero.b.z - zero.a.z}),
                  point(pose_of(w, "m::rocker"), {zero.b.x - f.ground, 0, zero.b.z}));
}

/// Left open, it was pulled together within a step: the bars flew.
TEST(LoopsAtRest, AnActuatorPutElsewhereTakesItsLoopAlongAndIsntThrown) {
  const FourBar f;
  for (const double to : {0.2, 1.5, -2.0}) {
    World w = World::load_string(crank_driven(f, "0 0 0", {"o"}));
    w.run(0.05);
    w.place("o", to, 0.4);
    EXPECT_NEAR(w.joint_angle("m::p"), f.at(to).rocker - f.at(0).rocker, 1e-8);
    EXPECT_LT(apart(w, f), 1e-8);
    double fastest = 0;
    for (int n = 0; n < 200; ++n) {
      w.step();
      fastest = std::max(fastest, w.energy().kinetic);
    }
    EXPECT_LT(fastest, 1e-6) << to;
    EXPECT_LT(apart(w, f), 1e-5);
  }
}

TEST(LoopsAtRest, AnActuatorPutSomewhereWithASpeedMovesItsLoop) {
  const FourBar f;
  World w = World::load_string(crank_driven(f, "0 0 0", {"o"}));
  w.place("o", 0.5, 0.2, 1.5);
  const FourBar::Posture slope = f.slope(0.5 - 0.5 * w.step_s() * 1.5);  // where the engine's speeds belong
  EXPECT_NEAR(w.joint_speed("m::p"), 1.5 * slope.rocker, 1e-6);
  EXPECT_NEAR(w.joint_speed("m::a"), 1.5 * (slope.coupler - 1), 1e-6);
}

TEST(LoopsAtRest, AnActuatorIsntPutWhereItsLoopDoesntGet) {
  World w = World::load_string(crank_driven({}, "0 0 0", {"p"}));
  w.run(0.05);
  const std::uint64_t before = w.state_hash();
  try {
    w.place("p", 2.0, 0.4);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("p: angle_rad = 2: isn't reached: the loop that m::b closes would open"),
              std::string::npos)
        << e.what();
  }
  EXPECT_EQ(w.state_hash(), before);
  EXPECT_NO_THROW(w.place("p", 0.1, 0.4));
}

TEST(LoopsAtRest, TwoActuatorsOfALoopThatArePutStayWhereTheyWere) {
  const FourBar f;
  World w = World::load_string(crank_driven(f, "0 0 0", {"o", "p"}));
  const double rocker = f.at(0.7).rocker - f.at(0).rocker;
  w.place("o", 0.7, 0.4);
  w.place("p", rocker, 0.4);
  EXPECT_EQ(w.joint_angle("m::o"), 0.7);
  EXPECT_EQ(w.joint_angle("m::p"), rocker);
  EXPECT_LT(apart(w, f), 1e-8);
  w.run(0.2);
  EXPECT_LT(w.energy().kinetic, 1e-6);
}

}  // namespace
}  // namespace vsa::engine::testing
