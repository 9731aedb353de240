// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where things are: poses, nested models, includes, axes in other frames, URDF.
#include <cmath>
#include <numbers>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

using std::numbers::pi;

void expect_at(const Pose& p, double x, double y, double z) {
  EXPECT_NEAR(p.position[0], x, 1e-9);
  EXPECT_NEAR(p.position[1], y, 1e-9);
  EXPECT_NEAR(p.position[2], z, 1e-9);
}

/// Base at (1, 2, 3) turned by 90° about z; arm 0.5 m along the base's x; the joint's axis is given in the model's frame.
std::string arm(const std::string& ends, const std::string& pose = "") {
  return "<model name='m'><pose>1 2 3 0 0 1.5707963267948966</pose><link name='base'>" + inertial(1, 0.1) +
         "</link><link name='arm'><pose>0.5 0 0 0.7 0 0</pose>" + inertial(1, 0.1) +
         "</link><joint name='w' type='fixed'><parent>world</parent><child>base</child></joint><joint name='j' type='revolute'>" +
         pose + ends + "<axis><xyz expressed_in='__model__'>0 0 1</xyz></axis></joint></model>";
}

TEST(Frames, LinksStartWhereTheirPosesSay) {
  const World w = World::load_string(world(arm("<parent>base</parent><child>arm</child>")));
  expect_at(pose_of(w, "m::base"), 1, 2, 3);
  expect_at(pose_of(w, "m::arm"), 1, 2.5, 3);
  EXPECT_EQ(w.name(), "test");
  EXPECT_EQ(w.links()[1].name, "m::arm");
  EXPECT_EQ(w.links()[1].model, "m");
  EXPECT_DOUBLE_EQ(w.links()[1].mass_kg, 1);
}

TEST(Frames, AnAxisIsTakenInTheFrameItIsExpressedIn) {
  World w = World::load_string(
      world(arm("<parent>base</parent><child>arm</child>", "<pose relative_to='base'>0.25 0 0 0.3 0.2 0.1</pose>"), "0 0 0"));
  w.set_joint("m::j", pi / 2, 0);
  // The anchor is 0.25 m along the base's x, which is the world's y; the arm's other quarter turns to the world's −x.
  expect_at(pose_of(w, "m::arm"), 0.75, 2.25, 3);
}

TEST(Frames, AJointThatPointsTowardsTheWorldTurnsTheSameWay) {
  World w = World::load_string(
      world(arm("<parent>arm</parent><child>base</child>", "<pose relative_to='base'>0.25 0 0 0 0 0</pose>"), "0 0 0"));
  w.set_joint("m::j", pi / 2, 0);  // base relative to arm: the arm turns by −90°, its quarter to the world's +x
  expect_at(pose_of(w, "m::arm"), 1.25, 2.25, 3);
}

TEST(Frames, NestedModelsAndTheirJointsAreFoundByScopedName) {
  const std::string module =
      "<link name='body'>" + inertial(1, 0.1) + "</link><link name='flange'><pose>0.1 0 0 0 0 0</pose>" + inertial(1, 0.1) +
      "</link><joint name='shaft' type='revolute'><parent>body</parent><child>flange</child><axis><xyz>0 0 1</xyz></axis></joint>";
  World w = World::load_string(
      world("<model name='snake'><pose>0 0 1 0 0 0</pose><model name='one'>" + module +
                "</model><model name='two'><pose relative_to='one::flange'>0.2 0 0 0 0 0</pose>" + module +
                "</model><joint name='link' type='fixed'><parent>one::flange</parent><child>two::body</child></joint></model>",
            "0 0 0"));
  expect_at(pose_of(w, "snake::two::flange"), 0.4, 0, 1);
  EXPECT_EQ(w.joint_angle("snake::two::shaft"), 0);
  w.set_joint("snake::one::shaft", pi / 2, 0);
  expect_at(pose_of(w, "snake::two::body"), 0.1, 0.2, 1);
  const auto com = w.center_of_mass("snake");
  EXPECT_NEAR(com[0], (0 + 0.1 + 0.1 + 0.1) / 4, 1e-9);
  EXPECT_NEAR(com[1], (0 + 0 + 0.2 + 0.3) / 4, 1e-9);
}

TEST(Frames, AModelIsDisplacedAboutTheWorldsAxis) {
  World w =
      World::load_string(world("<model name='m'><pose>1 0 1 0 0 0</pose><link name='a'>" + inertial(1, 0.1) + "</link></model>"));
  w.displace_model("m", pi / 2, {0, 0, 0.5});
  expect_at(pose_of(w, "m::a"), 0, 1, 1.5);
  w.make_initial();
  w.run(0.1);
  w.reset();
  expect_at(pose_of(w, "m::a"), 0, 1, 1.5);
  EXPECT_EQ(w.time_ns(), 0);
  World fixed = World::load_string(world(arm("<parent>base</parent><child>arm</child>")));
  EXPECT_THROW(fixed.displace_model("m", 0.1, {0, 0, 0}), InputError);
}

TEST(Frames, StaticModelsAndUnjointedLinksAreTiedAndFree) {
  World w = World::load_string(
      world("<model name='s'><static>true</static><link name='l'/></model><model name='m'><link name='a'>" + inertial(1, 0.1) +
            "</link><link name='b'><pose>1 0 0 0 0 0</pose>" + inertial(1, 0.1) + "</link></model>"));
  w.run(0.5);
  expect_at(pose_of(w, "s::l"), 0, 0, 0);
  EXPECT_LT(pose_of(w, "m::a").position[2], -1);
  EXPECT_LT(pose_of(w, "m::b").position[2], -1);
  EXPECT_TRUE(w.links()[0].is_static);
}

TEST(Frames, BallAndUniversalJointsHang) {
  const auto hanging = [](const std::string& type) {
    return world("<model name='m'><link name='l'>" + inertial(1, 0.001, "0.3 0 0 0 0 0") + "</link><joint name='j' type='" + type +
                 "'><parent>world</parent><child>l</child>" +
                 (type == "universal"
                      ? "<axis><xyz>0 1 0</xyz><dynamics><damping>0.5</damping></dynamics></axis><axis2><xyz>0 0 1</xyz></axis2>"
                      : "") +
                 "</joint></model>");
  };
  World ball = World::load_string(hanging("ball"));
  const double start = ball.energy().gravitational;
  ball.run(0.3);
  EXPECT_NEAR(ball.energy().gravitational + ball.energy().kinetic, start, 1e-3);
  expect_at(pose_of(ball, "m::l"), 0, 0, 0);
  World universal = World::load_string(hanging("universal"));
  universal.run(5.0);
  EXPECT_NEAR(universal.center_of_mass("m")[2], -0.3, 1e-3);
}

TEST(Frames, IncludesAreFoundOnTheModelPath) {
  const TempDir dir("include");
  dir.write("thing/model.config", "<?xml version='1.0'?><model><name>thing</name><sdf version='1.9'>model.sdf</sdf></model>");
  dir.write("thing/model.sdf", "<?xml version='1.0'?><sdf version='1.9'><model name='thing'><link name='l'>" + inertial(1, 0.1) +
                                   "</link></model></sdf>");
  WorldOptions options;
  options.model_path.push_back(dir.path());
  const World w =
      World::load_string(world("<include><uri>model://thing</uri><name>mine</name><pose>0 1 0 0 0 0</pose></include>"), options);
  expect_at(pose_of(w, "mine::l"), 0, 1, 0);
}

TEST(Frames, UrdfIsReadAsLibsdformatReadsIt) {
  const TempDir dir("urdf");
  const std::string body = "<inertial><mass value='1'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>";
  const auto file = dir.write(
      "robot.urdf", "<?xml version='1.0'?><robot name='r'><link name='a'>" + body + "</link><link name='b'>" + body +
                        "</link><joint name='j' type='continuous'><parent link='a'/><child link='b'/><origin xyz='0 0 0.5'/>"
                        "<axis xyz='0 1 0'/></joint></robot>");
  World w = World::load(file);
  expect_at(pose_of(w, "r::b"), 0, 0, 0.5);
  w.set_joint("r::j", 1, 0);
  EXPECT_EQ(w.joint_angle("r::j"), 1);
}

TEST(Frames, VisualsComeWithTheirColoursAndCollisionsWhereThereAreNone) {
  const World w = World::load_string(world(
      "<model name='m'><link name='a'>" + inertial(1, 0.1) +
      "<visual name='v'><pose>0 0 1 0 0 0</pose><geometry><cylinder><radius>0.1</radius><length>0.4</length></cylinder></geometry>"
      "<material><diffuse>1 0 0 1</diffuse></material></visual></link><link name='b'>" +
      inertial(1, 0.1) +
      "<collision name='c'><geometry><ellipsoid><radii>1 2 3</radii></ellipsoid></geometry></collision></link></model>"));
  const Shape& v = w.links()[0].visuals.at(0);
  EXPECT_EQ(v.kind, Shape::Kind::cylinder);
  EXPECT_EQ(v.rgba, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(v.size, (std::array<double, 3>{0.1, 0.4, 0}));
  EXPECT_EQ(v.pose.position[2], 1);
  const Shape& c = w.links()[1].visuals.at(0);
  EXPECT_EQ(c.kind, Shape::Kind::mesh);
  EXPECT_EQ(c.indices.size() % 3, 0u);
}

}  // namespace
}  // namespace vsa::engine::testing
