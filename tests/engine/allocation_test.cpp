// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a step takes from the heap: nothing, whatever goes on in it.
#include <cmath>

#include "arm.hpp"
#include "vsa/motion/gait.hpp"

long allocation_count();  // allocation_count.cpp

namespace vsa::engine::testing {
namespace {

constexpr int kFirst = 100;  // steps that may still grow what the world needs

long allocations_of(World& w, int steps) {
  const long before = allocation_count();
  for (int k = 0; k < steps; ++k) {
    for (const ActuatorRef& a : w.actuators()) w.command(a, 0.5 * std::sin(5 * w.time_s()), 0.3);
    w.step();
  }
  return allocation_count() - before;
}

TEST(Allocation, AStepOfTheSnakeOnTheGroundTakesNothingFromTheHeap) {
  World w = World::load(VSA_SOURCE_DIR "/models/worlds/snake_flat.sdf");
  allocations_of(w, kFirst);
  EXPECT_EQ(allocations_of(w, 400), 0);
  EXPECT_GT(w.contact_count(), 0);
}

TEST(Allocation, AStepOfSeveralSubstepsWithHandsAtWorkTakesNothingFromTheHeap) {
  std::string text = arm();
  const std::string actuator = "<actuator ";
  World w = World::load_string(text.replace(text.find(actuator), 0, "<substeps>4</substeps>"));
  ASSERT_EQ(w.substeps(), 4);
  Pull pull;
  pull.link = w.link("arm::fore").index();
  pull.target_m = {0.3, 0.1, 1.1};
  w.pull({pull});
  w.apply_wrench(w.link("arm::upper"), {{0, 0, 1}, {0, 0.1, 0}, {0.1, 0, 0}});
  w.apply_torque(w.joint("arm::elbow"), 0.05);
  allocations_of(w, kFirst);
  EXPECT_EQ(allocations_of(w, 400), 0);
}

TEST(Allocation, AGaitThatSteersTakesNothingFromTheHeap) {
  World w = World::load(VSA_SOURCE_DIR "/models/worlds/snake_flat.sdf");
  motion::Gait gait = motion::Gait::load(VSA_SOURCE_DIR "/models/gaits/steered.toml");
  const auto step = [&] {
    gait.apply(w);
    w.step();
  };
  while (w.time_s() < 2) step();  // more than a period
  const long before = allocation_count();
  for (int k = 0; k < 400; ++k) step();
  EXPECT_EQ(allocation_count() - before, 0);
}

/// Which come when all is warm: the line is then worked out bit by bit, and more waits on it than ever before.
TEST(Allocation, AStepWithFaultsOnTheLineTakesNothingFromTheHeap) {
  World w = World::load(VSA_SOURCE_DIR "/models/worlds/snake_flat.sdf");
  allocations_of(w, kFirst);
  device::Faults faults;
  faults.lost_byte = 0.05;
  faults.flipped_byte = 0.05;
  for (std::size_t i = 0; i < w.robot(0).size(); ++i) w.robot(0).set_faults(i, faults);
  EXPECT_EQ(allocations_of(w, 400), 0);
}

}  // namespace
}  // namespace vsa::engine::testing
