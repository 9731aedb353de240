// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Files that few people write, and what became of them once: wrong in silence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "arm.hpp"
#include "vsa/engine/mjcf.hpp"

namespace vsa::engine::testing {
namespace {

std::string one_hinge(const std::string& joint_more, const std::string& plugin_text) {
  return "<link name='a'>" + inertial(0.05, 1e-4) + "</link>" + hinge("j0", "world", "a", joint_more) + plugin_text;
}

/// Below a model of their own, so that the outer model's name doesn't tell them apart.
TEST(OddFiles, AModelIncludedTwiceBelowAnotherHasActuatorsWithNamesOfTheirOwn) {
  const std::string arm = one_hinge("", plugin(actuator("j0")));
  World w = World::load_string(world("<model name='top'><model name='left'>" + arm +
                                         "</model><model name='right'><pose>0 1 0 0 0 0</pose>" + arm + "</model></model>",
                                     "0 0 0"));
  ASSERT_EQ(w.actuators().size(), 2U);
  for (const ActuatorRef& a : w.actuators()) EXPECT_EQ(&w.actuator(w.name_of(a)), &a) << w.name_of(a);
  EXPECT_EQ(w.name_of(w.actuators()[1]), "top/right/j0");
  for (const char* of_both : {"j0", "top/j0"}) {
    try {
      static_cast<void>(w.actuator(of_both));
      ADD_FAILURE() << of_both << " is one of two";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("top/left/j0, top/right/j0"), std::string::npos) << error.what();
    }
  }
}

/// Its springs would be wound up, and it would drop away at once.
TEST(OddFiles, AJointThatStartsBeyondItsFirmwaresReachIsRefused) {
  const auto with = [](const std::string& start, const std::string& initial) {
    const std::string a =
        "<actuator name='j0'><joint>j0</joint><type>qbmove_maker_pro_6_1</type><bus id='1'>arm</bus>" + initial + "</actuator>";
    return world("<model name='m'>" + one_hinge("<initial_position>" + start + "</initial_position>", plugin(a)) + "</model>",
                 "0 0 0");
  };
  EXPECT_NE(problems_of(with("3.0", "<initial preset_rad='0.4'/>")).find("is beyond the firmware's limits"), std::string::npos);
  EXPECT_EQ(problems_of(with("3.0", "<initial equilibrium_rad='2.2' preset_rad='0.4'/>")), "");
  EXPECT_EQ(problems_of(with("2.0", "<initial preset_rad='0.4'/>")), "");
}

std::string box(const std::string& name, double z, bool is_static) {
  const std::string shape = "<geometry><box><size>0.2 0.2 0.2</size></box></geometry>";
  return "<model name='" + name + "'>" + (is_static ? "<static>true</static>" : "") + "<pose>0 0 " + std::to_string(z) +
         " 0 0 0</pose><link name='l'>" + inertial(1, 0.01) + "<collision name='c'>" + shape + "</collision></link></model>";
}

TEST(OddFiles, WhatStandsStillHoldsUpItsModelsOtherPartsInAnyOrder) {
  const std::string pedestal = box("pedestal", 0.1, true), parcel = box("parcel", 0.3, false);
  for (const std::string& parts : {pedestal + parcel, parcel + pedestal}) {
    World w = World::load_string(world("<model name='m'>" + parts + "</model>"));
    w.run(1.0);
    EXPECT_NEAR(pose_of(w, "m::parcel::l").position[2], 0.3, 0.01);
  }
}

TEST(OddFiles, ARobotOfTheWorldIsRefusedNotForeign) {
  const std::string text = problems_of(world(plugin(actuator("j0"))));
  EXPECT_NE(text.find("belongs to a model"), std::string::npos) << text;
}

TEST(OddFiles, AStateThatIsNoNumberIsRefused) {
  const auto state = [](const std::string& of_model) {
    return world("<model name='m'>" + one_hinge("", "") + "</model><state world_name='test'><model name='m'>" + of_model +
                 "</model></state>");
  };
  EXPECT_NE(problems_of(state("<joint name='j0'><angle axis='0'>nan</angle></joint>")).find("isn't a number in range"),
            std::string::npos);
  for (const char* pose : {"0 0 inf 0 0 0", "0 0 nan 0 0 0", "0 0 0 0 1e999 0"}) {
    const std::string told = problems_of(state(std::string("<pose>") + pose + "</pose>"));
    EXPECT_NE(told, "") << pose << ": taken for a pose";
  }
  EXPECT_EQ(problems_of(state("<joint name='j0'><angle axis='0'>0.3</angle></joint>")), "");
}

std::string boxes(const std::string& equality = "", const std::string& keys = "") {
  return R"(<mujoco model='m'><option timestep='0.001'/><worldbody><geom name='floor' type='plane' size='5 5 1' condim='1'/>
<body name='a' pos='0 0 0.1'><freejoint/><geom type='box' size='0.1 0.1 0.1' mass='1' condim='1'/>
<geom type='sphere' size='0.1' contype='0' conaffinity='0' mass='0'/></body>
<body name='b' pos='2 0 0.1'><freejoint/><geom type='box' size='0.1 0.1 0.1' mass='1' condim='1'/></body>
<body name='seen' pos='0 2 1'><joint name='j' type='hinge'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>
<geom type='sphere' size='0.1' contype='0' conaffinity='0'/><body name='more'><joint name='k' type='hinge'/>
<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body></body></worldbody>)" +
         equality + keys + "</mujoco>";
}

/// Kinds of contact that the file has stay the file's when one link's friction changes.
TEST(OddFiles, AnotherFrictionOfOneLinkLeavesTheOthersContacts) {
  const TempDir dir("condim");
  dir.write("boxes.xml", boxes());
  const auto slid = [&](bool other) {
    World w = World::load(dir.path() / "boxes.xml");
    const LinkHandle b = w.link("m::b");
    LinkParameters p = w.link_parameters(b);
    p.friction = 0.7;
    if (other) w.set_link_parameters(b, p);
    w.apply_wrench(w.link("m::a"), {{2, 0, 0}, {}});
    w.run(0.5);
    return pose_of(w, "m::a").position[0];
  };
  EXPECT_GT(slid(false), 0.2) << "without friction";
  EXPECT_NEAR(slid(true), slid(false), 1e-9);
  World w = World::load(dir.path() / "boxes.xml");
  EXPECT_FALSE(w.link_parameters(w.link("m::seen")).friction.has_value()) << "what is only seen has none";
}

TEST(OddFiles, AnEqualityThatIsSwitchedOffMakesNoFollower) {
  const TempDir dir("off");
  const auto follower = [&](const char* active) {
    dir.write("boxes.xml", boxes(std::string("<equality><joint joint1='k' joint2='j' active='") + active + "'/></equality>"));
    World w = World::load(dir.path() / "boxes.xml");
    return std::any_of(w.joints().begin(), w.joints().end(), [](const JointInfo& joint) { return joint.follows.has_value(); });
  };
  EXPECT_TRUE(follower("true"));
  EXPECT_FALSE(follower("false"));
}

TEST(OddFiles, ThePluginsMjcfNamesJointsAsTheMjcfDoesAndLeavesItsKeys) {
  const TempDir dir("names");
  const auto arm = dir.write(
      "arm.sdf",
      world("<model name='m'><link name='a'>" + inertial(0.05, 1e-4) + "</link>" + hinge("j &gt; 1", "world", "a") +
            plugin(
                "<actuator name='elbow'><joint>j &gt; 1</joint><type>qbmove_maker_pro_6_1</type><bus id='1'>arm</bus></actuator>") +
            "</model>"));
  const PluginMjcf out = export_plugin_mjcf(arm);
  EXPECT_NE(out.file.bytes.find("joint=\"m::j &gt; 1\""), std::string::npos) << out.file.bytes;
  dir.write("boxes.xml", boxes("", "<keyframe><key name='start' time='1'/></keyframe>"));
  dir.write("boxes.vsa.xml", "<vsa>" + plugin(actuator("j")) + "</vsa>");
  const PluginMjcf with_key = export_plugin_mjcf(dir.path() / "boxes.xml");
  std::size_t keys = 0;
  for (std::size_t at = with_key.file.bytes.find("<key "); at != std::string::npos; at = with_key.file.bytes.find("<key ", at + 1))
    ++keys;
  EXPECT_EQ(keys, 1U) << with_key.file.bytes;
}

std::string ball_at(double height, const std::string& name) {
  return "<model name='" + name + "'><pose>0 0 " + std::to_string(height) + " 0 0 0</pose><link name='l'>" + inertial(1, 1e-3) +
         "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model>";
}

std::string warnings_of(const std::string& content) {
  std::string out;
  const World w = World::load_string(world(content));
  for (const std::string& warning : w.warnings()) out += warning + '\n';
  return out;
}

TEST(OddFiles, ShapesThatAreDeepInEachOtherFromTheStartAreNamed) {
  EXPECT_EQ(warnings_of(ground() + ball_at(0.097, "a")), "");  // 3 mm: lies on it
  EXPECT_EQ(warnings_of(ground() + ball_at(0.07, "a")),
            "shapes that collide are in each other from the start: ground::l and a::l by 30 mm\n");
  EXPECT_EQ(warnings_of(ground() + ball_at(0.09, "a") + ball_at(0.22, "b")),
            "shapes that collide are in each other from the start: a::l and b::l by 70 mm and 1 more\n");
}

std::string box_at(double x, double height, const std::string& name) {
  return "<model name='" + name + "'><pose>" + std::to_string(x) + " 0 " + std::to_string(height) + " 0 0 0</pose><link name='l'>" +
         inertial(1, 1e-2) +
         "<collision name='c'><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model>";
}

TEST(OddFiles, ShapesInEachOtherAreNamedHoweverManyOthersOnlyTouch) {
  for (const int boxes : {12, 50, 400}) {
    std::string content = ground();
    for (int i = 1; i <= boxes; ++i) content += box_at(0.5 * i, 0.0999, "m" + std::to_string(i));  // four contacts each
    content += ball_at(5, "a") + ball_at(5.125, "b");
    EXPECT_EQ(warnings_of(content), "shapes that collide are in each other from the start: a::l and b::l by 75 mm\n") << boxes;
    const World w = World::load_string(world(content));
    EXPECT_EQ(w.contact_count(), 4 * boxes + 1) << boxes;
  }
}

}  // namespace
}  // namespace vsa::engine::testing
