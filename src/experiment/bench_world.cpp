// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "experiment/bench_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vsa/errors.hpp"
#include "vsa/scoped_name.hpp"
#include "vsa/units.hpp"

namespace vsa::experiment {
namespace {

engine::World load_bench(const Specimen& specimen, const char* world) {
  const auto file = config::find_data(std::filesystem::path("models/worlds") / world);
  if (!file) throw InputError({"", "bench", world, "the data directories have no such world", "set VSA_DATA_DIR"});
  engine::WorldOptions options;
  options.step_s = specimen.step_s;
  options.types = specimen.library;
  options.actuator = {specimen.type, specimen.overrides};
  return engine::World::load(*file, std::move(options));
}

/// Gravity's torque on a lever is −M g r sin q about a hanging rest: U = U₀ − M g r cos q. Any other load is no bench of ours.
double measure_load_peak(engine::World& world, const std::string& joint) {
  const auto before = world.snapshot();
  const auto energy_at = [&](double angle) {
    world.set_joint(joint, angle, 0);
    return world.energy().gravitational;
  };
  const double down = energy_at(0), up = energy_at(kPi), left = energy_at(kPi / 2), right = energy_at(-kPi / 2);
  world.restore(*before);
  const double peak = 0.5 * (up - down);
  constexpr double kTolerance_J = 1e-6;
  if (peak < -kTolerance_J || std::abs(left - right) > kTolerance_J || std::abs(left + right - up - down) > kTolerance_J) {
    throw InputError({"", "bench", joint, "at angle 0 its lever doesn't hang", "a world as this program ships it"});
  }
  return std::abs(peak) < kTolerance_J ? 0.0 : peak;
}

void scale_load(engine::World& world, const std::string& model, double share) {
  const engine::LinkHandle flange = world.link(scoped_name(model, "flange"));
  engine::LinkParameters load = world.link_parameters(flange);
  load.mass_kg *= share;
  for (double& moment : load.inertia_kgm2) moment *= share;
  world.set_link_parameters(flange, load);
}

double angle_of(Ticks ticks, int resolution) { return radians(Raw{ticks.value * (1 << resolution)}); }

/// The same with its turns: a word on the wire comes round every second one, and a servo counts on. `truth`: the encoder's angle.
double counted_angle(Ticks ticks, int resolution, double truth) {
  const double word = angle_of(ticks, resolution), round = angle_of(Ticks{-32768}, resolution) * -2;
  return word + round * std::round((truth - word) / round);
}

}  // namespace

Bench::Bench(const Specimen& specimen, const char* world, Watch* watch, double load_share)
    : world_(load_bench(specimen, world)), watch_(watch) {
  if (world_.actuators().size() != 1) {
    throw InputError({"", "bench", world, fmt::format("has {} actuators", world_.actuators().size()), "one"});
  }
  actuator_ = world_.actuators().front();
  config_ = &world_.robot(actuator_.robot).config().actuators[actuator_.index];
  if (load_share != 1) scale_load(world_, world_.robot_model(actuator_.robot), load_share);
  load_peak_Nm_ = measure_load_peak(world_, scoped_name(world_.robot_model(actuator_.robot), config_->joint));
}

void Bench::step(const elastic::EquilibriumPreset& command) {
  if (watch_ != nullptr && watch_->stop) throw Stopped();
  world_.robot(actuator_.robot).command(actuator_.index, command.equilibrium, command.preset);
  const std::int64_t before_ns = world_.time_ns();
  world_.step();
  if (watch_ != nullptr) watch_->simulated_ns += world_.time_ns() - before_ns;
}

void Bench::reset() {
  world_.reset();
  static_cast<void>(world_.robot(actuator_.robot).take_notices());
}

double Bench::lift(double angle_rad, double most_rad, double preset) {
  double command = 0;
  while (shaft_rad() < angle_rad && command < most_rad) {
    command += kLiftRate_rad_per_s * world_.step_s();
    step({command, preset});
  }
  return command;
}

double Bench::run(double duration_s, const Command& command) {
  const auto steps = std::llround(duration_s / world_.step_s());
  double largest = shaft_rad();
  for (long long k = 0; k < steps; ++k) {
    step(command(static_cast<double>(k) * world_.step_s()));
    largest = std::max(largest, shaft_rad());
  }
  return largest;
}

BenchRun Bench::record(double duration_s, double start_s, double sample_s, const Command& command) {
  const double dt = world_.step_s();
  const auto steps = std::llround(duration_s / dt), start = std::llround(start_s / dt);
  const auto stride = std::max(1LL, std::llround(sample_s / dt));
  BenchRun out;
  out.samples.reserve(static_cast<std::size_t>((steps - start) / stride + 1));
  for (long long k = 0; k <= steps; ++k) {
    const double time_s = static_cast<double>(k) * dt;
    if (k >= start && (k - start) % stride == 0) out.samples.push_back(sample(time_s));
    if (k < steps) step(command(time_s));
  }
  out.load_peak_Nm = load_peak_Nm_;
  out.step_s = dt;
  out.preset_unit = law().preset_unit();
  out.motors = law().motor_count();
  for (const host::Notice& n : world_.robot(actuator_.robot).take_notices()) out.notices.push_back(n.text);
  return out;
}

BenchSample Bench::sample(double time_s) const {
  const host::ActuatorReading r = world_.read(actuator_);
  const auto& resolution = config_->unit.memory.resolution;
  BenchSample s;
  s.time_s = time_s;
  s.equilibrium_command_rad = r.equilibrium_command_rad;
  s.preset_command = r.preset_command;
  s.equilibrium_rad = r.equilibrium_rad;
  s.preset = r.preset;
  s.shaft_rad = r.shaft_rad;
  s.shaft_speed_rad_per_s = r.shaft_speed_rad_per_s;
  s.torque_Nm = r.torque_Nm;
  s.mean_torque_Nm = r.mean_torque_Nm;
  s.stiffness_Nm_per_rad = r.stiffness_Nm_per_rad;
  if (config_->unit.servo) {
    const double scale = config_->unit.actuator.shaft_scale;
    s.measured_shaft_rad = counted_angle(r.measured[2], resolution[2], scale * r.shaft_rad) / scale;
  } else {
    s.measured_shaft_rad = angle_of(r.measured[2], resolution[2]);
  }
  std::array<double, 2> pulleys{};
  for (std::size_t i = 0; i < 2; ++i)
    pulleys[i] =
        config_->unit.servo ? counted_angle(r.measured[i], resolution[i], r.motor_rad[i]) : angle_of(r.measured[i], resolution[i]);
  s.measured_deflection_rad = s.measured_shaft_rad - law().attained(pulleys).equilibrium;
  s.measured_load_Nm = load_peak_Nm_ == 0 ? 0.0 : -load_peak_Nm_ * std::sin(s.measured_shaft_rad);
  s.motor_rad = r.motor_rad;
  s.current_A = r.current_A;
  return s;
}

}  // namespace vsa::experiment
