// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What one actuator costs. Ratios in one run, against a bare sinh + cosh pair.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/device/unit_batch.hpp"
#include "vsa/host/robot.hpp"

namespace {

vsa::device::UnitConfig maker_pro() { return vsa::config::TypeLibrary().load("qbmove_maker_pro_6_1").unit; }

void sinh_cosh_pair(benchmark::State& state) {
  double u = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(u);
    benchmark::DoNotOptimize(std::sinh(u) + std::cosh(u));
  }
}
BENCHMARK(sinh_cosh_pair);

/// The same with a second side of other numbers, as fast as the first: no more friction, no slower motor.
vsa::device::UnitConfig unlike() {
  vsa::device::UnitConfig c = maker_pro();
  vsa::actuator::SideParams& second = c.actuator.side[1];
  second.motor.inertia_kgm2 *= 1.1;
  second.motor.resistance_Ohm *= 0.95;
  second.gearbox.friction.coulomb_Nm *= 0.9;
  second.encoder.bits = 14;
  return c;
}

/// The gravity of a hanging lever, N·m: 0.5 sin q to q⁵, within 1.4e-4 up to 60°. A library's sine would be a tenth of what is timed.
double lever(double q) {
  const double q2 = q * q;
  return 0.5 * q * (1.0 - q2 / 6.0 * (1.0 - q2 / 20.0));
}

/// A unit on a hanging lever whose equilibrium moves as in the snake's gait: 60° at 4.71 rad/s, Table II's preset.
void step_of(benchmark::State& state, const vsa::device::UnitConfig& config) {
  vsa::device::Unit unit(config);
  auto s = unit.initial(0, 0.6109, 0);
  double q = 0, v = 0, t = 0;
  std::int64_t n = 0;
  for (auto _ : state) {
    if (n % 12 == 0) unit.set_inputs(s, unit.inputs_for(1.047 * std::sin(4.71 * t), 0.6109));
    const double torque = unit.step(s, n * 1'000'000, 1'000'000, {q, v, 200.0});
    v += 1e-3 * (torque - lever(q) - 0.02 * v) * 200.0;
    q += 1e-3 * v;
    t += 1e-3;
    ++n;
  }
  benchmark::DoNotOptimize(q);
}
void actuator_step_1ms(benchmark::State& state) { step_of(state, maker_pro()); }
BENCHMARK(actuator_step_1ms);
void unlike_sides_step_1ms(benchmark::State& state) { step_of(state, unlike()); }
BENCHMARK(unlike_sides_step_1ms);

/// N units as above, each with its own place in the gait, side by side in lanes; the time is that of all.
void lanes_of(benchmark::State& state, std::string_view instructions, const vsa::device::UnitConfig& config) {
  const auto count = static_cast<std::size_t>(state.range(0));
  vsa::device::UnitBatch units(config, count, instructions);
  std::vector<double> q(count, 0.0), v(count, 0.0), inverse_inertia(count, 200.0), torque(count);
  double t = 0;
  std::int64_t n = 0;
  for (auto _ : state) {
    if (n % 12 == 0)
      for (std::size_t i = 0; i < count; ++i) units.command(i, 1.047 * std::sin(4.71 * t + 0.6 * static_cast<double>(i)), 0.6109);
    units.step(1'000'000, q, v, inverse_inertia, torque);
    for (std::size_t i = 0; i < count; ++i) {
      v[i] += 1e-3 * (torque[i] - lever(q[i]) - 0.02 * v[i]) * 200.0;
      q[i] += 1e-3 * v[i];
    }
    t += 1e-3;
    ++n;
  }
  benchmark::DoNotOptimize(q.data());
  state.SetLabel(std::string(units.instructions()));
}
void units_in_lanes(benchmark::State& state) { lanes_of(state, {}, maker_pro()); }
BENCHMARK(units_in_lanes)->Arg(64)->Arg(4096);
void unlike_sides_in_lanes(benchmark::State& state) { lanes_of(state, {}, unlike()); }
BENCHMARK(unlike_sides_in_lanes)->Arg(64)->Arg(4096);

/// A whole robot of N units with its bus; items are actuator steps.
void robot_step(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  vsa::host::RobotConfig config;
  config.buses.resize((count + 11) / 12);
  const auto unit = maker_pro();
  for (std::size_t i = 0; i < count; ++i) {
    vsa::host::ActuatorConfig a;
    a.name = "a" + std::to_string(i);
    a.joint = a.name;
    a.unit = unit;
    a.bus = i / 12;
    a.id = static_cast<int>(i % 12) + 1;
    a.initial_preset = 0.6109;
    config.actuators.push_back(a);
  }
  vsa::host::Robot robot(config);
  std::vector<vsa::host::JointIn> in(count, {0, 0, 200.0});
  std::vector<double> out(count);
  std::int64_t n = 0;
  for (auto _ : state) {
    if (n % 12 == 0)
      for (std::size_t i = 0; i < count; ++i)
        robot.command(i, 1.047 * std::sin(4.71e-3 * static_cast<double>(n) + 0.6 * static_cast<double>(i)), std::nullopt);
    robot.advance(n * 1'000'000, 1'000'000, in, out);
    for (std::size_t i = 0; i < count; ++i) {
      in[i].speed_rad_per_s += 1e-3 * 200.0 * (out[i] - lever(in[i].angle_rad) - 0.02 * in[i].speed_rad_per_s);
      in[i].angle_rad += 1e-3 * in[i].speed_rad_per_s;
    }
    ++n;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
  state.counters["real_time_factor"] =
      benchmark::Counter(1e-3 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(robot_step)->Arg(1)->Arg(12)->Arg(1000);

}  // namespace

int main(int argc, char** argv) {
  for (const std::string_view set : vsa::device::UnitBatch::instruction_sets())
    benchmark::RegisterBenchmark(("units_in_lanes_" + std::string(set)).c_str(), [set](benchmark::State& state) {
      lanes_of(state, set, maker_pro());
    })->Arg(64);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
