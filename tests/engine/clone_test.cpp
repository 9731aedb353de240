// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Clones, snapshots between worlds of the same file, actuators that are placed.
#include <cmath>
#include <thread>

#include "arm.hpp"
#include "vsa/elastic/inverse.hpp"

namespace vsa::engine::testing {
namespace {

std::vector<double> state(const World& w) {
  std::vector<double> out{w.joint_angle("arm::shoulder"), w.joint_speed("arm::shoulder"),  w.joint_angle("arm::elbow"),
                          w.joint_speed("arm::elbow"),    w.read("shoulder").motor_rad[0], w.time_s()};
  const Pose ball = w.pose(w.link("ball::l"));
  out.insert(out.end(), ball.position.begin(), ball.position.end());
  return out;
}

TEST(Clone, GoesOnAsTheOriginalAndBothAreTheirOwn) {
  World w = World::load_string(arm());
  w.command("shoulder", -0.4, 0.3);
  w.run(0.05);
  w.make_initial();
  w.apply_torque(w.joint("arm::elbow"), 0.01);
  w.apply_wrench(w.link("ball::l"), {{1, 0, 0}, {}, {}});
  w.run(0.05);
  World c = w.clone();
  EXPECT_EQ(state(c), state(w));
  for (World* x : {&w, &c}) x->run(0.2);
  EXPECT_EQ(state(c), state(w));
  const auto there = state(w);
  c.command("shoulder", 0.4, 0.1);
  c.run(0.2);
  EXPECT_EQ(state(w), there);
  c.reset();
  w.reset();
  EXPECT_EQ(state(c), state(w));
  EXPECT_EQ(c.time_ns(), 50'000'000);
}

TEST(Clone, KnowsTheJointsDampers) {
  std::string text = arm();
  const std::string elbow = "<xyz>0 1 0</xyz></axis></joint><plugin";
  ASSERT_NE(text.find(elbow), std::string::npos);
  text.replace(text.find(elbow), elbow.size(), "<xyz>0 1 0</xyz><dynamics><damping>0.5</damping></dynamics></axis></joint><plugin");
  World w = World::load_string(text);
  w.command("shoulder", -0.4, 0.3);
  w.run(0.05);
  World c = w.clone();
  for (World* x : {&w, &c}) x->run(0.2);
  EXPECT_EQ(state(c), state(w));
}

TEST(Clone, HasTheParametersThatWereChanged) {
  World w = World::load_string(arm());
  auto unit = w.robot(0).config().actuators[0].unit;
  for (auto& side : unit.actuator.side) side.motor.resistance_Ohm *= 3;
  w.robot(0).set_parameters(0, unit);
  World c = w.clone();
  World plain = World::load_string(arm());
  for (World* x : {&w, &c, &plain}) {
    x->command("shoulder", -1.0, 0.3);
    x->run(0.3);
  }
  EXPECT_EQ(state(c), state(w));
  EXPECT_NE(state(plain), state(w));
}

TEST(Clone, EachMayHaveAThreadOfItsOwn) {
  World w = World::load_string(arm());
  w.run(0.05);
  std::vector<World> clones;
  for (int i = 0; i < 4; ++i) clones.push_back(w.clone());
  std::vector<std::thread> threads;
  for (World& c : clones) threads.emplace_back([&c] { c.run(0.3); });
  for (std::thread& t : threads) t.join();
  w.run(0.3);
  for (const World& c : clones) EXPECT_EQ(state(c), state(w));
}

/// What it saves is in bench/bench_load.cpp.
TEST(Clone, SharesWhatWasRead) {
  World w = World::load_string(arm());
  EXPECT_EQ(&w.clone().links(), &w.links());
}

TEST(Clone, SnapshotsCrossBetweenWorldsOfTheSameFileBitForBit) {
  World a = World::load_string(arm()), b = World::load_string(arm());
  a.command("shoulder", -0.5, 0.5);
  a.run(0.15);
  b.restore(*a.snapshot());
  EXPECT_EQ(state(a), state(b));
  for (World* x : {&a, &b}) x->run(0.2);
  EXPECT_EQ(state(a), state(b));
  EXPECT_EQ(b.joint_angle(a.joint("arm::elbow")), a.joint_angle("arm::elbow")) << "handles cross, too";
}

TEST(Placed, EveryShippedActuatorStaysWhereItIsPutWithoutGravity) {
  const config::TypeLibrary types({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"});
  constexpr double kResolution_rad = 2 * kPi / 4096;
  ASSERT_GE(types.names().size(), 6U);
  for (const std::string& name : types.names()) {
    const double preset = std::min(0.6, 0.75 * types.load(name).unit.preset_max);
    WorldOptions options;
    if (types.load(name).unit.actuator.linear()) options.actuator.overrides = {{"shaft.pinion_m", "0.05"}};
    World w = World::load_string(arm(name, "0 0 0"), options);
    w.run(0.02);
    w.place("shoulder", 1.0, preset);
    EXPECT_EQ(w.joint_angle("arm::shoulder"), 1.0) << name;
    double furthest = 0, fastest = 0;
    for (int k = 0; k < 300; ++k) {
      w.step();
      furthest = std::max(furthest, std::abs(w.joint_angle("arm::shoulder") - 1.0));
      fastest = std::max(fastest, std::abs(w.joint_speed("arm::shoulder")));
    }
    EXPECT_LT(furthest, 2 * kResolution_rad) << name;  // a loop without derivative corrects by counts
    EXPECT_LT(fastest, 0.1) << name;
  }
}

TEST(Placed, WithTheEquilibriumThatTheLawAsksForItHoldsAgainstGravity) {
  World w = World::load_string(arm());
  // The elbow hangs: at −90° from the upper arm's +x, turned down by the shoulder's own angle.
  const double q = -0.5;
  w.set_joint("arm::elbow", kPi / 2 - q, 0);
  std::vector<double> gravity(w.dof_count());
  w.set_joint("arm::shoulder", q, 0);
  w.gravity_torques(gravity);
  const double torque = gravity[*w.joints()[w.joint("arm::shoulder").index()].dof];
  EXPECT_LT(torque, -0.5);
  const auto& unit = w.robot(0).config().actuators[0].unit;
  const auto found = elastic::equilibrium_for(*unit.actuator.transmission, q, torque, 0.5);
  ASSERT_TRUE(found);
  // With it the pulleys still give way to the springs by their frictions' presliding; without it the arm falls.
  const auto speed_after = [&](std::optional<double> equilibrium) {
    World c = w.clone();
    c.place(c.actuators().front(), {q, 0.5, 0, equilibrium});
    EXPECT_NEAR(c.read("shoulder").equilibrium_command_rad, equilibrium.value_or(q), 1e-12);
    c.step();
    EXPECT_NEAR(c.read("shoulder").torque_Nm, equilibrium ? torque : 0, 0.2 * std::abs(torque));
    c.run(0.019);
    return std::abs(c.joint_speed("arm::shoulder"));
  };
  const double held = speed_after(found), fallen = speed_after(std::nullopt);
  EXPECT_LT(held, 0.3);
  EXPECT_GT(fallen, 4 * held);
}

TEST(Placed, AResetReturnsThereAfterMakeInitial) {
  World w = World::load_string(arm("qbmove_maker_pro_6_1", "0 0 0"));
  w.place("shoulder", 0.8, 0.4);
  w.make_initial();
  w.command("shoulder", -0.5, 0.4);
  w.run(0.3);
  w.reset();
  EXPECT_EQ(w.joint_angle("arm::shoulder"), 0.8);
  EXPECT_EQ(w.read("shoulder").equilibrium_command_rad, 0.8);
  w.run(0.2);
  EXPECT_NEAR(w.joint_angle("arm::shoulder"), 0.8, 1e-3);
}

TEST(Placed, BeyondAJointsLimitsIsRefused) {
  World w = World::load_string(arm());
  EXPECT_THROW(w.place("shoulder", 2.6, 0.1), InputError);
  EXPECT_EQ(w.joint_angle("arm::shoulder"), 0.0);
}

}  // namespace
}  // namespace vsa::engine::testing
