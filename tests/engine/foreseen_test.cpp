// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What driven joints are told of a step before it is made: weights that fold behind them, gravity from the first step on, what users
// apply. Untold, a stiff joint answers to what isn't so, and makes energy out of nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "arm.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/elastic/inverse.hpp"

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

TEST(Foreseen, AStiffJointRestsOnItsStop) {
  for (const char* type : {"tree_lime_50", "tree_avocado_100", "tree_orange_100", "ugurlu_sea", "hebi_x8_9"})
    for (const double moment : {1e-4, 1e-3, 1e-2}) {
      World w = load("<model name='m'><link name='l'>" + inertial(0.01, moment) + "</link>" +
                         hinge("driven", "world", "l", "<limit><lower>-0.3</lower><upper>0.3</upper></limit>") +
                         plugin(actuator("driven", type)) + "</model>",
                     1e-3);
      w.place("driven", 0.29, 0.0);
      w.command("driven", 0.31, 0.0);
      expect_rest(w, std::string(type) + ", " + std::to_string(moment) + " kg·m²");
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

/// Friction that sticks counts, too; while it slides to and fro energy still comes out of nothing, and is told (docs/limits.md).
TEST(Foreseen, AStiffJointRestsInItsDryFriction) {
  for (const auto& [type, moment] : {std::pair{"tree_orange_100", 1e-4}, {"tree_lime_50", 1e-3}, {"hebi_x8_9", 1e-4}}) {
    World w = load("<model name='m'><link name='l'>" + inertial(0.01, moment) + "</link>" +
                       hinge("driven", "world", "l", "<dynamics><friction>1</friction></dynamics>") +
                       plugin(actuator("driven", type)) + "</model>",
                   1e-3);
    w.command("driven", 0.02, 0.0);
    EXPECT_LT(rms_at_rest(w), 0.02) << type;
  }
}

}  // namespace
}  // namespace vsa::engine::testing
