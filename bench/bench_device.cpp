// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the bus and the program cost beside the physics: the same millisecond of twelve units with and without their line, the
// codec, and how many emulated units with a busy line one core keeps in real time.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

#include "vsa/bus/codec.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/device/emulation.hpp"

namespace {

using namespace vsa;

device::UnitConfig maker_pro() { return config::TypeLibrary().load("qbmove_maker_pro_6_1").unit; }

/// A millisecond of the physics alone: bridges at changing voltages, the shaft swinging.
void physics_1ms(benchmark::State& state) {
  device::Unit unit(maker_pro());
  auto s = unit.initial(0, 0.6109, 0);
  device::StepPlan plan;
  double q = 0, v = 0;
  std::int64_t n = 0;
  for (auto _ : state) {
    unit.begin_step(s, plan, n * 1'000'000, 1'000'000, {q, v, 200.0});
    const double volts = 5.0 * std::sin(4.71e-3 * static_cast<double>(n));
    plan.held[plan.held_count++] = {{volts, volts}, {}};
    const double torque = unit.end_step(s, plan);
    v += 1e-3 * (torque - 0.5 * std::sin(q) - 0.02 * v) * 200.0;
    q += 1e-3 * v;
    ++n;
  }
}
BENCHMARK(physics_1ms);

/// The same with sensors, program tick and bridge, and no line.
void unit_1ms(benchmark::State& state) {
  device::Unit unit(maker_pro());
  auto s = unit.initial(0, 0.6109, 0);
  double q = 0, v = 0;
  std::int64_t n = 0;
  for (auto _ : state) {
    if (n % 12 == 0) unit.set_inputs(s, unit.inputs_for(1.047 * std::sin(4.71e-3 * static_cast<double>(n)), 0.6109));
    const double torque = unit.step(s, n * 1'000'000, 1'000'000, {q, v, 200.0});
    v += 1e-3 * (torque - 0.5 * std::sin(q) - 0.02 * v) * 200.0;
    q += 1e-3 * v;
    ++n;
  }
}
BENCHMARK(unit_1ms);

void encode_and_decode_a_request(benchmark::State& state) {
  bus::UnitReceiver receiver;
  std::int16_t n = 0;
  std::int64_t bytes = 0;
  for (auto _ : state) {
    const bus::FrameBytes f = bus::encode_request({}, 1, bus::SetInputs{{Ticks{n++}, Ticks{7}}});
    for (const std::uint8_t b : f) {
      if (receiver.push(b, 1) != bus::ReceiverEvent::frame) continue;
      benchmark::DoNotOptimize(bus::decode_request({}, receiver.frame));
    }
    bytes += f.size;
  }
  state.SetBytesProcessed(bytes);
}
BENCHMARK(encode_and_decode_a_request);

/// Emulated units, twelve a line, each asked and told once in twelve milliseconds; the wall clock stands still, so that the line
/// goes with the simulation.
void emulated_units(benchmark::State& state) {
  const auto lines = static_cast<std::size_t>(state.range(0)) / 12;
  std::vector<std::unique_ptr<device::Emulation>> all;
  for (std::size_t i = 0; i < lines; ++i) {
    std::vector<device::EmulatedUnit> units;
    for (int id = 1; id <= 12; ++id) units.push_back({maker_pro(), id, false, 0.0});
    all.push_back(std::make_unique<device::Emulation>(std::move(units), device::LineConfig{},
                                                      [] { return bus::SerialLine::Clock::time_point{}; }));
  }
  std::vector<std::uint8_t> answer;
  std::int64_t n = 0;
  for (auto _ : state) {
    ++n;
    const auto id = static_cast<std::uint8_t>(1 + n % 12);
    for (auto& line : all) {
      if (n <= 12) line->line().exchange(bus::encode_request({}, id, bus::Activate{3}).view(), answer);
      const auto x = static_cast<std::int16_t>(5000.0 * std::sin(4.71e-3 * static_cast<double>(n)));
      line->line().exchange(bus::encode_request({}, id, bus::SetInputs{{Ticks{x}, Ticks{x}}}).view(), answer);
      line->line().exchange(bus::encode_request({}, id, bus::GetMeasurements{}).view(), answer);
      line->advance(n * 1'000'000);
      answer.clear();
    }
  }
  state.SetItemsProcessed(state.range(0) * state.iterations());
  state.counters["real_time_factor"] =
      benchmark::Counter(1e-3 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(emulated_units)->Arg(12)->Arg(1008);

}  // namespace

BENCHMARK_MAIN();
