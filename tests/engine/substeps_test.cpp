// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <substeps>: N steps of engine and actuators together in one of the world's. The oracle is the same world at the short step,
// looked at every Nth time: equal bit for bit.
#include <cmath>

#include "arm.hpp"

namespace vsa::engine::testing {
namespace {

constexpr int kN = 4;
constexpr double kStep_s = 4e-3;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_TRUE(has(text, from)) << from;
  return text.replace(text.find(from), from.size(), to);
}

std::string asking(const std::string& text, const std::string& n) {
  return replaced(text, "<actuator ", "<substeps>" + n + "</substeps><actuator ");
}

/// The arm with a damper at its elbow, a ball that flies and one that lies on the floor.
std::string lively() {
  const std::string
      joint = "<xyz>0 1 0</xyz>",
      lies = "<model name='x'><pose>0.5 0 0.1 0 0 0</pose><link name='l'>" + inertial(1, 0.01) +
             "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></world>";
  return replaced(replaced(arm(), joint + "</axis></joint><plugin",
                           joint + "<dynamics><damping>0.02</damping></dynamics></axis></joint><plugin"),
                  "</world>", lies);
}

World load(const std::string& text, double step_s) {
  WorldOptions options;
  options.step_s = step_s;
  return World::load_string(text, options);
}

/// The same world twice: N substeps of 1 ms, and steps of 1 ms.
struct Pair {
  World coarse = load(asking(lively(), std::to_string(kN)), kStep_s), fine = load(lively(), kStep_s / kN);

  template <class Act>
  void both(Act act) {
    act(coarse);
    act(fine);
  }
  void step() {
    coarse.step();
    for (int k = 0; k < kN; ++k) fine.step();
  }
};

void put(std::vector<double>& out, const actuator::Ledger& l) {
  out.insert(out.end(), {l.supply, l.coupling, l.integrator, l.moved()});
}

/// What can be asked of a world.
std::vector<double> all_of(const World& w) {
  std::vector<double> out{w.time_s(), static_cast<double>(w.contact_count())};
  for (const ActuatorRef& a : w.actuators()) {
    const host::ActuatorReading r = w.read(a);
    out.insert(out.end(), {r.equilibrium_command_rad, r.preset_command, r.equilibrium_rad, r.preset, r.shaft_rad,
                           r.shaft_speed_rad_per_s, r.deflection_rad, r.stiffness_Nm_per_rad, r.torque_Nm, r.mean_torque_Nm});
    for (std::size_t m = 0; m < 2; ++m)
      out.insert(out.end(), {r.motor_rad[m], r.motor_speed_rad_per_s[m], r.motor_torque_Nm[m], r.current_A[m]});
    for (const Ticks t : r.measured) out.push_back(t.value);
  }
  for (const char* joint : {"arm::shoulder", "arm::elbow"}) out.insert(out.end(), {w.joint_angle(joint), w.joint_speed(joint)});
  for (const char* link : {"ball::l", "x::l"}) {
    const Pose p = w.pose(w.link(link));
    out.insert(out.end(), p.position.begin(), p.position.end());
  }
  std::vector<Contact> contacts;
  w.contacts(contacts);
  for (const Contact& c : contacts) out.insert(out.end(), c.force_N.begin(), c.force_N.end());
  const World::Energy e = w.energy();
  out.insert(out.end(), {e.kinetic, e.gravitational, e.springs});
  put(out, w.ledger());
  return out;
}

TEST(Substeps, GiveTheSamplesOfTheShortStepBitForBit) {
  Pair p;
  EXPECT_EQ(p.coarse.substeps(), kN);
  EXPECT_EQ(p.fine.substeps(), 1);
  EXPECT_EQ(p.coarse.step_s(), kStep_s);
  for (int k = 0; k < 250; ++k) {
    if (k % 25 == 0) p.both([&](World& w) { w.command("shoulder", k % 50 == 0 ? -0.6 : 0.5, 0.1 + 0.002 * k); });
    if (k == 40) p.both([](World& w) { w.apply_torque(w.joint("arm::elbow"), 0.02); });
    if (k == 60) p.both([](World& w) { w.pull({{2, {0.1, 0, 0}, {0.2, 0, 1.1}, 50, 2, 5}}); });
    if (k == 80) p.both([](World& w) { w.apply_wrench(w.link("x::l"), {{3, 0, 0}, {}, {}}); });
    if (k == 100) p.both([](World& w) { w.set_joint("arm::elbow", 0.3, 2); });
    if (k == 120) p.both([](World& w) { w.set_joint("arm::shoulder", 0.2, -2); });
    p.step();
    ASSERT_EQ(all_of(p.coarse), all_of(p.fine)) << k;
  }
  EXPECT_EQ(p.coarse.time_ns(), 1'000'000'000);
}

TEST(Substeps, HoldForPlacesParametersSnapshotsAndClones) {
  Pair p;
  const auto go = [&](int steps) {
    for (int k = 0; k < steps; ++k) {
      p.step();
      ASSERT_EQ(all_of(p.coarse), all_of(p.fine)) << p.coarse.time_s();
    }
  };
  p.both([](World& w) { w.place("shoulder", 0.7, 0.4, 3.0); });
  go(20);
  p.both([](World& w) {
    auto unit = w.robot(0).config().actuators[0].unit;
    for (auto& side : unit.actuator.side) side.motor.resistance_Ohm *= 2;
    w.robot(0).set_parameters(0, unit);
    w.command("shoulder", -0.5, 0.6);
  });
  go(20);
  const auto coarse = p.coarse.snapshot(), fine = p.fine.snapshot();
  const auto there = all_of(p.coarse);
  go(20);
  p.coarse = p.coarse.clone();
  EXPECT_EQ(p.coarse.substeps(), kN);
  go(20);
  p.coarse.restore(*coarse);
  p.fine.restore(*fine);
  go(20);
  p.coarse.restore(*fine);
  p.fine.restore(*fine);
  go(20);
  EXPECT_NE(all_of(p.coarse), there);
  p.both([](World& w) { w.reset(); });
  go(5);
}

TEST(Substeps, ABlowUpInOneOfThemTakesBackTheWholeStep) {
  const std::string rotor =
      "<model name='rotor'><link name='l'>" + inertial(1, 1) +
      "</link><joint name='j' type='revolute'><parent>world</parent><child>l</child><axis><xyz>0 0 1</xyz></axis>"
      "</joint></model></world>";
  World w = load(asking(replaced(lively(), "</world>", rotor), std::to_string(kN)), kStep_s);
  w.command("shoulder", -0.6, 0.4);
  w.run(0.1);
  // 1e6 rad/s more each millisecond: beyond the 1e10 that the engine takes in the third.
  w.set_joint("arm::elbow", 0.3, 2);
  w.set_joint("rotor::j", 0, 1e10 - 2.5e6);
  w.apply_torque(w.joint("rotor::j"), 1e9);
  World other = w.clone();
  try {
    w.step();
    FAIL();
  } catch (const SimulationError& error) {
    EXPECT_TRUE(has(error.what(), "t = 0.102000 s")) << error.what();
    EXPECT_TRUE(has(error.what(), "rotor::j")) << error.what();
  }
  EXPECT_EQ(all_of(w), all_of(other));
  for (World* x : {&w, &other}) {
    x->apply_torque(x->joint("rotor::j"), 0);
    x->set_joint("rotor::j", 0, 0);
    x->run(0.1);
  }
  EXPECT_EQ(all_of(w), all_of(other));
}

TEST(Substeps, ARobotThatSaysNothingTakesTheOthersAndDifferentOnesAreRefused) {
  const auto two = [](const std::string& first, const std::string& second) {
    const auto model = [](const std::string& name, const std::string& n) {
      return "<model name='" + name + "'>" + arm_links() + plugin(n + actuator("shoulder")) + "</model>";
    };
    return world(model("one", first) + model("two", second));
  };
  EXPECT_EQ(load(two("", "<substeps>4</substeps>"), 1e-3).substeps(), 4);
  EXPECT_EQ(load(two("<substeps>4</substeps>", "<substeps>4</substeps>"), 1e-3).substeps(), 4);
  const std::string text = problems_of(two("<substeps>4</substeps>", "<substeps>2</substeps>"));
  EXPECT_TRUE(has(text, "SDF text: substeps = 4 of one, 2 of two")) << text;
  EXPECT_TRUE(has(text, "can't have different ones")) << text;
}

TEST(Substeps, AStepThatTheyCantDivideIsRefused) {
  const auto said = [](const char* n, double step_s) {
    WorldOptions options;
    options.step_s = step_s;
    return problems_of(asking(arm(), n), options);
  };
  EXPECT_EQ(said("64", 6.4e-5), "");
  EXPECT_EQ(said("5", 1e-3), "");
  const std::string uneven = said("3", 1e-3), shorter = said("64", 3.2e-5);
  EXPECT_TRUE(has(uneven, "SDF text: arm: substeps = 3: can't divide the world's step of 1000000 ns")) << uneven;
  EXPECT_TRUE(has(uneven, "whole nanoseconds, at least 1000")) << uneven;
  EXPECT_TRUE(has(shorter, "SDF text: arm: substeps = 64: can't divide the world's step of 32000 ns")) << shorter;
  EXPECT_TRUE(has(said("65", 1e-3), "substeps = \"65\": is out of range (allowed: 1 … 64)")) << said("65", 1e-3);
}

TEST(Substeps, WithoutActuatorsThereAreNone) {
  WorldOptions options;
  options.actuators = false;
  EXPECT_EQ(World::load_string(asking(arm(), "4"), options).substeps(), 1);
}

TEST(Substeps, WhatAStepCantResolveIsJudgedByThem) {
  const auto notices = [](const std::string& text) {
    World w = load(text, kStep_s);
    w.place("shoulder", 0.2, 0.75);
    w.run(4.0);
    std::string out;
    for (const host::Notice& n : w.robot(0).take_notices()) out += n.text + '\n';
    return out;
  };
  // A bare flange on some 20 N·m/rad: ω·dt is about 2 at 4 ms and 0.2 at an eighth of it.
  const std::string flange = world("<model name='m'><link name='f'>" + inertial(0.1, 1e-4) + "</link>" +
                                       hinge("shoulder", "world", "f") + plugin(actuator("shoulder")) + "</model>",
                                   "0 0 0");
  const std::string told = notices(flange);
  EXPECT_TRUE(has(told, "swings with ω·dt = ")) << told;
  EXPECT_TRUE(has(told, "<substeps>")) << told;
  EXPECT_FALSE(has(notices(asking(flange, "8")), "swings"));
}

}  // namespace
}  // namespace vsa::engine::testing
