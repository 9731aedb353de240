// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A World whose links were given other masses, inertias and frictions goes as one whose file says so: with all that MuJoCo derives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "batch_test.hpp"

namespace vsa::batch {
namespace {

using engine::LinkParameters;
using engine::World;

struct Masses {
  double body_kg = 1.3, lid_kg = 0.4, body_mu = 0.7, floor_mu = 0.9;
  std::array<double, 3> lid_kgm2{3e-3, 2e-3, 1.5e-3};
};

std::string inertial(double mass, std::array<double, 3> i) {
  return fmt::format(
      "<inertial><mass>{}</mass><inertia><ixx>{}</ixx><iyy>{}</iyy><izz>{}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>"
      "</inertial>",
      mass, i[0], i[1], i[2]);
}

std::string box(double mu, const char* size) {
  return fmt::format(
      "<collision name='c'><geometry><box><size>{}</size></box></geometry><surface><friction><ode><mu>{}</mu><mu2>{}</mu2></ode>"
      "</friction></surface></collision>",
      size, mu, mu);
}

/// A box with a lid on a hinge lies askew above a floor.
World chest(const Masses& m = {}) {
  return World::load_string(
      "<?xml version='1.0'?><sdf version='1.6'><world name='w'><physics name='p' "
      "type='ode'><max_step_size>0.001</max_step_size></physics>"
      "<model name='floor'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal><size>9 9"
      "</size></plane></geometry><surface><friction><ode><mu>" +
      fmt::format("{0}</mu><mu2>{0}", m.floor_mu) +
      "</mu2></ode></friction></surface></collision></link></model><model name='chest'><pose>0 0 0.2 0.1 0.2 0</pose><link "
      "name='body'>" +
      inertial(m.body_kg, {9e-3, 8e-3, 7e-3}) + box(m.body_mu, "0.3 0.2 0.1") +
      "</link><link name='lid'><pose>0 0 0.1 0 0 0</pose>" + inertial(m.lid_kg, m.lid_kgm2) +
      "</link><joint name='hinge' type='revolute'><parent>body</parent><child>lid</child><axis><xyz>1 0 "
      "0</xyz><limit><lower>-0.5</lower>"
      "<upper>0.8</upper></limit></axis></joint></model></world></sdf>");
}

void push(World& w, int steps) {
  w.apply_wrench(w.link("chest::body"), {{6, 1, 0}, {}, {}});
  for (int k = 0; k < steps; ++k) w.step();
}

/// The first world given what the second's file says.
void give(World& w, const Masses& m) {
  LinkParameters body = w.link_parameters(w.link("chest::body")), lid = w.link_parameters(w.link("chest::lid"));
  LinkParameters floor = w.link_parameters(w.link("floor::l"));
  body.mass_kg = m.body_kg;
  body.friction = m.body_mu;
  lid.mass_kg = m.lid_kg;
  lid.inertia_kgm2 = m.lid_kgm2;
  floor.friction = m.floor_mu;
  w.set_link_parameters(w.link("chest::body"), body);
  w.set_link_parameters(w.link("chest::lid"), lid);
  w.set_link_parameters(w.link("floor::l"), floor);
}

TEST(LinkParameters, MakeTheWorldThatAFileWithThemMakes) {
  const Masses heavy{2.1, 0.7, 0.6, 0.4, {6e-3, 5e-3, 2e-3}};
  World changed = chest(), file = chest(heavy), plain = chest();
  give(changed, heavy);
  for (World* w : {&changed, &file, &plain}) push(*w, 400);
  EXPECT_GT(file.contact_count(), 0);
  EXPECT_EQ(first_difference(numbers_of(changed), numbers_of(file)), std::nullopt);
  EXPECT_NE(first_difference(numbers_of(changed), numbers_of(plain)), std::nullopt);
  EXPECT_EQ(changed.energy().kinetic, file.energy().kinetic);
  EXPECT_EQ(changed.energy().gravitational, file.energy().gravitational);
  EXPECT_EQ(changed.center_of_mass("chest"), file.center_of_mass("chest"));
  std::vector<double> a(changed.dof_count() * changed.dof_count()), b = a;
  changed.mass_matrix(a);
  file.mass_matrix(b);
  EXPECT_EQ(a, b);
}

TEST(LinkParameters, AreThoseOfTheFileAgainWhenTheyAreGivenBackAndClonesHaveTheirOwn) {
  World w = chest(), plain = chest();
  give(w, {2.1, 0.7, 0.6, 0.4, {6e-3, 5e-3, 2e-3}});
  World clone = w.clone();
  EXPECT_EQ(clone.link_parameters(clone.link("chest::lid")).mass_kg, 0.7);
  give(w, {});
  for (World* x : {&w, &plain, &clone}) push(*x, 300);
  EXPECT_EQ(first_difference(numbers_of(w), numbers_of(plain)), std::nullopt);
  EXPECT_NE(first_difference(numbers_of(clone), numbers_of(plain)), std::nullopt);
  World again = chest();
  push(again, 300);
  EXPECT_EQ(first_difference(numbers_of(again), numbers_of(plain)), std::nullopt) << "what is kept of the file is as it was";
  w.reset();
  EXPECT_EQ(w.link_parameters(w.link("chest::lid")), plain.link_parameters(plain.link("chest::lid")));
}

TEST(LinkParameters, APairHasTheSmallerOfItsTwoFrictions) {
  for (const bool floor : {true, false}) {
    World w = chest();
    LinkParameters p = w.link_parameters(w.link(floor ? "floor::l" : "chest::body"));
    p.friction = 0.0;  // not even a contact's tangential forces
    w.set_link_parameters(w.link(floor ? "floor::l" : "chest::body"), p);
    push(w, 400);
    World rough = chest();
    push(rough, 400);
    EXPECT_GT(w.pose(w.link("chest::body")).position[0], 3 * rough.pose(rough.link("chest::body")).position[0]) << floor;
  }
}

TEST(LinkParameters, ThatNoBodyHasAreRefusedAndNothingChanges) {
  World w = chest();
  const auto before = w.link_parameters(w.link("chest::lid"));
  const auto refused = [&](const char* link, const LinkParameters& p, const char* word) {
    try {
      w.set_link_parameters(w.link(link), p);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refused("chest::lid", {0.4, {5e-3, 1e-3, 1e-3}, std::nullopt}, "up to the sum of the other two"));
  EXPECT_TRUE(refused("chest::lid", {-0.4, before.inertia_kgm2, std::nullopt}, "mass_kg = -0.4"));
  EXPECT_TRUE(refused("chest::lid", {0.4, before.inertia_kgm2, 0.5}, "no collision shape"));
  EXPECT_TRUE(refused("chest::body", {0.4, {1e-3, 1e-3, 1e-3}, std::nullopt}, "can't be taken away"));
  EXPECT_TRUE(refused("chest::body", {0.4, {1e-3, 1e-3, 1e-3}, -1.0}, "0 … 1000000"));
  EXPECT_TRUE(refused("floor::l", {1, {}, 0.9}, "static"));
  EXPECT_TRUE(refused("chest::body", {0.4, {1e-3, std::nan(""), 1e-3}, 0.7}, "nan"));
  EXPECT_EQ(w.link_parameters(w.link("chest::lid")), before);
}

/// A double pendulum; a soft tendon limits the difference of its angles.
World tied() {
  World w = World::load_string(
      "<mujoco model='arm'><option timestep='0.001'/><worldbody><body name='a'><joint name='j0' axis='0 1 0'/>"
      "<inertial pos='0 0 -0.1' mass='0.3' diaginertia='0.002 0.002 0.0005'/>"
      "<body name='b' pos='0 0 -0.2'><joint name='j1' axis='0 1 0'/>"
      "<inertial pos='0 0 -0.1' mass='0.3' diaginertia='0.002 0.002 0.0005'/></body></body></worldbody>"
      "<tendon><fixed name='t' limited='true' range='-0.1 0.1' solreflimit='0.1 1' solimplimit='0.5 0.5 0.01'>"
      "<joint joint='j0' coef='1'/><joint joint='j1' coef='-1'/></fixed></tendon></mujoco>");
  w.set_joint("arm::j1", 0.6, 0);
  return w;
}

/// MuJoCo derives a tendon's weight in its rows from the masses, too.
TEST(LinkParameters, CopiesWithALimitedTendonGoAsWorldsForAnyNumberOfThreads) {
  const std::vector<double> masses{0.3, 3, 30};
  for (const std::size_t threads : {1, 2}) {
    Batch batch(tied(), masses.size(), threads);
    std::vector<Setting> settings;
    for (std::size_t c = 0; c < masses.size(); ++c) settings.push_back({c, "arm::b", "link.mass_kg", masses[c]});
    batch.set(settings);
    batch.step(200);
    for (std::size_t c = 0; c < masses.size(); ++c) {
      World alone = tied();
      LinkParameters p = alone.link_parameters(alone.link("arm::b"));
      for (double& moment : p.inertia_kgm2) moment *= masses[c] / p.mass_kg;
      p.mass_kg = masses[c];
      alone.set_link_parameters(alone.link("arm::b"), p);
      alone.run(0.2);
      EXPECT_EQ(batch.joint_position()[2 * c], alone.joint_angle("arm::j0")) << masses[c] << " kg, threads " << threads;
      EXPECT_EQ(batch.joint_position()[2 * c + 1], alone.joint_angle("arm::j1")) << masses[c] << " kg, threads " << threads;
    }
  }
}

}  // namespace
}  // namespace vsa::batch
