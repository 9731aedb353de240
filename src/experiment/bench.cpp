// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiment/bench_world.hpp"
#include "vsa/elastic/inverse.hpp"
#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::experiment {
namespace {

constexpr double kSettle_s = 2.0;      // before each experiment, at its first command: far longer than any step of a preset takes
constexpr double kMostMore_rad = 1.0;  // motors lag behind the law by their controller's error, weak ones without end
constexpr double kLift_s = 2.2 / kLiftRate_rad_per_s;  // about what a lift takes, for simulated_s()
constexpr double kLongest_s = 1e7;

void require(Problems& problems, const char* key, double value, double least, double most, const char* unit) {
  if (value >= least && value <= most) return;
  problems.add({"", key, fmt::format("{}", value), "out of range", fmt::format("{} … {} {}", least, most, unit)});
}

/// Samples no closer than the smallest engine step, and no longer than a run.
void require_sampling(Problems& problems, double sample_s, double span_s) {
  require(problems, "sample_s", sample_s, 1e-6, std::max(1e-6, 0.1 * span_s), "s");
}

void check(const Specimen& specimen, const StiffnessOptions& o) {
  Problems problems;
  require(problems, "period_s", o.period_s, 0.1, 1e5, "s");
  if (o.amplitude_rad) require(problems, "amplitude_rad", *o.amplitude_rad, 1e-3, 10.0, "rad");
  require(problems, "lead_in_cycles", o.lead_in_cycles, 0, 1e4, "cycles");
  require(problems, "cycles", o.cycles, 0.5, 1e4, "cycles");
  require(problems, "load_share", o.load_share, 1e-4, 1e4, "1");
  require_sampling(problems, o.sample_s, o.period_s);
  if (problems.empty()) require(problems, "period_s × cycles", simulated_s(o), 0, kLongest_s, "s");
  problems.throw_if_any();
  check_preset(specimen, o.preset);
}

void check(const Specimen& specimen, const SpeedOptions& o) {
  Problems problems;
  require(problems, "step_rad", std::abs(o.step_rad), 1e-3, 10.0, "rad");
  require(problems, "hold_s", o.hold_s, 0.05, 1e4, "s");
  require(problems, "steps", o.steps, 1, 1e3, "steps");
  require_sampling(problems, o.sample_s, o.hold_s);
  problems.throw_if_any();
  check_preset(specimen, o.preset);
}

void check(const Specimen& specimen, const PresetStepOptions& o) {
  Problems problems;
  require(problems, "hold_s", o.hold_s, 0.05, 1e4, "s");
  require(problems, "load_share", o.load_share, 1e-4, 1e4, "1");
  require_sampling(problems, o.sample_s, o.hold_s);
  problems.throw_if_any();
  if (specimen.library.load(specimen.type, specimen.overrides).unit.actuator.transmission->preset_unit().empty()) {
    throw InputError({"", "preset step", specimen.type, "this actuator has no stiffness preset, so there is none to step",
                      "the other experiments"});
  }
  if (o.preset == o.from) {
    const std::string same = fmt::format("{}", o.preset);
    throw InputError({"", "preset", same, fmt::format("a step from {} to {} is none", same, same), "above " + same});
  }
  check_preset(specimen, o.preset);
  check_preset(specimen, o.from);
}

void settle(Bench& bench, const elastic::EquilibriumPreset& command) {
  bench.run(kSettle_s, [&](double) { return command; });
}

Command sweep(double amplitude, double period_s, double preset) {
  return [=](double t) { return elastic::EquilibriumPreset{amplitude * std::sin(2 * kPi * t / period_s), preset}; };
}

/// The reached angle grows with the amplitude, nearly one to one: a fixed-point iteration.
SweepAmplitude amplitude_on(Bench& bench, double preset, double period_s) {
  constexpr double kPeak_cycles = 0.3;  // the shaft's peak comes a little after the command's
  constexpr double kClose_rad = 0.25 * kPi / 180;
  constexpr int kTrials = 8;
  SweepAmplitude out;
  out.target_rad = sweep_target_rad(preset, bench.law().preset_unit());
  const double by_law = out.target_rad + law_deflection(bench.law(), preset, bench.load_peak_Nm() * std::sin(out.target_rad));
  out.amplitude_rad = by_law;
  for (int trial = 1;; ++trial) {
    bench.reset();
    settle(bench, {0, preset});
    out.reached_rad = bench.run(kPeak_cycles * period_s, sweep(out.amplitude_rad, period_s, preset));
    const double missing = out.target_rad - out.reached_rad;
    const double next = std::clamp(out.amplitude_rad + missing, 0.1 * by_law, by_law + kMostMore_rad);
    if (std::abs(missing) <= kClose_rad || trial == kTrials || next == out.amplitude_rad) return out;
    out.amplitude_rad = next;
  }
}

void note_reach(BenchRun& run, double target_rad, double reached_rad) {
  constexpr double kNear_rad = 1.0 * kPi / 180;
  if (std::abs(target_rad - reached_rad) <= kNear_rad) return;
  run.notices.push_back(fmt::format("the lever came to {:.0f}° where {:.0f}° was wanted, so the load is another",
                                    reached_rad * 180 / kPi, target_rad * 180 / kPi));
}

/// See run_preset_step().
struct Lifted {
  double held_rad, target_rad, reached_rad;
};
Lifted lift_lever(Bench& bench, double from, double preset) {
  const double load = bench.load_peak_Nm(), sag = law_deflection(bench.law(), from, load);
  const double target = kPi / 2 - 0.5 * (sag - law_deflection(bench.law(), preset, load));
  settle(bench, {0, from});
  const double held = bench.lift(target, target + sag + kMostMore_rad, from);
  return {held, target, bench.shaft_rad()};
}

}  // namespace

void check_preset(const Specimen& specimen, double preset) {
  const device::UnitConfig unit = specimen.library.load(specimen.type, specimen.overrides).unit;
  const std::string preset_unit(unit.actuator.transmission->preset_unit());
  if (preset_unit.empty() && preset != 0) {
    throw InputError({"", "preset", fmt::format("{}", preset), specimen.type + " has no stiffness preset", "none, or 0"});
  }
  if (!(preset >= 0 && preset <= unit.preset_max)) {
    throw InputError({"", "preset", fmt::format("{}", preset), "beyond what " + specimen.type + " accepts",
                      fmt::format("0 … {} {}", unit.preset_max, preset_unit)});
  }
}

double law_deflection(const elastic::Transmission& law, double preset, double load_Nm) {
  const auto x = law.references({0.0, preset});
  const auto rest = elastic::rest_under(law, x, load_Nm);
  if (!rest) {
    throw InputError(
        {"", "load_Nm", fmt::format("{}", load_Nm), "the elastic law doesn't carry it within a turn", "a smaller load"});
  }
  return *rest - law.attained(x).equilibrium;
}

/// The parabola through the three angles that the recordings' shaft reached, in Lagrange's form.
double sweep_target_rad(double preset, std::string_view preset_unit) {
  constexpr double kPreset[] = {0.0, 0.46, 0.6903}, kAngle_deg[] = {94, 90, 81};
  const double p = preset_unit == "rad" ? std::min(std::abs(preset), kPreset[2]) : 0.0;
  double deg = 0;
  for (int i = 0; i < 3; ++i) {
    const double a = kPreset[(i + 1) % 3], b = kPreset[(i + 2) % 3];
    deg += kAngle_deg[i] * (p - a) * (p - b) / ((kPreset[i] - a) * (kPreset[i] - b));
  }
  return deg * kPi / 180;
}

double bench_load_peak_Nm(const Specimen& specimen) { return Bench(specimen, kLoadBench, nullptr).load_peak_Nm(); }

SweepAmplitude sweep_amplitude(const Specimen& specimen, double preset, double period_s, double load_share) {
  StiffnessOptions options;
  options.preset = preset;
  options.period_s = period_s;
  options.load_share = load_share;
  check(specimen, options);
  Bench bench(specimen, kLoadBench, nullptr, load_share);
  return amplitude_on(bench, preset, period_s);
}

BenchRun run_stiffness(const Specimen& specimen, const StiffnessOptions& options, Watch* watch) {
  check(specimen, options);
  Bench bench(specimen, kLoadBench, watch, options.load_share);
  SweepAmplitude found;
  if (!options.amplitude_rad) found = amplitude_on(bench, options.preset, options.period_s);
  const double amplitude = options.amplitude_rad.value_or(found.amplitude_rad);
  bench.reset();
  settle(bench, {0, options.preset});
  const double lead_in_s = options.lead_in_cycles * options.period_s;
  BenchRun out = bench.record(lead_in_s + options.cycles * options.period_s, lead_in_s, options.sample_s,
                              sweep(amplitude, options.period_s, options.preset));
  out.amplitude_rad = amplitude;
  note_reach(out, found.target_rad, found.reached_rad);
  return out;
}

LoadRecording as_recording(const BenchRun& run, double preset) {
  LoadRecording out;
  out.preset = preset;
  out.source = "simulation";
  for (const BenchSample& s : run.samples) {
    out.time_s.push_back(s.time_s);
    out.torque_Nm.push_back(s.measured_load_Nm);
    out.deflection_rad.push_back(s.measured_deflection_rad);
  }
  return out;
}

BenchRun run_speed(const Specimen& specimen, const SpeedOptions& options, Watch* watch) {
  check(specimen, options);
  Bench bench(specimen, kFreeBench, watch);
  settle(bench, {0, options.preset});
  BenchRun out = bench.record(options.steps * options.hold_s, 0, options.sample_s, [&](double t) {
    constexpr double kRound = 1e-9;  // a step's time is a product: keep it on its side of the edge
    const bool up = static_cast<long long>(t / options.hold_s + kRound) % 2 == 0;
    return elastic::EquilibriumPreset{up ? options.step_rad : 0.0, options.preset};
  });
  out.amplitude_rad = options.step_rad;
  return out;
}

BenchRun run_preset_step(const Specimen& specimen, const PresetStepOptions& options, Watch* watch) {
  check(specimen, options);
  Bench bench(specimen, options.loaded ? kLoadBench : kFreeBench, watch, options.loaded ? options.load_share : 1.0);
  Lifted lifted{};
  if (options.loaded) lifted = lift_lever(bench, options.from, options.preset);
  settle(bench, {lifted.held_rad, options.from});
  BenchRun out = bench.record(2 * options.hold_s, 0, options.sample_s, [&](double t) {
    constexpr double kRound = 1e-9;
    return elastic::EquilibriumPreset{lifted.held_rad, t / options.hold_s + kRound < 1 ? options.preset : options.from};
  });
  out.amplitude_rad = lifted.held_rad;
  note_reach(out, lifted.target_rad, lifted.reached_rad);
  return out;
}

double simulated_s(const StiffnessOptions& o) {
  const double trials_s = o.amplitude_rad ? 0.0 : 3 * (kSettle_s + 0.3 * o.period_s);
  return trials_s + kSettle_s + (o.lead_in_cycles + o.cycles) * o.period_s;
}
double simulated_s(const SpeedOptions& o) { return kSettle_s + o.steps * o.hold_s; }
double simulated_s(const PresetStepOptions& o) { return (o.loaded ? kSettle_s + kLift_s : 0.0) + kSettle_s + 2 * o.hold_s; }

}  // namespace vsa::experiment
