// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Joints that move each other though the file doesn't have them in one robot or in one tree: an arm and its hand with a plug-in each,
// the two cranks of a closed loop. Left alone they come to rest as those of one robot do.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "arm.hpp"

namespace vsa::engine::testing {
namespace {

std::string light_link(const std::string& name, double x_m) {
  return "<link name='" + name + "'><pose>" + std::to_string(x_m) + " 0 0 0 0 0</pose>" + inertial(0.05, 1e-4, "0.05 0 0 0 0 0") +
         "</link>";
}

std::string driven(const std::string& joint, double start_rad) {
  return "<actuator name='" + joint + "'><joint>" + joint +
         "</joint><type>qbmove_maker_pro_6_1</type><bus>arm</bus><initial equilibrium_rad='" + std::to_string(start_rad) +
         "' preset_rad='0.6'/></actuator>";
}
std::string robot(const std::string& actuators) {
  return "<plugin name='vsa::Robot' filename='libvsa-robot.so'>" + actuators + "<bus name='arm'/></plugin>";
}

std::string hinges() {
  return hinge("j0", "world", "a", "<initial_position>0.3</initial_position>") +
         hinge("j1", "a", "b", "<initial_position>-0.4</initial_position>");
}
std::string one_robot() {
  return world("<model name='m'>" + light_link("a", 0) + light_link("b", 0.1) + hinges() +
               robot(driven("j0", 0) + driven("j1", 0)) + "</model>");
}
std::string two_robots() {
  return world("<model name='m'>" + light_link("a", 0) + light_link("b", 0.1) + hinges() + robot(driven("j0", 0)) +
               robot(driven("j1", 0)) + "</model>");
}
/// The hand is a model of its own below the arm's.
std::string nested_robots() {
  return world("<model name='m'>" + light_link("a", 0) + "<model name='hand'><pose>0.1 0 0 0 0 0</pose>" + light_link("b", 0) +
               light_link("c", 0.1) + hinge("j2", "b", "c") + robot(driven("j2", 0)) + "</model>" + hinge("j0", "world", "a") +
               hinge("j1", "a", "hand::b") + robot(driven("j0", 0) + driven("j1", 0)) + "</model>");
}

/// Of all actuators over the last half of 3 s, rad/s.
double late_speed(World& w) {
  double sum = 0;
  int n = 0;
  while (w.time_s() < 3) {
    w.step();
    for (std::size_t i = 0; i < w.actuators().size() && w.time_s() > 1.5; ++i, ++n)
      sum += std::pow(w.read(w.actuators()[i]).shaft_speed_rad_per_s, 2);
  }
  return std::sqrt(sum / n);
}

double created(const World& w) { return -w.ledger().coupling / w.ledger().moved(); }

TEST(SharedTree, TwoRobotsOnItRestAsOneDoes) {
  for (const double step_s : {0.0005, 0.001, 0.002, 0.004}) {
    WorldOptions options;
    options.step_s = step_s;
    World one = World::load_string(one_robot(), options), two = World::load_string(two_robots(), options);
    ASSERT_EQ(two.robot_count(), 2U);
    ASSERT_EQ(two.warnings().size(), one.warnings().size() + 1) << "they share their topics, which is told";
    const double as_one = late_speed(one), as_two = late_speed(two);
    EXPECT_LT(as_one, 0.12) << step_s;
    EXPECT_LT(as_two, as_one + 0.02) << step_s;
    EXPECT_LT(created(two), created(one) + 1e-4) << step_s;
    EXPECT_GT(two.ledger().moved(), 0.01) << "nothing moved";
  }
}

TEST(SharedTree, ARobotInANestedModelToo) {
  WorldOptions options;
  options.step_s = 0.002;
  World w = World::load_string(nested_robots(), options);
  ASSERT_EQ(w.robot_count(), 2U);
  EXPECT_LT(late_speed(w), 0.12);
  EXPECT_LT(created(w), 1e-3);
}

TEST(SharedTree, CopiesSnapshotsAndNumbersGoOnTheSameWay) {
  World w = World::load_string(two_robots());
  w.run(0.5);
  World copy = w.clone();
  const auto there = w.snapshot();
  std::vector<double> numbers(w.state_size());
  w.save(numbers);
  w.run(0.5);
  const std::uint64_t after = w.state_hash();
  copy.run(0.5);
  EXPECT_EQ(copy.state_hash(), after);
  w.restore(*there);
  w.run(0.5);
  EXPECT_EQ(w.state_hash(), after);
  copy.restore(numbers);
  copy.run(0.5);
  EXPECT_EQ(copy.state_hash(), after);
  w.reset();
  World anew = World::load_string(two_robots());
  w.run(0.3);
  anew.run(0.3);
  EXPECT_EQ(w.state_hash(), anew.state_hash());
}

/// A four-bar linkage; the cranks are trees of their own.
std::string linkage() {
  return R"(<mujoco model='m'><option timestep='0.001' gravity='0 0 0'/><worldbody>
<body name='a'><joint name='ja' type='hinge' axis='0 1 0'/><inertial pos='0 0 0.03' mass='0.01' diaginertia='5e-5 5e-5 5e-5'/>
<body name='c' pos='0 0 0.06'><joint name='jc' type='hinge' axis='0 1 0'/>
<inertial pos='0.05 0 0' mass='0.005' diaginertia='1e-5 1e-5 1e-5'/></body></body>
<body name='b' pos='0.1 0 0'><joint name='jb' type='hinge' axis='0 1 0'/>
<inertial pos='0 0 0.03' mass='0.01' diaginertia='5e-5 5e-5 5e-5'/></body></worldbody>
<equality><connect body1='c' body2='b' anchor='0.1 0 0' solref='0.008 1'/></equality></mujoco>)";
}

TEST(SharedTree, TheCranksOfALoopAreSolvedTogether) {
  const TempDir dir("loop");
  for (const double step_s : {0.0005, 0.001, 0.002, 0.004}) {
    dir.write("loop.xml", linkage());
    dir.write("loop.vsa.xml", "<vsa>" + robot(driven("ja", 0.3) + driven("jb", 0.3)) + "</vsa>");
    WorldOptions options;
    options.step_s = step_s;
    World w = World::load(dir.path() / "loop.xml", options);
    ASSERT_EQ(w.actuators().size(), 2U);
    EXPECT_LT(late_speed(w), 0.12) << step_s;
    EXPECT_LT(created(w), 1e-3) << step_s;
    EXPECT_GT(w.ledger().moved(), 0.01) << "nothing moved";
  }
}

/// Two robots, a crank each: as one robot's.
TEST(SharedTree, TheCranksMayBeOfTwoRobots) {
  const TempDir dir("loop");
  dir.write("loop.xml", linkage());
  dir.write("loop.vsa.xml", "<vsa>" + robot(driven("ja", 0.3)) + robot(driven("jb", 0.3)) + "</vsa>");
  World w = World::load(dir.path() / "loop.xml");
  ASSERT_EQ(w.robot_count(), 2U);
  EXPECT_LT(late_speed(w), 0.12);
  EXPECT_LT(created(w), 1e-3);
}

}  // namespace
}  // namespace vsa::engine::testing
