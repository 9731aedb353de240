// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "vsa/engine/world.hpp"

int main() {
  auto world = vsa::engine::World::load("bench_free.sdf");  // a built-in world; any SDF file does
  const auto& joint = world.actuators().front();
  world.command(joint.name, 1.0, 0.3);  // equilibrium and stiffness preset, rad
  const auto before = world.snapshot();
  world.run(2.0);
  const auto now = world.read(joint);
  std::printf("shaft %.3f rad, stiffness %.2f N·m/rad, current %.2f A\n", now.shaft_rad, now.stiffness_Nm_per_rad,
              now.current_A[0]);
  world.restore(*before);
  std::printf("back at %.3f s\n", world.time_s());

  world.place(joint, {0.5, 0.3});  // shaft, motors and firmware there, without a kick
  auto another = world.clone();
  another.run(0.5);
  std::printf("placed at 0.500 rad, half a second later at %.3f rad\n", another.read(joint).shaft_rad);
}
