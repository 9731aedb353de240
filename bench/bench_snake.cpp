// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The snake in the embedded engine: what a step costs with and without its twelve actuators and their bus.
#include <benchmark/benchmark.h>

#include <memory>

#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"

namespace {

using vsa::engine::World;
using vsa::motion::Gait;

World load(bool actuators) {
  vsa::engine::WorldOptions options;
  options.actuators = actuators;
  return World::load(VSA_SOURCE_DIR "/models/worlds/snake_flat.sdf", options);
}

void report(benchmark::State& state) {
  state.counters["real_time_factor"] =
      benchmark::Counter(1e-3 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void still(benchmark::State& state, bool actuators) {
  World world = load(actuators);
  world.run(1.0);
  for (auto _ : state) world.step();
  report(state);
}
BENCHMARK_CAPTURE(still, with_actuators, true);
BENCHMARK_CAPTURE(still, limp_without, false);

void crawling(benchmark::State& state) {
  World world = load(true);
  Gait gait = Gait::load(VSA_SOURCE_DIR "/models/gaits/sidewind.toml");
  const auto step = [&] {
    gait.apply(world);
    world.step();
  };
  while (world.time_s() < 4.0) step();
  for (auto _ : state) step();
  report(state);
}
BENCHMARK(crawling);

/// The actuators' share of the crawling step: the same states, first through the robot alone, then through whole steps.
void actuators_of_the_crawling_snake(benchmark::State& state) {
  World world = load(true);
  Gait gait = Gait::load(VSA_SOURCE_DIR "/models/gaits/sidewind.toml");
  while (world.time_s() < 4.0) {
    gait.apply(world);
    world.step();
  }
  vsa::host::Robot& robot = world.robot(0);
  std::vector<vsa::host::JointIn> in(robot.size());
  std::vector<double> out(robot.size());
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const auto r = robot.read(i);
    in[i] = {r.shaft_rad, r.shaft_speed_rad_per_s, 300.0};
  }
  std::int64_t t = world.time_ns();
  for (auto _ : state) {
    robot.advance(t, 1'000'000, in, out);
    t += 1'000'000;
    for (std::size_t i = 0; i < robot.size(); ++i) {
      in[i].speed_rad_per_s += 1e-3 * 300.0 * (out[i] - 0.05 * in[i].speed_rad_per_s);
      in[i].angle_rad += 1e-3 * in[i].speed_rad_per_s;
    }
    if (t % 12'000'000 == 0) {
      for (std::size_t i = 0; i < robot.size(); ++i)
        robot.command(i, gait.equilibrium(gait.params().groups[i % 2], i / 2, static_cast<double>(t) * 1e-9), std::nullopt);
    }
  }
}
BENCHMARK(actuators_of_the_crawling_snake);

}  // namespace

BENCHMARK_MAIN();
