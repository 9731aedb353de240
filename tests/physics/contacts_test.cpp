// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "vsa/engine/world.hpp"

namespace vsa::engine {
namespace {

constexpr const char* kBox = R"(<sdf version="1.7"><world name="w"><gravity>0 0 -9.81</gravity>
<model name="ground"><static>true</static><link name="plate"><collision name="c"><pose>0 0 -0.5 0 0 0</pose><geometry>
<box><size>4 4 1</size></box></geometry></collision></link></model>
<model name="box"><pose>0 0 0.1 0 0 0</pose><link name="l"><inertial><mass>2</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy>
<izz>0.01</izz></inertia></inertial><collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>
</model></world></sdf>)";

std::array<double, 3> sum(const World& world, std::vector<Contact>& contacts) {
  world.contacts(contacts);
  std::array<double, 3> out{};
  for (const Contact& c : contacts) {
    for (std::size_t i = 0; i < 3; ++i) out[i] += c.force_N[i];
  }
  return out;
}

TEST(Contacts, CarryTheWeightOfABoxAtRestAndNameBothLinks) {
  World world = World::load_string(kBox);
  world.run(1.0);
  std::vector<Contact> contacts;
  const auto force = sum(world, contacts);
  EXPECT_NEAR(force[2], 2 * 9.81, 1e-3);
  EXPECT_NEAR(std::hypot(force[0], force[1]), 0, 1e-3);
  ASSERT_EQ(contacts.size(), 4u);
  for (const Contact& c : contacts) {
    EXPECT_EQ(world.links()[c.link].name, "box::l");
    EXPECT_EQ(world.links()[c.other].name, "ground::plate");
    EXPECT_NEAR(c.position[2], 0, 1e-3);
  }
}

TEST(Contacts, AreNoneBeforeTheFirstStepAndAfterAReset) {
  World world = World::load_string(kBox);
  std::vector<Contact> contacts(3);
  world.contacts(contacts);
  EXPECT_TRUE(contacts.empty());
  world.run(0.1);
  world.contacts(contacts);
  EXPECT_FALSE(contacts.empty());
  world.reset();
  world.contacts(contacts);
  EXPECT_TRUE(contacts.empty());
}

TEST(Contacts, ImpulseIsTheChangeOfMomentum) {
  // Two balls on rails along x; each step's contact force times dt changes each speed by that over its mass, with opposite signs.
  constexpr const char* kRails = R"(<sdf version="1.7"><world name="w"><gravity>0 0 0</gravity>
<model name="a"><link name="l"><inertial><mass>1</mass><inertia><ixx>1e-3</ixx><iyy>1e-3</iyy><izz>1e-3</izz></inertia></inertial>
<collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision></link>
<joint name="rail" type="prismatic"><parent>world</parent><child>l</child><axis><xyz>1 0 0</xyz></axis></joint></model>
<model name="b"><pose>0.2 0 0 0 0 0</pose><link name="l"><inertial><mass>3</mass><inertia><ixx>1e-3</ixx><iyy>1e-3</iyy>
<izz>1e-3</izz></inertia></inertial><collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision></link>
<joint name="rail" type="prismatic"><parent>world</parent><child>l</child><axis><xyz>1 0 0</xyz></axis></joint></model>
</world></sdf>)";
  World world = World::load_string(kRails);
  world.set_joint("a::rail", 0, 2.0);
  std::vector<Contact> contacts;
  double impulse = 0;
  for (int i = 0; i < 200; ++i) {
    world.step();
    world.contacts(contacts);
    for (const Contact& c : contacts) impulse += (world.links()[c.link].name == "b::l" ? 1 : -1) * c.force_N[0] * world.step_s();
  }
  EXPECT_GT(impulse, 1.0);
  EXPECT_NEAR(impulse, 3 * world.joint_speed("b::rail"), 1e-9);
  EXPECT_NEAR(impulse, 1 * (2.0 - world.joint_speed("a::rail")), 1e-9);
}

}  // namespace
}  // namespace vsa::engine
