// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// mujoco-sweep PLUGIN knee.xml: a knee is struck at presets from soft to stiff, each on a thread of its own with its own mjData, and
// goes on from one state that they share. MuJoCo from 3.2 on; PLUGIN is libvsa-mujoco-VERSION.so.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

namespace {

constexpr int kStiffness = 5, kDeflection = 8;  // places among the sensor's numbers (docs/howto/mujoco.md)
constexpr int kPresets = 7;

struct Struck {
  double preset = 0, stiffness = 0, deflection = 0;
};

void steps(const mjModel* m, mjData* d, int n) {
  for (int k = 0; k < n; ++k) mj_step(m, d);
}

/// Settles at a preset, is struck, and tells how far it gave way.
Struck strike(const mjModel* m, const std::vector<mjtNum>& start, double preset) {
  mjData* d = mj_makeData(m);
  mj_setState(m, d, start.data(), mjSTATE_FULLPHYSICS);
  d->ctrl[0] = 0.5;
  d->ctrl[1] = preset;
  steps(m, d, 1500);
  Struck out{preset, d->sensordata[kStiffness], 0};
  const double at_rest = d->sensordata[kDeflection];
  d->qvel[0] += 3;
  for (int k = 0; k < 150; ++k) {
    mj_step(m, d);
    out.deflection = std::max(out.deflection, std::abs(d->sensordata[kDeflection] - at_rest));
  }
  mj_deleteData(d);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "mujoco-sweep PLUGIN knee.xml\n");
    return 2;
  }
  mj_loadPluginLibrary(argv[1]);
  std::array<char, 1000> error{};
  mjModel* m = mj_loadXML(argv[2], nullptr, error.data(), static_cast<int>(error.size()));
  if (m == nullptr) {
    std::fprintf(stderr, "%s\n", error.data());
    return 1;
  }
  mjData* d = mj_makeData(m);
  steps(m, d, 500);
  std::vector<mjtNum> start(static_cast<std::size_t>(mj_stateSize(m, mjSTATE_FULLPHYSICS)));
  mj_getState(m, d, start.data(), mjSTATE_FULLPHYSICS);
  std::array<Struck, kPresets> all;
  std::vector<std::thread> threads;
  for (int i = 0; i < kPresets; ++i) threads.emplace_back([&, i] { all[static_cast<std::size_t>(i)] = strike(m, start, 0.1 * i); });
  for (std::thread& thread : threads) thread.join();
  std::printf("preset_rad,stiffness_Nm_per_rad,deflection_rad\n");
  for (const Struck& s : all) std::printf("%.1f,%.2f,%.3f\n", s.preset, s.stiffness, s.deflection);
  mj_deleteData(d);
  mj_deleteModel(m);
}
