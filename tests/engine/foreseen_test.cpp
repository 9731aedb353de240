// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What driven joints are told of a step before it is made: weights that fold behind them, gravity from the first step on, what users
// apply. Untold, a stiff joint answers to what isn't so, and makes energy out of nothing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "arm.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/elastic/inverse.hpp"

long allocation_count();  // allocation_count.cpp

namespace vsa::engine::testing {
namespace {

const char* const kStiff[] = {"tree_lime_50", "tree_orange_100", "ugurlu_sea", "anydrive_ad119e20", "hebi_x8_9"};

World load(const std::string& model, double step_s, const std::string& gravity = "0 0 0") {
  WorldOptions options;
  options.step_s = step_s;
  return World::load_string(world(model, gravity), options);
}

/// A driven link of 0.02 kg, with a weight of 1 kg at its end that nothing drives, on a hinge or on a slide along the link.
std::string weight_behind(const std::string& type, bool slides) {
  return "<model name='m'><link name='l'>" + inertial(0.02, 2e-5, "0.1 0 0 0 0 0") +
         "</link><link name='weight'><pose>0.2 0 0 0 0 0</pose>" + inertial(1, 1e-5, slides ? "0 0 0 0 0 0" : "0.1 0 0 0 0 0") +
         "</link>" + hinge("driven", "world", "l") +
         (slides
              ? "<joint name='free' type='prismatic'><parent>l</parent><child>weight</child><axis><xyz>1 0 0</xyz></axis></joint>"
              : hinge("free", "l", "weight")) +
         plugin(actuator("driven", type)) + "</model>";
}

TEST(Foreseen, AWeightThatFoldsBehindAStiffJointMakesNoEnergy) {
  for (const char* type : kStiff)
    for (const double step_s : {1e-3, 2e-3, 4e-3})
      for (const double speed : {5.0, 10.0, 20.0}) {
        World w = load(weight_behind(type, false), step_s);
        w.set_joint("m::free", 0.3, speed);
        const double energy = w.energy().kinetic;
        w.run(1.0);
        EXPECT_GE(w.ledger().coupling, -2e-3 * energy) << type << ", " << speed << " rad/s, " << step_s;
      }
}

TEST(Foreseen, ASlideDoesNeither) {
  for (const char* type : kStiff)
    for (const double step_s : {1e-3, 4e-3}) {
      World w = load(weight_behind(type, true), step_s);
      w.set_joint("m::free", 0.1, 1.0);
      const double energy = w.energy().kinetic;
      w.run(0.4);
      EXPECT_GE(w.ledger().coupling, -2e-3 * energy) << type << ", " << step_s;
    }
}

TEST(Foreseen, WhatGoesOnFromANumbersStateGoesOnTheSameWay) {
  World w = load(weight_behind("tree_lime_50", false), 1e-3);
  w.set_joint("m::free", 0.3, 5.0);
  w.apply_torque(w.joint("m::free"), 0.01);
  w.run(0.1015);
  World other = w.clone();
  std::vector<double> numbers(w.state_size());
  w.save(numbers);
  w.run(0.2);
  other.restore(numbers);
  other.run(0.2);
  EXPECT_EQ(w.state_hash(), other.state_hash());
}

/// Two links of 0.1 kg held out level.
std::string held_level(const std::string& type) {
  std::string out = "<model name='m'>";
  for (const std::string n : {"1", "2"})
    out += "<link name='l" + n + "'><pose>" + (n == "1" ? "0" : "0.1") + " 0 0 0 0 0</pose>" +
           inertial(0.1, 1e-4, "0.05 0 0 0 0 0") + "</link>";
  return out + hinge("j1", "world", "l1") + hinge("j2", "l1", "l2") + plugin(actuator("j1", type, 1) + actuator("j2", type, 2)) +
         "</model>";
}

TEST(Foreseen, APlacedArmHasTheTorqueItNeedsFromTheFirstStepOn) {
  for (const char* type : {"tree_lime_50", "hebi_x8_9", "awas_2_example", "amasc_example"})
    for (const double step_s : {0.5e-3, 1e-3, 4e-3})
      for (const bool moved_before : {false, true}) {
        World w = load(held_level(type), step_s, "0 0 -9.81");
        if (moved_before) {
          w.command("j1", 0.4, 0.0);
          w.run(0.1);
        }
        w.set_joint("m::j1", 0, 0);
        w.set_joint("m::j2", 0, 0);
        const device::UnitConfig unit = config::TypeLibrary().load(type).unit;
        std::vector<double> needed(w.dof_count());
        w.gravity_torques(needed);
        for (const std::size_t i : {0U, 1U}) {
          const double preset = 0.5 * unit.preset_max;
          w.place(w.actuator(i == 0 ? "j1" : "j2"),
                  {0.0, preset, 0.0, elastic::equilibrium_for(*unit.actuator.transmission, 0.0, needed[i], preset)});
        }
        w.step();
        const double falls = step_s * 9.81 / 0.05;
        for (const char* joint : {"m::j1", "m::j2"})
          EXPECT_LT(std::abs(w.joint_speed(joint)), 0.02 * falls) << type << ", " << step_s << ", " << joint;
      }
}

TEST(Foreseen, WhatAHandAppliesIsThereAtOnce) {
  for (const char* type : {"tree_lime_50", "hebi_x8_9", "awas_2_example", "qbmove_maker_pro_6_1"}) {
    World w = load(held_level(type), 1e-3);
    while (w.time_s() < 0.5) {
      w.apply_torque(w.joint("m::j2"), 0.5 * std::sin(314.159 * w.time_s()));
      w.step();
    }
    const actuator::Ledger sum = w.ledger();
    EXPECT_GE(sum.coupling, -1e-3 * sum.delivered_moved) << type;
    EXPECT_GT(sum.delivered_moved, 1e-3) << type;
  }
}

TEST(Foreseen, WhatAnotherRobotDoesChangesNoBit) {
  // Beside a soft arm: a stiff robot with a weight that spins behind it, on its stop.
  const std::string arm = "<model name='arm'>" + arm_links() + plugin(actuator("shoulder")) + "</model>";
  std::string other = weight_behind("tree_lime_50", false);
  other.replace(other.find("<model name='m'>"), 16, "<model name='m'><pose>5 0 0 0 0 0</pose>");
  World alone = load(arm, 1e-3, "0 0 -9.81"), beside = load(arm + other, 1e-3, "0 0 -9.81");
  beside.set_joint("m::free", 0.3, 20.0);
  for (World* w : {&alone, &beside}) w->command("shoulder", 0.5, 0.3);
  while (alone.time_s() < 1.0) {
    alone.step();
    beside.step();
    ASSERT_EQ(alone.joint_angle("arm::elbow"), beside.joint_angle("arm::elbow")) << alone.time_s();
  }
  EXPECT_TRUE(beside.robot(1).is_stiff());
  EXPECT_FALSE(beside.robot(0).is_stiff());
}

/// Of the last 0.3 s of 3 s, rad/s.
double rms_at_rest(World& w) {
  w.run(2.7);
  double sum = 0;
  int steps = 0;
  for (; w.time_s() < 3.0; ++steps) {
    w.step();
    sum += std::pow(w.joint_speed("m::driven"), 2);
  }
  return std::sqrt(sum / steps);
}

void expect_rest(World& w, const std::string& what) {
  const double rms = rms_at_rest(w);
  const actuator::Ledger sum = w.ledger();
  EXPECT_LT(rms, 0.02) << what;
  EXPECT_GE(sum.coupling, -1e-3 * sum.moved()) << what;
}

std::string one_joint(const std::string& type, double moment, const std::string& axis) {
  return "<model name='m'><link name='l'>" + inertial(0.01, moment) + "</link>" + hinge("driven", "world", "l", axis) +
         plugin(actuator("driven", type)) + "</model>";
}

const char* const kStop = "<limit><lower>-0.3</lower><upper>0.3</upper></limit>";

TEST(Foreseen, AStiffJointRestsOnItsStop) {
  for (const char* type : {"tree_lime_50", "tree_avocado_100", "tree_orange_100", "ugurlu_sea", "hebi_x8_9"})
    for (const double moment : {1e-4, 1e-3, 1e-2})
      for (const double step_s : {1e-3, 2e-3, 4e-3}) {
        World w = load(one_joint(type, moment, kStop), step_s);
        w.place("driven", 0.29, 0.0);
        w.command("driven", 0.31, 0.0);
        expect_rest(w, fmt::format("{}, {} kg·m², {} s", type, moment, step_s));
        EXPECT_NEAR(w.joint_angle("m::driven"), 0.3, 4e-3) << type << ", " << moment << " kg·m²";
      }
}

TEST(Foreseen, AStiffJointThrownAtItsStopComesToRestThere) {
  for (const char* type : {"tree_lime_50", "tree_avocado_100", "ugurlu_sea"})
    for (const double moment : {1e-5, 1e-4, 1e-3})
      for (const auto& [step_s, to] : {std::pair{1e-3, 1.0}, {5e-4, 0.6}, {2.5e-4, 0.6}}) {
        World w = load(one_joint(type, moment, kStop), step_s);
        w.command("driven", to, 0.0);
        expect_rest(w, fmt::format("{}, {} kg·m², {} s", type, moment, step_s));
      }
}

TEST(Foreseen, AStiffArmRestsOnTheGroundItPresses) {
  for (const char* type : {"tree_lime_50", "tree_avocado_100", "hebi_x8_9"}) {
    World w = load(
        ground() + "<model name='m'><pose>0 0 0.05 0 0 0</pose><link name='l'>" + inertial(0.3, 2.5e-4, "0.05 0 0 0 0 0") +
            "<collision name='c'><pose>0.1 0 0 0 0 0</pose><geometry><sphere><radius>0.01</radius></sphere></geometry>" +
            friction(1) + "</collision></link>" + hinge("driven", "world", "l") + plugin(actuator("driven", type)) + "</model>",
        1e-3, "0 0 -9.81");
    w.command("driven", 0.6, 0.0);
    expect_rest(w, type);
  }
}

TEST(Foreseen, AStiffJointRestsInItsDryFriction) {
  for (const char* type : {"tree_lime_50", "tree_orange_100", "ugurlu_sea", "hebi_x8_9"})
    for (const double moment : {1e-5, 1e-4, 1e-3})
      for (const char* friction : {"0.03", "0.3", "3"}) {
        World w = load(one_joint(type, moment, std::string("<dynamics><friction>") + friction + "</friction></dynamics>"), 1e-3);
        w.command("driven", 0.2, 0.0);
        expect_rest(w, fmt::format("{}, {} kg·m², {} N·m", type, moment, friction));
      }
}

void expect_no_energy(World& w, double part, const std::string& what) {
  EXPECT_GE(w.ledger().coupling, -part * w.ledger().moved()) << what;
}

/// Newton's steps beside stops were once taken by slopes that were rounding, or went to and fro between two sets of stops.
TEST(Foreseen, ChainsBetweenStopsMakeNoEnergyInLongSteps) {
  for (const double moment : {1e-4, 1e-3})
    for (const int count : {1, 3}) {
      std::string links, joints, actuators;
      for (int i = 0; i < count; ++i) {
        const std::string n = std::to_string(i);
        links += "<link name='l" + n + "'><pose>" + std::to_string(0.05 * i) + " 0 0 0 0 0</pose>" +
                 inertial(0.01, moment, "0.025 0 0 0 0 0") + "</link>";
        joints += hinge("j" + n, i == 0 ? "world" : "l" + std::to_string(i - 1), "l" + n,
                        "<limit><lower>-0.2</lower><upper>0.2</upper></limit>");
        actuators += actuator("j" + n, "tree_lime_50", i + 1);
      }
      World w = load("<model name='m'>" + links + joints + plugin(actuators) + "</model>", 4e-3);
      std::mt19937 rng(3);
      for (int part = 1; part <= 8; ++part) {
        for (int i = 0; i < count; ++i)
          w.command("j" + std::to_string(i), std::uniform_real_distribution<double>(-0.6, 0.6)(rng), 0.0);
        w.run(0.4 * part - w.time_s());
      }
      expect_no_energy(w, 1e-3, fmt::format("{} joints, {} kg·m²", count, moment));
    }
}

/// Two robots whose tips press on each other.
std::string two_fingers(double moment) {
  const auto finger = [&](const std::string& name, const std::string& pose) {
    return "<model name='" + name + "'><pose>" + pose + "</pose><link name='l'>" + inertial(0.01, moment) +
           "<collision name='c'><pose>0.05 0 0 0 0 0</pose><geometry><sphere><radius>0.01</radius></sphere></geometry>" +
           friction(1) + "</collision></link>" + hinge(name, "world", "l") + plugin(actuator(name, "tree_lime_50")) + "</model>";
  };
  return finger("a", "0 0 0.0105 0 0 0") + finger("b", "0 0 -0.0105 0 0 0");
}

void press(World& w) {
  w.command("a", 0.3, 0.0);
  w.command("b", -0.3, 0.0);
}

TEST(Foreseen, StiffFingersThatPressOnEachOtherMakeNoEnergy) {
  for (const double moment : {1e-4, 1e-3})
    for (const double step_s : {1e-3, 4e-3}) {
      World w = load(two_fingers(moment), step_s);
      press(w);
      w.run(2.0);
      expect_no_energy(w, 1e-3, fmt::format("{} kg·m², {} s", moment, step_s));
      if (step_s > 2e-3) continue;  // there they slip off each other
      EXPECT_LT(std::abs(w.joint_speed("a::a")), 0.02) << moment << " kg·m²";
    }
}

TEST(Foreseen, FingersGoOnInAWorldOfAnotherStepInEveryWay) {
  for (const auto& [from_s, to_s] : {std::pair{2e-5, 1e-3}, {1e-3, 2e-5}, {1e-3, 4e-3}}) {
    World from = load(two_fingers(1e-4), from_s), to = load(two_fingers(1e-4), to_s);
    press(from);
    from.run(0.1);
    to.restore(*from.snapshot());
    to.run(0.1);
    std::vector<double> numbers(from.state_size());
    ASSERT_EQ(to.state_size(), numbers.size());
    from.save(numbers);
    to.restore(numbers);
    to.run(0.1);
    EXPECT_GT(to.contact_count(), 0) << from_s << ", " << to_s;
  }
}

/// Two fingers on the world, 0.08 m apart, that squeeze a ball between them.
std::string gripper(const std::string& type, double moment, const std::string& more = {}) {
  const auto finger = [&](const std::string& name, double x) {
    return "<model name='" + name + "'><pose>" + std::to_string(x) + " 0 0 0 0 0</pose><link name='l'>" +
           inertial(0.02, moment, "0 0 0.04 0 0 0") +
           "<collision name='c'><pose>0 0 0.05 0 0 0</pose><geometry><box><size>0.01 0.02 0.08</size></box></geometry>" +
           friction(1) + "</collision></link>" + hinge(name, "world", "l") + plugin(actuator(name, type)) + "</model>";
  };
  return finger("a", -0.04) + finger("b", 0.04) + "<model name='ball'><pose>0 0 0.06 0 0 0</pose><link name='l'>" +
         inertial(0.05, 2e-5) + "<collision name='c'><geometry><sphere><radius>0.03</radius></sphere></geometry>" + friction(1) +
         "</collision></link></model>" + more;
}

void squeeze(World& w, double by, double preset) {
  w.command("a", by, preset);
  w.command("b", -by, preset);
}

double fingers_rms(World& w, double time_s) {
  double squares = 0;
  int n = 0;
  for (const double end = w.time_s() + time_s; w.time_s() < end; n += 2) {
    w.step();
    for (const char* joint : {"a::a", "b::b"}) squares += std::pow(w.joint_speed(joint), 2);
  }
  return std::sqrt(squares / n);
}

TEST(Foreseen, FingersWhosePresetIsRaisedHoldAThing) {
  for (const double moment : {1e-5, 2e-4})
    for (const double step_s : {1e-3, 2e-3}) {
      World w = load(gripper("qbmove_maker_pro_6_1", moment), step_s);
      squeeze(w, 0.4, 0.0);
      w.run(1.0);
      squeeze(w, 0.4, 0.7);
      w.run(1.5);
      EXPECT_GE(w.contact_count(), 2);
      EXPECT_LT(fingers_rms(w, 0.3), 0.06) << moment << " kg·m², " << step_s << " s";
    }
}

TEST(Foreseen, FarRobotsChangeNothingHoweverMany) {
  std::string far;
  for (int i = 0; i < 40; ++i) {
    const std::string name = "far" + std::to_string(i);
    far += "<model name='" + name + "'><pose>" + std::to_string(50 + i) + " 0 0 0 0 0</pose><link name='l'>" +
           inertial(0.02, 1e-4) +
           "<collision name='c'><geometry><sphere><radius>0.02</radius></sphere></geometry></collision></link>" +
           hinge(name, "world", "l") + plugin(actuator(name, "tree_lime_50")) + "</model>";
  }
  World w = load(gripper("tree_lime_50", 1e-4, far), 1e-3);
  squeeze(w, 0.4, 0.0);
  w.run(1.5);
  EXPECT_GE(w.contact_count(), 2);
  EXPECT_LT(fingers_rms(w, 0.3), 0.06);
}

TEST(Foreseen, ParametersThatMakeFingersStiffAreAsGoodAsAFileWithThem) {
  const auto links_of = [](World& w, double moment) {
    for (const char* finger : {"a::l", "b::l"}) {
      LinkParameters to = w.link_parameters(w.link(finger));
      to.inertia_kgm2 = {moment, moment, moment};
      w.set_link_parameters(w.link(finger), to);
    }
  };
  World file = load(gripper("tree_lime_50", 1e-4), 1e-3), told = load(gripper("tree_lime_50", 0.5), 1e-3);
  links_of(told, 1e-4);
  for (World* w : {&file, &told}) {
    squeeze(*w, 0.4, 0.0);
    w->run(0.5);
  }
  EXPECT_EQ(file.joint_angle("a::a"), told.joint_angle("a::a"));
  EXPECT_EQ(file.joint_speed("b::b"), told.joint_speed("b::b"));
  // And back, while they hold it.
  links_of(told, 0.5);
  told.run(0.2);
  EXPECT_TRUE(std::isfinite(told.joint_angle("a::a")));
}

TEST(Foreseen, ASnapshotGoesToAWorldWhoseTreesAreJoinedOtherwise) {
  // In one model, so that the seat has the matrix of both fingers, or one for each.
  const std::string links = "<link name='k'><pose>0.075 0 0 0 0 0</pose>" + inertial(0.02, 2e-3, "0 0 0.04 0 0 0") +
                            "<collision name='c'><geometry><sphere><radius>0.02</radius></sphere></geometry></collision></link>";
  const std::string model = "<model name='m'><link name='l'>" + inertial(0.02, 2e-3, "0 0 0.04 0 0 0") +
                            "<collision name='c'><geometry><sphere><radius>0.0551</radius></sphere></geometry></collision></link>" +
                            links + hinge("a", "world", "l") + hinge("b", "world", "k") +
                            plugin(actuator("a", "sea_example") + actuator("b", "sea_example", 2)) + "</model>";
  const auto with = [&](const char* stiffness) {
    WorldOptions options;
    options.actuator.overrides = {{"elastic.stiffness_Nm_per_rad", stiffness}};
    return World::load_string(world(model, "0 0 0"), options);
  };
  for (const auto& [own, others] : {std::pair{"5", "1000"}, {"1000", "5"}}) {
    World from = with(own), to = with(others);
    EXPECT_NE(from.state_size(), to.state_size()) << "their trees are joined alike";
    from.command("a", 0.2, 0.0);
    from.run(0.5);
    to.restore(*from.snapshot());
    to.run(0.5);
    EXPECT_NEAR(to.joint_angle("m::a"), 0.2, 0.06) << others;
    EXPECT_GE(to.ledger().coupling, -1e-3 * to.ledger().moved()) << others;
    to.reset();
    to.run(0.1);
  }
}

TEST(Foreseen, ASnapshotGoesToAWorldWhoseTreesAnEqualityTies) {
  const auto crank = [](const std::string& x, const std::string& name) {
    return "<body name='" + name + "' pos='" + x + " 0 0'><joint name='" + name +
           "' axis='0 1 0'/><inertial mass='0.1' pos='0 0 0.05' diaginertia='1e-4 1e-4 1e-4'/></body>";
  };
  const auto load_with = [&](const std::string& more) {
    const std::string element = plugin(actuator("a") + actuator("b", "qbmove_maker_pro_6_1", 2));
    std::string escaped;
    for (const char c : element) escaped += c == '<' ? "&lt;" : c == '\'' ? "&apos;" : std::string(1, c);
    return World::load_string("<mujoco><option timestep='0.001'/><custom><text name='vsa::Robot' data='" + escaped +
                              "'/></custom><worldbody>" + crank("0", "a") + crank("0.2", "b") + "</worldbody>" + more +
                              "</mujoco>");
  };
  const std::string tie = "<equality><weld body1='a' body2='b'/></equality>";
  for (const bool tied : {true, false}) {
    World from = load_with(tied ? tie : ""), to = load_with(tied ? "" : tie);
    from.command("a", 0.2, 0.3);
    from.run(0.3);
    to.restore(*from.snapshot());
    to.run(0.3);
    EXPECT_NEAR(to.joint_angle("model::a"), tied ? 0.2 : 0, tied ? 0.15 : 0.05);
  }
}

TEST(Foreseen, AStepOfHeldJointsTakesNothingFromTheHeap) {
  World w = load(two_fingers(1e-3), 1e-3);
  press(w);
  w.run(0.5);
  const long before = allocation_count();
  for (int k = 0; k < 400; ++k) w.step();
  EXPECT_EQ(allocation_count() - before, 0);
  EXPECT_GT(w.contact_count(), 0);
}

TEST(Foreseen, APullOnAHeldJointMakesNoEnergy) {
  for (const double step_s : {0.25e-3, 1e-3, 4e-3}) {
    World w = load(one_joint("tree_lime_50", 1e-4, "<dynamics><friction>0.1</friction></dynamics>"), step_s);
    scene::Pull pull;
    pull.link = w.link("m::l").index();
    pull.point_m = {0.05, 0, 0};
    pull.target_m = {0.05, 0, 0.05};
    w.pull({pull});
    w.run(1.0);
    expect_no_energy(w, 1e-3, fmt::format("{} s", step_s));
    EXPECT_LT(std::abs(w.joint_speed("m::driven")), 0.02) << step_s;
  }
}

TEST(Foreseen, ARobotThatBeginsInTheGroundIsHeldFromTheFirstStepOn) {
  for (const double step_s : {1e-3, 2e-3, 4e-3}) {
    World w =
        load(ground() + "<model name='m'><pose>0 0 0.0095 0 0 0</pose><link name='l'>" + inertial(0.01, 1e-4) +
                 "<collision name='c'><pose>0.05 0 0 0 0 0</pose><geometry><sphere><radius>0.01</radius></sphere></geometry>" +
                 friction(1) + "</collision></link>" + hinge("driven", "world", "l") + plugin(actuator("driven", "tree_lime_50")) +
                 "</model>",
             step_s, "0 0 -9.81");
    w.run(0.1);
    EXPECT_GE(w.ledger().coupling, -1e-5) << step_s;  // J; it was 0.04
  }
}

/// One to three links on axes of their own, some joints with stops and friction, above a floor that the last link can hit.
std::string robot_at_random(std::mt19937& rng, int& count) {
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(rng); };
  count = std::uniform_int_distribution<int>(1, 3)(rng);
  std::string links, joints, actuators;
  double x = 0;
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    const double length = draw(0.03, 0.12);
    const std::string ball = "<collision name='c'><pose>" + std::to_string(length) +
                             " 0 0 0 0 0</pose><geometry><sphere><radius>0.01</radius></sphere></geometry></collision>";
    links += "<link name='l" + n + "'><pose>" + std::to_string(x) + " 0 0 0 0 0</pose>" +
             inertial(0.01, std::pow(10, draw(-5, -2)), std::to_string(length / 2) + " 0 0 0 0 0") + (i == count - 1 ? ball : "") +
             "</link>";
    const std::string stop = fmt::format("<limit><lower>{}</lower><upper>{}</upper></limit>", -draw(0.05, 0.5), draw(0.05, 0.5));
    const std::string rub = fmt::format("<dynamics><friction>{}</friction></dynamics>", std::pow(10, draw(-2, 0.5)));
    joints += hinge("j" + n, i == 0 ? "world" : "l" + std::to_string(i - 1), "l" + n,
                    (draw(0, 1) < 0.6 ? stop : "") + (draw(0, 1) < 0.4 ? rub : ""), draw(0, 1) < 0.7 ? "0 1 0" : "1 0 0");
    actuators += actuator("j" + n, kStiff[std::uniform_int_distribution<std::size_t>(0, 4)(rng)], i + 1);
    x += length;
  }
  return ground() + fmt::format("<model name='m'><pose>0 0 {} 0 0 0</pose>", draw(0.011, 0.06)) + links + joints +
         plugin(actuators) + "</model>";
}

/// As bench/measurements/stiff_robots.py does thousands of times.
TEST(Foreseen, RobotsAtRandomMakeNoEnergyBesideWhatHoldsThem) {
  std::mt19937 rng(11);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(rng); };
  for (int k = 0; k < 60; ++k) {
    int count = 0;
    World w = load(robot_at_random(rng, count), std::vector{2.5e-4, 5e-4, 1e-3, 2e-3}[static_cast<std::size_t>(k % 4)],
                   k % 2 == 0 ? "0 0 0" : "0 0 -9.81");
    for (int part = 0; part < 4; ++part) {
      for (int i = 0; i < count; ++i) w.command("j" + std::to_string(i), draw(-0.6, 0.6), 0.0);
      ASSERT_NO_THROW(w.run(0.25 * (part + 1) - w.time_s())) << "robot " << k;
    }
    EXPECT_GE(w.ledger().coupling, -1e-2 * w.ledger().moved()) << "robot " << k;
  }
}

}  // namespace
}  // namespace vsa::engine::testing
