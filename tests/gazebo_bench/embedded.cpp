// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-gazebo-bench FILE [STEP_S]: the bench run in the embedded engine, which Gazebo's tests compare theirs with.
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "bench_script.hpp"
#include "vsa/engine/world.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: vsa-gazebo-bench FILE [STEP_S]\n";
    return 2;
  }
  try {
    vsa::engine::WorldOptions options;
    if (argc > 2) options.step_s = std::strtod(argv[2], nullptr);
    auto world = vsa::engine::World::load(VSA_SOURCE_DIR "/models/worlds/bench_load.sdf", options);
    vsa::test::command_bench(world.robot(0));
    std::vector<vsa::test::BenchSample> samples;
    const auto steps = std::llround(vsa::test::kBenchDuration_s / world.step_s());
    for (long long i = 0; i < steps; ++i) {
      world.step();
      samples.push_back(vsa::test::sample_bench(world.robot(0), world.time_s()));
    }
    vsa::test::write_bench(argv[1], samples);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
