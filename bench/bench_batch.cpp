// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Copies of the snake in a batch: steps of each, on one thread and on two; with the World's parameters, and with their own.
// `bytes_over_state`: memory that a further copy takes, over that of its state's numbers.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <vector>

#include "vsa/batch/batch.hpp"

namespace {

using vsa::batch::Batch;
using vsa::batch::Distribution;
using vsa::batch::Spread;
using vsa::engine::World;

const std::vector<Spread> kOwn{{"", "drive.friction_Nm", {Distribution::Kind::uniform, 0.5, 1.0}},
                               {"", "elastic.k1_Nm", {Distribution::Kind::uniform, 0.9, 1.1, true}},
                               {"", "link.mass_kg", {Distribution::Kind::uniform, 0.9, 1.1, true}},
                               {"", "link.friction", {Distribution::Kind::uniform, 0.6, 0.9}}};

// The World's in effect, but each copy has its own: what having them costs, with the same motion.
const std::vector<Spread> kEqual{{"", "drive.friction_Nm", {Distribution::Kind::uniform, 1 - 1e-12, 1, true}},
                                 {"", "link.mass_kg", {Distribution::Kind::uniform, 1 - 1e-12, 1, true}},
                                 {"", "link.friction", {Distribution::Kind::uniform, 1 - 1e-12, 1, true}}};
enum class Parameters { of_the_world, equal, own };

World crawler() {
  World world = World::load(VSA_SOURCE_DIR "/models/worlds/snake_flat.sdf");
  world.run(0.5);
  return world;
}

Batch batch_of(std::size_t copies, std::size_t threads, Parameters parameters) {
  Batch batch(crawler(), copies, threads);
  if (parameters != Parameters::of_the_world) batch.randomize(1, parameters == Parameters::own ? kOwn : kEqual);
  for (double& v : batch.equilibrium()) v = 0.1;
  for (double& v : batch.preset()) v = 0.3;
  return batch;
}

void steps(benchmark::State& state, int count, Parameters parameters) {
  Batch batch = batch_of(static_cast<std::size_t>(state.range(0)), static_cast<std::size_t>(state.range(1)), parameters);
  for (auto _ : state) batch.step(count);
  state.counters["world_steps"] =
      benchmark::Counter(static_cast<double>(count * state.iterations() * state.range(0)), benchmark::Counter::kIsRate);
}

void ten_steps(benchmark::State& state) { steps(state, 10, Parameters::of_the_world); }
void ten_steps_of_own_parameters(benchmark::State& state) { steps(state, 10, Parameters::own); }
void ten_steps_of_equal_parameters(benchmark::State& state) { steps(state, 10, Parameters::equal); }
void one_step(benchmark::State& state) { steps(state, 1, Parameters::of_the_world); }
void one_step_of_equal_parameters(benchmark::State& state) { steps(state, 1, Parameters::equal); }
BENCHMARK(ten_steps)->ArgNames({"copies", "threads"})->ArgsProduct({{64, 256}, {1, 2}})->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(ten_steps_of_own_parameters)
    ->ArgNames({"copies", "threads"})
    ->ArgsProduct({{64, 256}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(one_step)->ArgNames({"copies", "threads"})->Args({64, 1})->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(ten_steps_of_equal_parameters)->ArgNames({"copies", "threads"})->Args({64, 1})->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(one_step_of_equal_parameters)->ArgNames({"copies", "threads"})->Args({64, 1})->MeasureProcessCPUTime()->UseRealTime();

double bytes_in_use() {
  const struct mallinfo2 now = mallinfo2();
  return static_cast<double>(now.uordblks + now.hblkhd);
}

/// Not a time, but for randomize().
void memory(benchmark::State& state, Parameters parameters) {
  constexpr std::size_t kFew = 16, kMany = 144;
  double few = 0, many = 0, numbers = 0;
  for (auto _ : state) {
    const double before = bytes_in_use();
    {
      const Batch batch = batch_of(kFew, 2, parameters);
      few = bytes_in_use() - before;
    }
    const Batch batch = batch_of(kMany, 2, parameters);
    many = bytes_in_use() - before;
    numbers = static_cast<double>(batch.state(0).size_bytes());
  }
  state.counters["bytes_over_state"] = (many - few) / (kMany - kFew) / numbers;
}
void memory_of_a_copy(benchmark::State& state) { memory(state, Parameters::of_the_world); }
void memory_of_a_copy_of_own_parameters(benchmark::State& state) { memory(state, Parameters::own); }
BENCHMARK(memory_of_a_copy)->Iterations(1);
BENCHMARK(memory_of_a_copy_of_own_parameters)->Iterations(1);

void randomize(benchmark::State& state) {
  Batch batch = batch_of(64, 1, Parameters::of_the_world);
  std::uint64_t seed = 0;
  for (auto _ : state) batch.randomize(++seed, kOwn);
  state.counters["copies"] = benchmark::Counter(64.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(randomize)->MeasureProcessCPUTime()->UseRealTime();

void reset(benchmark::State& state, Parameters parameters) {
  Batch batch = batch_of(64, 1, parameters);
  for (auto _ : state) batch.reset();
}
void reset_all(benchmark::State& state) { reset(state, Parameters::of_the_world); }
void reset_all_of_own_parameters(benchmark::State& state) { reset(state, Parameters::own); }
BENCHMARK(reset_all)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(reset_all_of_own_parameters)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
