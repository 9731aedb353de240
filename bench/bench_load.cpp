// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What it costs to make a World: of a file that this process hasn't read yet, of the same file again, and by clone(). All three in
// turns, each iteration on a text of its own: the file's, with a comment that nobody has written before.
#include <benchmark/benchmark.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>

#include "vsa/engine/world.hpp"

namespace {

using vsa::engine::World;

template <class Make>
double timed_s(Make make) {
  const auto begin = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(make());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void load(benchmark::State& state, const char* name) {
  std::ifstream in(std::string(VSA_SOURCE_DIR "/models/worlds/") + name);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  double first_s = 0, second_s = 0, clone_s = 0;
  int n = 0;
  for (auto _ : state) {
    const std::string text = file + "<!-- " + std::to_string(++n) + " -->";
    first_s += timed_s([&] { return World::load_string(text); });
    const double again_s = timed_s([&] { return World::load_string(text); });
    second_s += again_s;
    const World world = World::load_string(text);
    clone_s += timed_s([&] { return world.clone(); });
    state.SetIterationTime(again_s);
  }
  state.counters["first_ms"] = first_s * 1e3 / n;
  state.counters["second_ms"] = second_s * 1e3 / n;
  state.counters["clone_ms"] = clone_s * 1e3 / n;
  state.counters["second_over_first_percent"] = 100 * second_s / first_s;
}
BENCHMARK_CAPTURE(load, bench_free, "bench_free.sdf")->UseManualTime()->Iterations(10);
BENCHMARK_CAPTURE(load, snake_flat, "snake_flat.sdf")->UseManualTime()->Iterations(10);
BENCHMARK_CAPTURE(load, snake_rubble, "snake_rubble.sdf")->UseManualTime()->Iterations(10);
BENCHMARK_CAPTURE(load, frank, "frank.sdf")->UseManualTime()->Iterations(10);

}  // namespace

BENCHMARK_MAIN();
