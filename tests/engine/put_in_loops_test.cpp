// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A joint that is put somewhere takes its own kinematic loops along, and nothing else.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>

#include "arm.hpp"
#include "four_bar.hpp"

namespace vsa::engine::testing {
namespace {

World load(const std::string& sdf) { return World::load_string(sdf); }

std::string driven(const std::vector<std::string>& joints) {
  std::string all;
  for (const std::string& j : joints)
    all += "<actuator name='" + j + "'><joint>" + j + "</joint><type>qbmove_maker_pro_6_1</type><bus>arm</bus></actuator>";
  return plugin(all);
}

/// Beside the linkage, a link on a joint j of its own, with an actuator.
std::string with_a_lone_joint(const FourBarFile& file) {
  std::string all = four_bar({}, file);
  return all.insert(all.find("</world>"), "<model name='q'><pose>0 3 0 0 0 0</pose><link name='l'>" + inertial(0.2, 1e-3) +
                                              "</link>" + hinge("j", "world", "l") + driven({"j"}) + "</model>");
}

double other_side(const FourBar& f, double crank) { return std::remainder(f.at(crank).rocker - f.at(0).rocker, 2 * M_PI); }

std::string refusal(World& w, const char* actuator, double angle, double speed = 0) {
  const std::uint64_t before = w.state_hash();
  std::string told;
  try {
    w.place(actuator, angle, 0.4, speed);
  } catch (const InputError& e) {
    told = e.what();
  }
  EXPECT_EQ(w.state_hash() == before, !told.empty());
  return told;
}

TEST(PutInLoops, AJointElsewhereLeavesThemAlone) {
  World w = load(with_a_lone_joint({.gravity = "0 0 0"}));
  w.set_joint("m::o", 0.5, 20);
  w.run(0.1);
  World alone = w.clone();
  for (int n = 0; n < 50; ++n) {
    w.place("j", 0.3, 0.3);
    w.step();
    alone.step();
  }
  for (const char* j : {"m::o", "m::a", "m::p"}) {
    EXPECT_EQ(w.joint_angle(j), alone.joint_angle(j)) << j;
    EXPECT_EQ(w.joint_speed(j), alone.joint_speed(j)) << j;
  }
  EXPECT_GT(w.energy().kinetic, 0.1);
}

TEST(PutInLoops, WhoIsPutWhereItIsMovesNothing) {
  World w = load(four_bar({}, {.gravity = "0 0 0"}));
  w.set_joint("m::o", 0.5, 20);
  w.run(0.1);
  World left = w.clone();
  for (int n = 0; n < 50; ++n) {
    w.set_joint("m::o", w.joint_angle("m::o"), w.joint_speed("m::o"));
    w.step();
    left.step();
  }
  EXPECT_EQ(w.state_hash(), left.state_hash());
}

TEST(PutInLoops, SpeedsAreThoseWithWhichTheEngineGoesOn) {
  World w = load(four_bar({}, {.gravity = "0 0 0"}));
  w.set_joint("m::o", 0.5, 20);
  const double begun = w.energy().kinetic;
  double speed = 20;
  for (int n = 0; n < 200; ++n) {
    speed = w.joint_speed("m::o") + (n % 2 == 0 ? 1e-7 : -1e-7);
    w.set_joint("m::o", w.joint_angle("m::o"), speed);
    w.step();
  }
  EXPECT_NEAR(w.energy().kinetic, begun, 0.01 * begun) << "at the positions of now each of them takes a thousandth";
}

TEST(PutInLoops, AJointIsntTakenBeyondItsLimits) {
  FourBarFile file{.gravity = "0 0 0", .more = driven({"o"})};
  file.of_axis["p"] = "<limit><lower>-0.1</lower><upper>0.1</upper></limit>";
  World w = load(four_bar({}, file));
  const std::string told = refusal(w, "o", 0.9);
  EXPECT_NE(told.find("o: angle_rad = 0.9: takes m::p along, to 0.3"), std::string::npos) << told;
  EXPECT_NE(told.find("beyond its limits -0.1 … 0.1"), std::string::npos) << told;
  EXPECT_EQ(refusal(w, "o", 0.1), "");
}

TEST(PutInLoops, ARefusalLosesNoCommand) {
  World w = load(four_bar({}, {.gravity = "0 0 0", .more = driven({"o", "p"})}));
  w.run(0.1);
  w.command("o", 0.4, 0.3);
  w.command("p", 0.1, 0.3);
  EXPECT_NE(refusal(w, "p", 2.0), "");
  w.run(0.1);
  EXPECT_EQ(w.read("o").equilibrium_command_rad, 0.4);
  EXPECT_EQ(w.read("p").equilibrium_command_rad, 0.1);
  EXPECT_NE(refusal(w, "p", 0.1, 1e9), "") << "the unit's refusal, after the loops'";
}

void stays_in_its_assembly(const FourBar& f, std::initializer_list<double> crank) {
  World w = load(four_bar(f));
  for (const double at : crank) {
    w.set_joint("m::o", at, 0);
    EXPECT_NEAR(std::remainder(w.joint_angle("m::p") - other_side(f, at), 2 * M_PI), 0, 1e-6)
        << f.ground << ", " << f.crank << ", " << f.coupler << ", " << f.rocker << " at " << at;
  }
}

/// Of cranks that just turn over: they come near a straight line, where the assemblies meet.
TEST(PutInLoops, TheyStayInTheirAssembly) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> length(0.1, 0.4), angle(-3, 3);
  for (int tried = 0; tried < 20;) {
    const FourBar f{.ground = length(random), .crank = 0.1, .coupler = length(random), .rocker = length(random)};
    const double longest = std::max({f.ground, f.coupler, f.rocker}),
                 over = f.ground + f.coupler + f.rocker - 2 * longest - f.crank;  // by Grashof
    if (over < 1e-5 || over > 3e-3) continue;
    ++tried;
    stays_in_its_assembly(f, {angle(random), angle(random), angle(random), angle(random)});
  }
  // Those that steps of 0.05 rad lost.
  stays_in_its_assembly({.ground = 0.295, .crank = 0.144, .coupler = 0.334, .rocker = 0.184}, {-2.219, -4.823});
  stays_in_its_assembly({.ground = 0.266726133, .coupler = 0.371382083, .rocker = 0.204718996}, {2.09692063});
  stays_in_its_assembly({.ground = 0.140656579, .coupler = 0.297001384, .rocker = 0.256489308}, {1.87298208, 2.07034896});
  stays_in_its_assembly({.ground = 0.101213709, .coupler = 0.294492119, .rocker = 0.293864514}, {2.69351828});
  stays_in_its_assembly({.ground = 0.198474103, .coupler = 0.169690140, .rocker = 0.268146732}, {2.96204039});
}

TEST(PutInLoops, ManyTurnsAreGoneAllTheWay) {
  const FourBar f;
  World w = load(four_bar(f));
  w.set_joint("m::o", 60.4, 0);
  EXPECT_NEAR(std::remainder(w.joint_angle("m::p") - other_side(f, 60.4), 2 * M_PI), 0, 1e-8);
}

TEST(PutInLoops, WhatIsNoPlaceIsToldAsThat) {
  World w = load(four_bar({}, {.gravity = "0 0 0", .more = driven({"o"})}));
  for (const double x : {double(NAN), HUGE_VAL, -HUGE_VAL, 1e300}) {
    EXPECT_NE(refusal(w, "o", x).find("angle_rad = "), std::string::npos);
    EXPECT_NE(refusal(w, "o", x).find("out of range"), std::string::npos) << x;
    EXPECT_NE(refusal(w, "o", 0.3, x).find("speed_rad_per_s"), std::string::npos) << x;
  }
  EXPECT_NE(refusal(w, "o", 1e12), "") << "after as many steps as it may";
}

/// O–A–B–C–P: two cranks with actuators, two freedoms.
std::string five_bar() {
  const auto link = [](const std::string& name, double x, double z, double to_x, double to_z) {
    return bar(name, {x, z}, {to_x, to_z}, 0, 0.2);
  };
  return world("<model name='m'><pose>0 0 1 0 0 0</pose>" + link("l1", 0, 0, -0.05, 0.15) + link("l2", -0.05, 0.15, 0.15, 0.25) +
                   link("l3", 0.35, 0.15, 0.15, 0.25) + link("l4", 0.3, 0, 0.35, 0.15) + hinge("o1", "world", "l1") +
                   hinge("o2", "world", "l4") + hinge("a", "l1", "l2") + hinge("c", "l4", "l3") +
                   "<joint name='b' type='revolute'><pose>-0.2 0 0.1 0 0 0</pose><parent>l2</parent><child>l3</child>"
                   "<axis><xyz>0 1 0</xyz></axis></joint>" +
                   driven({"o1", "o2"}) + "</model>",
               "0 0 0");
}

TEST(PutInLoops, OtherActuatorsStayWhereTheLoopsHaveTheFreedomForIt) {
  World w = load(five_bar());
  ASSERT_EQ(w.dof_count(), 4U);
  w.run(0.05);
  const double other = w.joint_angle("m::o2");
  w.place("o1", 0.4, 0.3);
  EXPECT_EQ(w.joint_angle("m::o2"), other);
  double fastest = 0;
  for (int n = 0; n < 200; ++n) w.step(), fastest = std::max(fastest, w.energy().kinetic);
  EXPECT_LT(fastest, 1e-5);
}

/// Crank and coupler in line: the rocker can go no farther, and with a speed not even there.
TEST(PutInLoops, NothingIsPutAtADeadCentreWithASpeedOrBeyondIt) {
  const FourBar f;
  double dead = 0, best = -10;
  for (double a = -M_PI; a < M_PI; a += 1e-5)
    if (const double p = other_side(f, a); p > best) best = p, dead = a;
  for (const double beyond : {1e-5, 1e-4, 1e-2}) {
    World w = load(four_bar(f, {.gravity = "0 0 0", .more = driven({"p"})}));
    w.set_joint("m::o", dead - 0.5, 0);
    w.step();
    EXPECT_NE(refusal(w, "p", best + beyond), "") << beyond;
    EXPECT_EQ(refusal(w, "p", best - 1e-3, 0.01), "");
  }
  World w = load(four_bar(f, {.gravity = "0 0 0", .more = driven({"p"})}));
  w.set_joint("m::o", dead, 0);
  w.step();
  EXPECT_NE(refusal(w, "p", w.joint_angle("m::p"), 1.0).find("or not with a speed of 1"), std::string::npos);
}

TEST(PutInLoops, AFlyingBaseStays) {
  const auto link = [](const std::string& name, const std::string& pose) {
    return "<link name='" + name + "'><pose>" + pose + " 0 0 0</pose>" + inertial(0.2, 1e-3, "0.05 0 0 0 0 0") + "</link>";
  };
  World w = load(world("<model name='m'><pose>0 0 3 0.3 0.2 0</pose>" + link("a", "0 0 0") + link("b", "0.2 0 0") +
                       link("c", "0.2 0 0.2") + link("d", "0 0 0.2") + hinge("ab", "a", "b") + hinge("bc", "b", "c") +
                       hinge("cd", "c", "d") + hinge("da", "d", "a") + "</model>"));
  const Pose before = pose_of(w, "m::a");
  for (const double to : {0.4, -1.2, 0.9}) {
    w.set_joint("m::ab", to, 0);
    EXPECT_EQ(pose_of(w, "m::a").position, before.position);
    EXPECT_EQ(pose_of(w, "m::a").quaternion, before.quaternion);
    EXPECT_NEAR(w.joint_angle("m::bc"), -to, 1e-6) << "a parallelogram";
  }
}

}  // namespace
}  // namespace vsa::engine::testing
