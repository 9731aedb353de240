// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Hands that pull, and the contacts that the engine tells of.
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

/// A ball of 2 kg, radius 0.1 m, at a height; free or above a ground.
std::string ball(double height, const std::string& mass = "2") {
  return "<model name='ball'><pose>0 0 " + std::to_string(height) + " 0 0 0</pose><link name='l'>" +
         inertial(std::stod(mass), 0.01) +
         "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model>";
}

std::size_t link_of(const World& w, const std::string& name) {
  for (std::size_t i = 0; i < w.links().size(); ++i) {
    if (w.links()[i].name == name) return i;
  }
  ADD_FAILURE() << name;
  return 0;
}

TEST(Pull, HoldsAWeightWhereTheSpringsForceIsItsOwn) {
  World w = World::load_string(world(ball(1)));
  w.pull({{link_of(w, "ball::l"), {}, {0, 0, 1}, 200, 30, 100}});
  w.run(5);
  EXPECT_NEAR(pose_of(w, "ball::l").position[2], 1 - 2 * kGravity / 200, 1e-6);
}

TEST(Pull, SwingsAWeightAsADampedOscillatorDoes) {
  World w = World::load_string(world(ball(0), "0 0 0"));
  const double k = 50, c = 2, m = 2, gamma = c / (2 * m), omega = std::sqrt(k / m - gamma * gamma);
  w.pull({{link_of(w, "ball::l"), {}, {0.1, 0, 0}, k, c, 1000}});
  for (int i = 0; i < 2000; ++i) {
    w.step();
    const double t = w.time_s();
    const double exact = 0.1 * (1 - std::exp(-gamma * t) * (std::cos(omega * t) + gamma / omega * std::sin(omega * t)));
    ASSERT_NEAR(pose_of(w, "ball::l").position[0], exact, 0.1 * 0.01) << t;
  }
}

TEST(Pull, NeverPullsHarderThanItsLimit) {
  World w = World::load_string(world(ball(0), "0 0 0"));
  w.pull({{link_of(w, "ball::l"), {}, {0, 100, 0}, 1000, 0, 4}});
  w.run(1);
  EXPECT_NEAR(pose_of(w, "ball::l").position[1], 0.5 * (4.0 / 2) * 1, 2e-3);
}

TEST(Pull, AtItsLimitPullsTowardsItsTargetWhateverItsSpringDamperAndTheStep) {
  // A rod of 0.1 m that hangs on a hinge with a spring of 2 N·m/rad; its tip can go along x only, the target is up there, too.
  const std::string rod =
      "<model name='m'><pose>0 0 1 0 0 0</pose><link name='l'>" + inertial(0.05, 1e-4, "0 0 -0.05 0 0 0") +
      "</link><joint name='j' type='revolute'><parent>world</parent><child>l</child><axis><xyz>0 1 0</xyz>"
      "<dynamics><damping>0.02</damping><spring_stiffness>2</spring_stiffness></dynamics></axis></joint></model>";
  constexpr double kMost_N = 10, kLength_m = 0.1;
  double low = -1.5, high = 0;  // of the balance of torques about the hinge
  for (int n = 0; n < 60; ++n) {
    const double q = (low + high) / 2, x = -kLength_m * std::sin(q), z = -kLength_m * std::cos(q), dx = 1 - x, dz = 1 - z;
    const double force = kMost_N / std::hypot(dx, dz);
    (z * force * dx - x * force * dz - 2 * q > 0 ? low : high) = q;
  }
  for (const double step_s : {1e-3, 4e-3}) {
    for (const auto& [k, c] : {std::pair{100.0, 5.0}, {1000.0, 50.0}, {1e5, 1e4}}) {
      WorldOptions options;
      options.step_s = step_s;
      World w = World::load_string(world(rod, "0 0 0"), options);
      w.pull({{link_of(w, "m::l"), {0, 0, -kLength_m}, {1, 0, 2}, k, c, kMost_N}});
      w.run(4);
      EXPECT_NEAR(w.joint_angle("m::j"), low, 1e-5) << k << " N/m, " << c << " N·s/m, " << step_s << " s";
    }
  }
}

TEST(Pull, AtAPointBesideTheCentreOfMassTurnsTheBody) {
  World w = World::load_string(world(ball(0), "0 0 0"));
  // 4 N at a lever of 0.05 m on 0.01 kg·m²: 20 rad/s², as long as the turn is small.
  w.pull({{link_of(w, "ball::l"), {0.05, 0, 0}, {0.05, 1000, 0}, 1000, 0, 4}});
  w.run(0.05);
  const auto q = pose_of(w, "ball::l").quaternion;
  EXPECT_NEAR(2 * std::atan2(q[3], q[0]), 0.5 * 20 * 0.05 * 0.05, 6e-4);
}

TEST(Pull, StaysStableOnABodyOfAFewGrams) {
  World w = World::load_string(world(ball(0, "0.002"), "0 0 0"));
  w.pull({{link_of(w, "ball::l"), {0.1, 0, 0}, {0.5, 0, 0}, 1e5, 1e4, 1e4}});
  w.run(2);
  const Pose pose = pose_of(w, "ball::l");
  EXPECT_NEAR(pose.position[0], 0.4, 1e-3);
}

TEST(Pull, EndsWithAReset) {
  World w = World::load_string(world(ball(0), "0 0 0"));
  w.pull({{link_of(w, "ball::l"), {}, {1, 0, 0}, 100, 1, 10}});
  w.run(0.5);
  w.reset();
  EXPECT_TRUE(w.pulls().empty());
  w.run(0.5);
  EXPECT_EQ(pose_of(w, "ball::l").position[0], 0);
}

TEST(Pull, RefusesWhatItCantDoAndKeepsWhatWas) {
  World w = World::load_string(world(ball(1) + ground()));
  const std::size_t link = link_of(w, "ball::l");
  w.pull({{link, {}, {0, 0, 1}, 100, 1, 10}});
  const std::vector<Pull> bad = {{99, {}, {}, 1, 1, 1},
                                 {link_of(w, "ground::l"), {}, {}, 1, 1, 1},
                                 {link, {NAN, 0, 0}, {}, 1, 1, 1},
                                 {link, {}, {0, INFINITY, 0}, 1, 1, 1},
                                 {link, {}, {}, -1, 1, 1},
                                 {link, {}, {}, 1, 1e5, 1},
                                 {link, {}, {}, 1, 1, NAN}};
  for (const Pull& pull : bad) EXPECT_THROW(w.pull({pull}), InputError);
  ASSERT_EQ(w.pulls().size(), 1U);
  EXPECT_EQ(w.pulls()[0].stiffness_N_per_m, 100);
}

TEST(Contacts, CarryTheWeightOfWhatRestsOnThem) {
  World w = World::load_string(world(ball(0.1) + ground()));
  std::vector<Contact> contacts;
  w.contacts(contacts);
  EXPECT_TRUE(contacts.empty()) << "before the first step";
  w.run(2);
  w.contacts(contacts);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].force_N[2], 2 * kGravity, 1e-3);
  EXPECT_NEAR(contacts[0].force_N[0], 0, 1e-3);
  EXPECT_NEAR(contacts[0].position[2], 0, 1e-3);
  w.reset();
  w.contacts(contacts);
  EXPECT_TRUE(contacts.empty()) << "after a reset";
}

}  // namespace
}  // namespace vsa::engine::testing
