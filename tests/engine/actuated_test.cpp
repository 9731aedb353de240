// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robots in a world: from the <plugin> element to torques on joints.
#include <bit>
#include <cmath>

#include "support/ledger.hpp"
#include "worlds.hpp"

namespace vsa::engine::testing {
namespace {

WorldOptions options() {
  WorldOptions o;
  o.types = config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"});
  o.model_path.push_back(std::filesystem::path(VSA_SOURCE_DIR) / "models");
  return o;
}

std::string actuator(const std::string& joint, int id, const std::string& more = {}) {
  return "<actuator><joint>" + joint + "</joint><type>qbmove_maker_pro_6_1</type><bus id='" + std::to_string(id) + "'>arm</bus>" +
         more + "</actuator>";
}

std::string plugin(const std::string& content) {
  return "<plugin name='vsa::Robot' filename='libvsa-robot.so'>" + content +
         "<bus name='arm' baud='2000000' cycle_s='auto'/></plugin>";
}

/// A shaft on a fixed housing, in a module nested in a model that owns the plugin.
std::string bench(const std::string& plugin_text, const std::string& type = "revolute") {
  return world("<model name='bench'><model name='module_1'><link name='housing'>" + inertial(0.4, 3e-4) +
               "</link><link name='flange'>" + inertial(0.1, 4e-4) + "</link><joint name='shaft' type='" + type +
               "'><parent>housing</parent><child>flange</child><axis><xyz>0 0 1</xyz></axis></joint></model>"
               "<joint name='foot' type='fixed'><parent>world</parent><child>module_1::housing</child></joint>" +
               plugin_text + "</model>");
}

TEST(Actuated, ACommandedShaftGoesWhereItIsSent) {
  World w = World::load_string(bench(plugin(actuator("module_1::shaft", 1))), options());
  ASSERT_EQ(w.actuators().size(), 1u);
  EXPECT_EQ(w.actuators()[0].model, "bench");
  const std::string name = w.actuators()[0].name;
  EXPECT_TRUE(w.command(name, 0.6, 0.4));
  w.run(2.0);
  EXPECT_NEAR(w.joint_angle("bench::module_1::shaft"), 0.6, 0.1);
  EXPECT_DOUBLE_EQ(w.read("bench/" + name).shaft_speed_rad_per_s, w.read(name).shaft_speed_rad_per_s);
  EXPECT_GT(w.ledger().supply, 0);
}

TEST(Actuated, WithoutActuatorsNoTorqueActs) {
  WorldOptions o = options();
  o.actuators = false;
  World w = World::load_string(bench(plugin(actuator("module_1::shaft", 1))), o);
  w.set_joint("bench::module_1::shaft", 0, 3);
  w.run(1.0);
  EXPECT_EQ(w.robot_count(), 0u);
  EXPECT_NEAR(w.joint_angle("bench::module_1::shaft"), 3, 1e-9);
}

TEST(Actuated, AnotherActuatorCanBePutOnAWorld) {
  const std::string sdf = bench(plugin(actuator("module_1::shaft", 1, "<initial preset_rad='0.2'/>")));
  WorldOptions o = options();
  o.actuator = {"sea_example", {{"elastic.stiffness_Nm_per_rad", "20"}}};
  World w = World::load_string(sdf, o);
  EXPECT_EQ(w.robot(0).config().actuators[0].type, "sea_example");
  EXPECT_EQ(w.read(w.actuators()[0]).stiffness_Nm_per_rad, 20);
  o.actuator = {"nosuch", {}};
  EXPECT_NE(problems_of(sdf, o).find("unknown actuator type"), std::string::npos);
}

std::vector<std::uint64_t> bits(const World& w) {
  std::vector<std::uint64_t> out;
  for (const double x : {w.joint_angle("bench::module_1::shaft"), w.joint_speed("bench::module_1::shaft"),
                         w.read(w.actuators()[0]).torque_Nm, w.read(w.actuators()[0]).current_A[0], w.ledger().supply}) {
    out.push_back(std::bit_cast<std::uint64_t>(x));
  }
  return out;
}

TEST(Actuated, SnapshotsHoldTheRobotsToo) {
  World w = World::load_string(bench(plugin(actuator("module_1::shaft", 1))), options());
  const std::string name = w.actuators()[0].name;
  EXPECT_TRUE(w.command(name, 0.6, 0.4));
  w.run(0.107);  // between two refreshes of the inverse inertia
  const auto at = w.snapshot();
  w.run(0.2);
  const auto later = bits(w);
  w.restore(*at);
  w.run(0.2);
  EXPECT_EQ(bits(w), later);

  w.reset();
  EXPECT_TRUE(w.command(name, 0.6, 0.4));
  w.run(0.307);
  EXPECT_EQ(bits(w), later);
}

TEST(Actuated, SomebodysHandThatPutsAShaftElsewhereIsNoWorkOfTheStep) {
  World w = World::load_string(bench(plugin(actuator("module_1::shaft", 1, "<initial preset_rad='0.4'/>"))), options());
  w.run(0.1);
  const auto before = w.ledger();
  w.set_joint("bench::module_1::shaft", 0.5, 3.0);
  w.run(0.005);
  const auto after = w.ledger();
  EXPECT_GT(after.stored() - before.stored(), 0.1) << "the springs are wound";
  EXPECT_LT(std::abs(after.coupling - before.coupling), 1e-3);
  EXPECT_LT(std::abs(after.imbalance()), 1e-9);
  vsa::test::expect_small_closures(after, 0.01);
}

TEST(Actuated, ReadingsAreOfTheShaftThatIsThereBeforeAnyStep) {
  const std::string text = bench(plugin(actuator("module_1::shaft", 1, "<initial equilibrium_rad='0.5' preset_rad='0.4'/>")));
  World w = World::load_string(text, options());
  const ActuatorRef a = w.actuators()[0];
  const auto agrees = [&](const char* when) {
    const auto reading = w.read(a.name);
    EXPECT_EQ(reading.shaft_rad, w.joint_angle("bench::module_1::shaft")) << when;
    EXPECT_EQ(reading.shaft_speed_rad_per_s, w.joint_speed("bench::module_1::shaft")) << when;
    const auto before = w.ledger();
    w.step();
    EXPECT_NEAR(w.read(a.name).torque_Nm, reading.torque_Nm, 0.02 + 0.5 * std::abs(reading.torque_Nm)) << when;
    EXPECT_NEAR(w.ledger().stored_at_start, before.stored_at_start, 0.01 * std::abs(before.stored_at_start)) << when;
    EXPECT_LT(std::abs(w.ledger().imbalance()), 1e-9) << when;
  };
  EXPECT_GT(std::abs(w.read(a.name).torque_Nm), 0.3) << "half a radian from where its springs pull";
  agrees("loaded");
  w.run(0.2);
  w.set_joint("bench::module_1::shaft", -0.2, 1.5);
  agrees("put");
  w.reset();
  EXPECT_EQ(w.read(a.name).shaft_rad, 0.0);
  agrees("reset");
}

TEST(Actuated, APlaceWithASpeedHasItsMotorsEnergyAtOnce) {
  World w = World::load_string(bench(plugin(actuator("module_1::shaft", 1, "<initial preset_rad='0.4'/>"))), options());
  w.place(w.actuators()[0].name, 0.3, 0.4, 2.0);
  const auto placed = w.ledger();
  EXPECT_GT(placed.kinetic, 0);
  EXPECT_EQ(placed.stored(), placed.stored_at_start);
  w.step();
  EXPECT_NEAR(w.ledger().stored_at_start, placed.stored_at_start, 1e-9);
}

TEST(Actuated, AFaultLeavesTheRobotsWhereTheyWere) {
  World w = World::load_string(bench(plugin(actuator("module_1::shaft", 1))), options());
  w.run(0.05);
  w.set_joint("bench::module_1::shaft", 1e11, 0);
  const auto before = bits(w);
  EXPECT_THROW(w.step(), SimulationError);
  EXPECT_EQ(bits(w), before);
  EXPECT_EQ(w.time_ns(), 50'000'000);
}

TEST(Actuated, JointsThatArentThereOrTwiceOrOfTheWrongTypeAreNamed) {
  const std::string missing = problems_of(bench(plugin(actuator("module_1::shift", 1))), options());
  EXPECT_NE(missing.find("module_1::shift"), std::string::npos) << missing;
  EXPECT_NE(missing.find("module_1::shaft"), std::string::npos) << missing;
  const std::string twice = problems_of(bench(plugin(actuator("module_1::shaft", 1) + actuator("module_1::shaft", 2))), options());
  EXPECT_NE(twice.find("module_1::shaft"), std::string::npos) << twice;
  const std::string ball = problems_of(bench(plugin(actuator("module_1::shaft", 1)), "ball"), options());
  EXPECT_NE(ball.find("one axis"), std::string::npos) << ball;
  const std::string two_plugins =
      problems_of(bench(plugin(actuator("module_1::shaft", 1)) + plugin(actuator("module_1::shaft", 1))), options());
  EXPECT_NE(two_plugins.find("drives it already"), std::string::npos) << two_plugins;
  const std::string unknown = problems_of(bench(plugin(actuator("module_1::shaft", 1, "<colour>red</colour>"))), options());
  EXPECT_NE(unknown.find("colour"), std::string::npos) << unknown;
}

TEST(Actuated, TheSnakeOfTheModelsLoadsAndStandsStill) {
  World w = World::load(std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds/snake_flat.sdf", options());
  EXPECT_EQ(w.actuators().size(), 12u);
  const auto start = w.center_of_mass("qbmove_snake");
  w.run(0.2);
  const auto now = w.center_of_mass("qbmove_snake");
  EXPECT_NEAR(now[0], start[0], 2e-3);
  EXPECT_NEAR(now[2], start[2], 3e-3);
  EXPECT_EQ(w.contact_count(), 26);  // two spheres a module, 13 modules, each once
}

}  // namespace
}  // namespace vsa::engine::testing
