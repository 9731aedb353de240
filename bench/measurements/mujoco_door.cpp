// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the MuJoCo plug-in adds: the snake's step in the embedded engine, and in the same MuJoCo with the plug-in's units beside it
// (tests/mujoco/rig.hpp), told the same. They move alike, so turns of a few steps by each are the same work at the same time on the
// same busy machine: processor time, and of the ratios medians over the turns.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <vector>

#include "mujoco/motion.hpp"
#include "mujoco/rig.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/engine/world.hpp"

namespace {

using namespace vsa;
constexpr int kTurns = 400, kSteps = 50;

template <class Step>
double us_per_step(Step&& step) {
  const std::clock_t begin = std::clock();
  for (int k = 0; k < kSteps; ++k) step(k);
  return 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / kSteps;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// Two commands a unit, now and then.
template <class Tell>
void tell(int step, std::size_t units, double time_s, Tell&& one) {
  if (step % mujoco::test::kCommandEvery != 0) return;
  for (std::size_t i = 0; i < units; ++i) one(i, mujoco::test::command_at(i, time_s));
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
  data.key(0);
  blind_data.key(0);
  const std::size_t n = world.actuators().size();
  const auto own_step = [&](int k) {
    tell(k, n, world.time_s(), [&](std::size_t i, auto c) { world.command(world.actuators()[i], c.equilibrium, c.preset); });
    world.step();
  };
  const auto in_mujoco = [&](mujoco::test::Data& d, int k) {
    tell(k, n, d.d().time, [&](std::size_t i, auto c) {
      d.d().ctrl[2 * i] = c.equilibrium;
      d.d().ctrl[2 * i + 1] = c.preset;
    });
    d.step();
  };
  std::array<std::vector<double>, 3> us, ratio;
  for (int turn = 0; turn < kTurns; ++turn) {
    const std::array<double, 3> now{us_per_step(own_step), us_per_step([&](int k) { in_mujoco(blind_data, k); }),
                                    us_per_step([&](int k) { in_mujoco(data, k); })};
    for (std::size_t i = 0; i < now.size(); ++i) {
      us[i].push_back(now[i]);
      ratio[i].push_back(now[i] / now[0]);
    }
  }
  std::printf("snake_flat, %zu units, MuJoCo %s, us a step, medians of %d turns:\n", n, mj_versionString(), kTurns);
  const std::array<const char*, 3> what{"embedded engine", "plug-in's units", "and 12 sensors"};
  for (std::size_t i = 0; i < what.size(); ++i)
    std::printf("  %-16s %.1f (%+.1f %%)\n", what[i], median(us[i]), 100 * (median(ratio[i]) - 1));
}
