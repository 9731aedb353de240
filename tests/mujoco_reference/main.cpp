// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-mujoco-reference WORLD DURATION_S: a world of tests/mujoco/motion.hpp in the embedded engine, a row of "time_s deflection_rad …"
// each 10 ms, Coriolis torques as in mj_step. In a program of its own: MuJoCo 3 and 2.2.2 can't be in one.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "mujoco/motion.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/physics/mujoco.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    vsa::engine::WorldOptions options;
    options.physics = vsa::physics::mujoco(vsa::physics::Coriolis::as_in_mj_step);
    vsa::engine::World world = vsa::engine::World::load(argv[1], options);
    const double duration_s = std::atof(argv[2]);
    for (int step = 0; world.time_s() < duration_s - 1e-9; ++step) {
      if (step % vsa::mujoco::test::kCommandEvery == 0) {
        std::printf("%.9g", world.time_s());
        for (std::size_t i = 0; i < world.actuators().size(); ++i) {
          const auto c = vsa::mujoco::test::command_at(i, world.time_s());
          std::printf(" %.17g", world.read(world.actuators()[i]).deflection_rad);
          world.command(world.actuators()[i], c.equilibrium, c.preset);
        }
        std::printf("\n");
      }
      world.step();
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
