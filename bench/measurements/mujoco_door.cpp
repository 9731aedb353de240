// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the MuJoCo plug-in adds: the snake's step in the embedded engine, and in the same MuJoCo with the plug-in's units beside it
// (tests/mujoco/rig.hpp), told the same. The best of several turns of each, by turns, since machines are busy.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "mujoco/motion.hpp"
#include "mujoco/rig.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/engine/world.hpp"

namespace {

using namespace vsa;
constexpr int kTurns = 15, kSteps = 2000;

template <class Step>
double us_per_step(Step&& step) {
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < kSteps; ++k) step(k);
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() / kSteps;
}

}  // namespace

int main() {
  const auto file = std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds/snake_flat.xml";
  engine::World world = engine::World::load(file);
  const std::string mjcf = engine::export_plugin_mjcf(file).file.bytes;
  std::string blind = mjcf;  // without sensors
  blind.erase(blind.find("<sensor>"), blind.find("</sensor>") + 9 - blind.find("<sensor>"));
  const mujoco::test::Rig rig(mjcf), blind_rig(blind);
  mujoco::test::Data data(rig), blind_data(blind_rig);
  const std::size_t n = world.actuators().size();
  double own = 1e9, with = 1e9, without = 1e9;
  const auto in_mujoco = [&](mujoco::test::Data& d, int k) {
    if (k % mujoco::test::kCommandEvery == 0) {
      for (std::size_t i = 0; i < n; ++i) {
        const auto c = mujoco::test::command_at(i, d.d().time);
        d.d().ctrl[2 * i] = c.equilibrium;
        d.d().ctrl[2 * i + 1] = c.preset;
      }
    }
    d.step();
  };
  for (int turn = 0; turn < kTurns; ++turn) {
    own = std::min(own, us_per_step([&](int k) {
                     if (k % mujoco::test::kCommandEvery == 0) {
                       for (std::size_t i = 0; i < n; ++i) {
                         const auto c = mujoco::test::command_at(i, world.time_s());
                         world.command(world.actuators()[i], c.equilibrium, c.preset);
                       }
                     }
                     world.step();
                   }));
    with = std::min(with, us_per_step([&](int k) { in_mujoco(data, k); }));
    without = std::min(without, us_per_step([&](int k) { in_mujoco(blind_data, k); }));
  }
  std::printf(
      "snake_flat, 12 units, MuJoCo %s, us a step, best of %d:\n  embedded engine %.1f\n  plug-in's units %.1f (%+.0f %%)\n"
      "  and 12 sensors  %.1f (%+.0f %%)\n",
      mj_versionString(), kTurns, own, without, 100 * (without / own - 1), with, 100 * (with / own - 1));
}
