// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which of MuJoCo 3's integrators, and islands or not: worlds with the plug-in's units, microseconds of the processor a step, and how
// far joints are after 0.3 s from where steps an eighth as long have them.
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include "mujoco3/plugged.hpp"

namespace {

using namespace vsa::mujoco::test;
constexpr double kWhile_s = 0.3;
constexpr int kTurns = 5;

struct Options {
  const char* name;
  int integrator;
  bool islands;
};
constexpr std::array<Options, 5> kAll{Options{"Euler", mjINT_EULER, false}, Options{"Euler, islands", mjINT_EULER, true},
                                      Options{"implicitfast", mjINT_IMPLICITFAST, false},
                                      Options{"implicitfast, islands", mjINT_IMPLICITFAST, true},
                                      Options{"implicit", mjINT_IMPLICIT, false}};

void set(mjModel& m, const Options& options) {
  m.opt.integrator = options.integrator;
#if mjVERSION_HEADER >= 3003006
  m.opt.disableflags = options.islands ? m.opt.disableflags & ~mjDSBL_ISLAND : m.opt.disableflags | mjDSBL_ISLAND;
#else
  m.opt.enableflags = options.islands ? m.opt.enableflags | mjENBL_ISLAND : m.opt.enableflags & ~mjENBL_ISLAND;
#endif
}

struct Run {
  std::vector<double> joints;
  double us = 0;
};

/// With `parts` steps for one; told as often.
Run run(const mjModel& m, int parts) {
  const DataPtr d(mj_makeData(&m));
  mj_resetDataKeyframe(&m, d.get(), 0);
  const int steps = static_cast<int>(std::lround(kWhile_s / m.opt.timestep));
  const std::clock_t begin = std::clock();
  for (int k = 0; k < steps; ++k) step(m, *d, k % parts == 0 ? k / parts : 1);
  Run out{{}, 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / steps};
  for (int j = 0; j < static_cast<int>(m.njnt); ++j)
    if (m.jnt_type[j] == mjJNT_HINGE || m.jnt_type[j] == mjJNT_SLIDE) out.joints.push_back(d->qpos[m.jnt_qposadr[j]]);
  return out;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

int main() {
  std::printf("MuJoCo %s\n%-14s %-22s %8s %10s\n", mj_versionString(), "world", "options", "us/step", "off, rad");
  for (const char* world : {"bench_load", "snake_flat", "snake_rubble", "frank_ball", "gripper_soft"}) {
    const ModelPtr m(mj_copyModel(nullptr, &exported(world)));
    std::array<Run, kAll.size()> runs;
    for (int turn = 0; turn < kTurns; ++turn) {
      for (std::size_t i = 0; i < kAll.size(); ++i) {
        set(*m, kAll[i]);
        Run now = run(*m, 1);
        if (turn == 0 || now.us < runs[i].us) runs[i] = std::move(now);
      }
    }
    m->opt.timestep /= 8;
    set(*m, kAll[0]);
    const Run fine = run(*m, 8);
    for (std::size_t i = 0; i < kAll.size(); ++i)
      std::printf("%-14s %-22s %8.1f %10.2g\n", world, kAll[i].name, runs[i].us, rms(runs[i].joints, fine.joints));
  }
}
