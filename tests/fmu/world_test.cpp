// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world's FMU against the embedded engine.
#include "vsa/engine/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "importer.hpp"
#include "vsa/errors.hpp"
#include "vsa/fmu_world/world_model.hpp"
#include "vsa/temporary_folder.hpp"

namespace vsa::test {
namespace {

struct Wave {
  double operator()(std::size_t joint, double t) const { return 0.5 * std::sin(4 * t - 0.7 * static_cast<double>(joint)); }
};

TEST(World, TheSnakeGoesBitForBitAsInTheEngine) {
  const auto package = exported_world("snake_flat");
  Instance2 fmu(*package);
  ASSERT_TRUE(fmu.made()) << fmu.log.at(0);
  fmu.start();
  auto world = engine::World::load("snake_flat");
  const Wave wave;
  for (int k = 0; k < 200; ++k) {
    const double t = k * 5e-3;
    for (std::size_t j = 0; j < world.actuators().size(); ++j) {
      fmu.set(world.actuators()[j].name + ".equilibrium", wave(j, t));
      fmu.set(world.actuators()[j].name + ".preset", 0.3);
      world.command(world.actuators()[j], wave(j, t), 0.3);
    }
    fmu.step(t, 5e-3);
    for (int s = 0; s < 5; ++s) world.step();
    for (const auto& a : world.actuators()) {
      const host::ActuatorReading now = world.read(a);
      ASSERT_EQ(fmu.get(a.name + ".shaft_angle"), now.shaft_rad) << a.name << " at " << t;
      ASSERT_EQ(fmu.get(a.name + ".torque"), now.torque_Nm) << a.name << " at " << t;
      ASSERT_EQ(fmu.get(a.name + ".motor_2_current"), now.current_A[1]) << a.name << " at " << t;
    }
  }
  EXPECT_EQ(fmu.get("qbmove_snake.center_of_mass_x"), world.center_of_mass("qbmove_snake")[0]);
  EXPECT_GT(std::abs(fmu.get("joint_3.shaft_angle")), 0.05);
  EXPECT_TRUE(fmu.log.empty()) << fmu.log[0];
}

TEST(World, ALinearActuatorsShaftIsInMetresAndNewtons) {
  engine::WorldOptions with;
  with.types = config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"});
  const fmu::WorldModel model(engine::World::load_string(R"(<sdf version="1.9"><world name="w"><model name="press">
    <link name="base"><inertial><mass>1</mass></inertial></link><link name="plate"><inertial><mass>10</mass></inertial></link>
    <joint name="foot" type="fixed"><parent>world</parent><child>base</child></joint>
    <joint name="slide" type="prismatic"><parent>base</parent><child>plate</child><axis><xyz>0 0 1</xyz></axis></joint>
    <plugin name="vsa::Robot" filename="libvsa-robot.so">
      <actuator name="ram"><joint>slide</joint><type>linear_sea_example</type></actuator></plugin></model></world></sdf>)",
                                                         with));
  std::map<std::string, std::string> units;
  for (const fmu::Variable& v : model.variables()) units[v.name] = v.unit;
  EXPECT_EQ(units["ram.equilibrium"], "m");
  EXPECT_EQ(units["ram.shaft_speed"], "m/s");
  EXPECT_EQ(units["ram.torque"], "N");
  EXPECT_EQ(units["ram.stiffness"], "N/m");
  EXPECT_EQ(units["ram.motor_1_angle"], "rad");
}

TEST(World, PointsBetweenItsStepsSeeTheStepBeforeAndThatIsToldOnce) {
  const auto package = exported_world("bench_load");
  Instance2 fmu(*package);
  fmu.set("shaft.equilibrium", 0.5);
  fmu.start();
  auto world = engine::World::load("bench_load");
  world.command(world.actuators()[0], 0.5, 0.2);
  double t = 0;
  for (int k = 0; k < 100; ++k) {
    fmu.step(t, 0.7e-3);
    t = (k + 1) * 0.7e-3;
    while (world.time_s() + 1e-3 <= t + 1e-12) world.step();
    ASSERT_EQ(fmu.get("shaft.shaft_angle"), world.read("shaft").shaft_rad) << "at " << t;
  }
  ASSERT_EQ(fmu.log.size(), 1U);
  EXPECT_NE(fmu.log[0].find("between two steps"), std::string::npos);
  EXPECT_NE(fmu.get("shaft.shaft_angle"), 0);
}

TEST(World, ItsStateComesBackInAnotherInstance) {
  const auto package = exported_world("bench_load", fmu::Version::fmi2);
  Instance2 a(*package, "a"), b(*package, "b");
  a.start();
  a.set("shaft.equilibrium", 0.7);
  for (int k = 0; k < 100; ++k) a.step(k * 1e-3, 1e-3);
  b.restore(a.bytes());
  for (Instance2* i : {&a, &b})
    for (int k = 100; k < 200; ++k) i->step(k * 1e-3, 1e-3);
  EXPECT_EQ(a.all(), b.all());
  EXPECT_GT(a.get("shaft.motor_1_angle"), 0.3);
  ASSERT_EQ(FMI(*package, fmi2Reset)(a.c()), fmi2OK);
  a.start();
  EXPECT_EQ(a.get("shaft.shaft_angle"), 0.0);
}

TEST(World, AfterAStateIsSetBackTheSameCommandActsAgain) {
  const auto package = exported_world("bench_load");
  Instance2 fmu(*package);
  fmu.start();
  const std::vector<char> begin = fmu.bytes();
  std::vector<double> first;
  for (const bool again : {false, true}) {
    fmu.set("shaft.equilibrium", 0.7);
    for (int k = 0; k < 100; ++k) fmu.step(k * 1e-3, 1e-3);
    if (again) {
      EXPECT_EQ(fmu.all(), first);
    }
    first = fmu.all();
    fmu.restore(begin);
  }
  EXPECT_EQ(fmu.get("shaft.equilibrium"), 0.0);
}

TEST(World, OneWithoutActuatorsIsOneToo) {
  const auto package = exported_world(VSA_SOURCE_DIR "/tests/sdf/robot_files/dummy_base_in_world.urdf");
  Instance2 fmu(*package);
  ASSERT_TRUE(fmu.made()) << fmu.log.at(0);
  fmu.start();
  for (int k = 0; k < 10; ++k) fmu.step(k * 1e-3, 1e-3);
  EXPECT_EQ(fmu.get("energy_supply"), 0.0);
}

TEST(World, OneInMjcfTakesItsActuatorsAndTerrainAlong) {
  for (const char* name : {"snake_hills", "bench_load"}) {
    const std::filesystem::path mjcf = std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds" / (std::string(name) + ".xml");
    const auto package = exported_world(mjcf.string());
    Instance2 fmu(*package);
    ASSERT_TRUE(fmu.made()) << fmu.log.at(0);
    auto world = engine::World::load(mjcf);
    const std::string first = world.actuators().at(0).name;
    fmu.set(first + ".equilibrium", 0.3);
    fmu.start();
    world.command(world.actuators()[0], 0.3, world.read(world.actuators()[0]).preset_command);
    for (int k = 0; k < 100; ++k) {
      fmu.step(k * 1e-3, 1e-3);
      world.step();
    }
    for (const auto& a : world.actuators()) EXPECT_EQ(fmu.get(a.name + ".shaft_angle"), world.read(a).shaft_rad) << a.name;
  }
}

TEST(World, AnMjcfWhoseFilesCantGoAlongIsRefused) {
  const vsa::TemporaryFolder folder;
  const auto refused = [&](const std::string& inside) {
    const auto file = folder.path() / "w.xml";
    std::ofstream(file) << "<mujoco>" << inside << "<worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>";
    EXPECT_THROW(static_cast<void>(fmu::world_resources(config::TypeLibrary(), {file.string(), {}})), InputError) << inside;
  };
  refused("<compiler meshdir='.'/>");
  refused("<include file='nowhere.xml'/>");
  std::ofstream(folder.path() / "o.xml") << "<mujoco/>";
  refused("<include file='../" + folder.path().filename().string() + "/o.xml'/>");
}

TEST(World, FilesThatOnlyThisMachineFindsAreRefused) {
  const vsa::TemporaryFolder folder;
  const auto resources = fmu::world_resources(config::TypeLibrary(), {"snake_hills", {}});
  EXPECT_EQ(resources.count("models/terrain_hills/height.png"), 1U);
  EXPECT_EQ(resources.at("world.sdf").find("model://"), std::string::npos);
  EXPECT_EQ(resources.at("models/terrain_hills/model.sdf").find("model://"), std::string::npos);
  EXPECT_THROW(static_cast<void>(fmu::world_resources(config::TypeLibrary(), {"no_such_world", {}})), InputError);
}

}  // namespace
}  // namespace vsa::test
