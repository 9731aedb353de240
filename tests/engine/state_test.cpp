// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A World as a value in time: determinism, snapshots, reset, blow-ups.
#include <algorithm>
#include <bit>
#include <cmath>

#include "worlds.hpp"

namespace vsa::engine::testing {
namespace {

/// A chain of three boxes that falls on the ground and tumbles.
std::string tumbler() {
  std::string m = ground(0.6) + "<model name='m'><pose>0 0 0.4 0.3 0.2 0.1</pose>";
  for (int i = 0; i < 3; ++i) {
    m += "<link name='l" + std::to_string(i) + "'><pose>" + std::to_string(0.2 * i) + " 0 0 0 0 0</pose>" + inertial(1, 0.002) +
         "<collision name='c'><geometry><box><size>0.15 0.1 0.1</size></box></geometry>" + friction(0.6) + "</collision></link>";
  }
  for (int i = 0; i < 2; ++i) {
    m += "<joint name='j" + std::to_string(i) + "' type='revolute'><pose>-0.1 0 0 0 0 0</pose><parent>l" + std::to_string(i) +
         "</parent><child>l" + std::to_string(i + 1) + "</child><axis><xyz>0 " + (i == 0 ? "1 0" : "0 1") +
         "</xyz><dynamics><damping>0.01</damping></dynamics></axis></joint>";
  }
  return world(m + "</model>");
}

std::vector<std::uint64_t> bits(const World& w) {
  std::vector<Pose> poses(w.links().size());
  w.poses(poses);
  std::vector<std::uint64_t> out;
  for (const Pose& p : poses) {
    for (const double x : p.position) out.push_back(std::bit_cast<std::uint64_t>(x));
    for (const double x : p.quaternion) out.push_back(std::bit_cast<std::uint64_t>(x));
  }
  for (const char* j : {"m::j0", "m::j1"}) out.push_back(std::bit_cast<std::uint64_t>(w.joint_speed(j)));
  out.push_back(static_cast<std::uint64_t>(w.time_ns()));
  return out;
}

TEST(State, TwoWorldsGiveTheSameBits) {
  World a = World::load_string(tumbler()), b = World::load_string(tumbler());
  a.run(0.8);
  b.run(0.8);
  EXPECT_GT(a.contact_count(), 0);
  EXPECT_EQ(bits(a), bits(b));
}

TEST(State, LookingChangesNothing) {
  World a = World::load_string(tumbler()), b = World::load_string(tumbler());
  a.run(0.5);
  for (int i = 0; i < 500; ++i) {
    b.step();
    static_cast<void>(b.energy());
    static_cast<void>(b.contact_count());
    static_cast<void>(b.center_of_mass("m"));
  }
  EXPECT_EQ(bits(a), bits(b));
}

TEST(State, ASnapshotIsRestoredBitForBit) {
  World w = World::load_string(tumbler());
  w.run(0.35);
  const auto at = w.snapshot();
  const auto now = bits(w);
  w.run(0.4);
  const auto later = bits(w);
  w.restore(*at);
  EXPECT_EQ(bits(w), now);
  w.run(0.4);
  EXPECT_EQ(bits(w), later);
}

TEST(State, AResetWorldIsAFreshOne) {
  World fresh = World::load_string(tumbler()), used = World::load_string(tumbler());
  const auto first = bits(fresh);
  used.run(0.5);
  used.reset();
  EXPECT_EQ(bits(used), first);
  fresh.run(0.5);
  used.run(0.5);
  EXPECT_EQ(bits(used), bits(fresh));
}

TEST(State, TimeIsCountedInWholeNanoseconds) {
  WorldOptions options;
  options.step_s = 0.0005;
  World w = World::load_string(tumbler(), options);
  EXPECT_DOUBLE_EQ(w.step_s(), 0.0005);
  w.run(0.1);
  EXPECT_EQ(w.time_ns(), 100'000'000);
  World from_file =
      World::load_string(world("<physics type='ode'><max_step_size>0.002</max_step_size></physics><model name='m'><link name='l'>" +
                               inertial(1, 1) + "</link></model>"));
  EXPECT_DOUBLE_EQ(from_file.step_s(), 0.002);
}

TEST(State, ABlowUpStopsWithTimeJointAndValueAndTheWorldStaysWhereItWas) {
  World w = World::load_string(tumbler());
  w.run(0.1);
  w.set_joint("m::j1", 0.1, 1e9);
  const auto before = bits(w);
  try {
    for (int i = 0; i < 10; ++i) w.step();
    FAIL() << "no blow-up";
  } catch (const SimulationError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("t = 0.10"), std::string::npos) << text;
    EXPECT_NE(text.find("m::"), std::string::npos) << text;
    EXPECT_NE(text.find("e+"), std::string::npos) << text;
  }
  EXPECT_EQ(bits(w), before);
  w.set_joint("m::j1", 0.1, 0);
  w.run(0.1);
  for (const std::uint64_t b : bits(w)) EXPECT_TRUE(std::isfinite(std::bit_cast<double>(b)));
}

TEST(State, MoreContactsThanThereWasRoomForAreNoError) {
  std::string m = ground();
  for (int i = 0; i < 2; ++i) {
    m += "<model name='m" + std::to_string(i) + "'><pose>" + std::to_string(20 * i) + " 0 0 0 0 0</pose><link name='l'>" +
         inertial(10, 200, "7.45 0 0.05 0 0 0");
    for (int k = 0; k < 150; ++k) {
      m += "<collision name='c" + std::to_string(k) + "'><pose>" + std::to_string(0.1 * k) +
           " 0 0.05 0 0 0</pose><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>";
    }
    m += "</link></model>";
  }
  World w = World::load_string(world(m));
  w.run(0.02);
  EXPECT_EQ(w.contact_count(), 2 * 150 * 4);
  EXPECT_NEAR(pose_of(w, "m1::l").position[2], 0, 1e-3);
}

/// Slabs that fall askew, so that their contacts come to more than there is room for in the middle of the run.
TEST(State, WhoGetsMoreRoomForContactsGoesOnAsWhoHadIt) {
  const std::string surface = "<surface><friction><ode><mu>.5</mu><mu2>.5</mu2></ode></friction></surface></collision>";
  std::string m =
      "<model name='g'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal>"
      "</plane></geometry>" +
      surface + "</link></model>";
  for (int k = 0; k < 60; ++k) {
    m += "<model name='b" + std::to_string(k) + "'><pose>" + std::to_string(k % 10) + ' ' + std::to_string(k / 10) +
         " 0.05 0.3 0.2 " + std::to_string(k) + "</pose><link name='l'>" + inertial(1, 0.01) +
         "<collision name='c'><geometry><box><size>0.3 0.3 0.02</size></box></geometry>" + surface + "</link></model>";
  }
  World w = World::load_string(world(m));
  const auto before = w.snapshot();
  int most = 0;
  const auto run = [&] {
    std::vector<std::uint64_t> hashes;
    for (int k = 0; k < 400; ++k) {
      w.step();
      most = std::max(most, w.contact_count());
      if (k % 50 == 49) hashes.push_back(w.state_hash());
    }
    return hashes;
  };
  const auto first = run();
  EXPECT_GT(most, 3 * 45) << "more than the room for a shape's contacts that it began with";
  w.restore(*before);
  EXPECT_EQ(run(), first);
}

}  // namespace
}  // namespace vsa::engine::testing
