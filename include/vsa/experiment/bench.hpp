// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The paper's three experiments (section IV) on the simulated benches: the same worlds and engine that users have.
//
//   stiffness    bench_load: the equilibrium sweeps θ_eq = A sin(2πt/T), a mass on a lever loads the shaft with −M g r sin q
//   speed        bench_free: a square wave of the equilibrium, vertical axis, no load
//   preset step  a step of the preset and back, unloaded (bench_free) and with the lever held out (bench_load)
//
// M g r is half the difference of the bench's gravitational energy between lever up and lever down, read from its links. Commands
// go to host::Robot and from there over its bus, one a step. What the unit measures are the ticks that its bus master last read.
// Each run loads its own world, is deterministic, and may run beside others in threads of its own.
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/experiment/recording.hpp"

namespace vsa::experiment {

/// Which actuator stands on the bench.
struct Specimen {
  std::string type;                         ///< its name, as in `vsa actuators`
  std::vector<config::Override> overrides;  ///< replace single values of it
  config::TypeLibrary library{};            ///< where the type is
  std::optional<double> step_s;             ///< none: the bench's own
};

/// Looks into runs, and ends them, from another thread. One may watch several.
struct Watch {
  std::atomic<std::int64_t> simulated_ns{0};  ///< by all that it watches
  std::atomic<bool> stop{false};              ///< true: they end by throwing Stopped
};

/// What a run throws that Watch::stop ended.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("the experiment was stopped") {}
};

/// One sample: what was asked, what is (simulated truth), what the unit itself reads.
struct BenchSample {
  double time_s = 0;                   ///< simulated, since the run's start
  double equilibrium_command_rad = 0,  ///< as it was given
      preset_command = 0;              ///< as it was given, in the law's unit
  double equilibrium_rad = 0,          ///< attained, from the pulleys
      preset = 0;                      ///< attained, from the pulleys, in the law's unit
  double shaft_rad = 0,                ///< q
      shaft_speed_rad_per_s = 0;       ///< q̇
  double torque_Nm = 0;                ///< of the actuator on the shaft
  double mean_torque_Nm = 0;           ///< the same over the step that led here
  double stiffness_Nm_per_rad = 0;     ///< σ at the present deflection
  double measured_shaft_rad = 0;       ///< by the unit's encoders
  double measured_deflection_rad = 0;  ///< shaft − equilibrium by the unit's encoders; qbmove: shaft − mean of the pulleys
  double measured_load_Nm = 0;         ///< external torque about +q: −M g r sin(measured shaft); 0 on bench_free
  std::array<double, 2> motor_rad{},   ///< of each pulley
      current_A{};                     ///< of each winding
};

/// What one experiment recorded, and what it was done with.
struct BenchRun {
  std::vector<BenchSample> samples;  ///< in order of time
  double load_peak_Nm = 0;           ///< M g r of the bench; 0 on bench_free
  double step_s = 0;                 ///< of the engine
  double amplitude_rad = 0;          ///< stiffness: A; speed: the step; preset step: the equilibrium that was held
  std::string preset_unit;           ///< of the law; empty: it has no preset
  int motors = 2;                    ///< 1 or 2, of the law
  std::vector<std::string> notices;  ///< commands that the unit clamped, angles that it did not reach
};

/// Throws InputError where the type or an override is unknown, or `preset` is beyond the unit's limits or it has none.
void check_preset(const Specimen& specimen, double preset);

/// Deflection of the law alone under an external torque: −τ(θ_eq + δ) = load with the pulleys on the references of (0, preset). As
/// BenchSample measures it, from the commanded equilibrium: unequal springs are deflected without load, too (elastic/inverse.hpp).
/// Throws InputError where the law can't carry it within a turn.
[[nodiscard]] double law_deflection(const elastic::Transmission& law, double preset, double load_Nm);

/// The load test: how the sweep goes.
struct StiffnessOptions {
  double preset = 0;                    ///< commanded, in the law's unit
  double period_s = 38.0;               ///< the recordings' period isn't published: a nuisance parameter, common to all presets
  std::optional<double> amplitude_rad;  ///< none: by sweep_amplitude()
  double lead_in_cycles = 1;            ///< simulated and left out of the samples
  double cycles = 4;                    ///< in the samples
  double sample_s = 0.01;               ///< between two samples
  double load_share = 1;                ///< of the bench's mass: for those that can't carry a qbmove's load, or hardly notice it
};
/// M g r of the load bench with this specimen on it, N·m.
[[nodiscard]] double bench_load_peak_Nm(const Specimen& specimen);

/// The amplitude for any preset by one rule, as an experimenter would find it: with it, the first quarter of the sweep at this
/// period brings the shaft to the angle that data/README.md tells for the recordings (94° at preset 0, 90° at 0.46, 81° at 0.6903
/// rad; the parabola through them, its value at 0.6903 beyond), within 0.25°. A law without a preset counts as preset 0. Where the
/// unit can't lift the lever so far, the amplitude is 1 rad more than the law alone asks for, and `reached_rad` tells.
struct SweepAmplitude {
  double amplitude_rad = 0,  ///< of the sweep
      target_rad = 0,        ///< of the shaft: what the rule asks for
      reached_rad = 0;       ///< of the shaft: what came of it
};
/// That angle of the shaft, rad; `preset_unit` is the law's, "" where it has no preset.
[[nodiscard]] double sweep_target_rad(double preset, std::string_view preset_unit);
/// Finds that amplitude by runs of the first quarter, so it takes some time. Throws InputError: out of range, and as
/// check_preset().
[[nodiscard]] SweepAmplitude sweep_amplitude(const Specimen& specimen, double preset, double period_s, double load_share = 1);
/// Throws InputError: options out of range (a period of 0.1 … 1e5 s, an amplitude of 1e-3 … 10 rad …), and as check_preset().
[[nodiscard]] BenchRun run_stiffness(const Specimen& specimen, const StiffnessOptions& options, Watch* watch = nullptr);
/// As the hardware recorded it: torque from the measured shaft angle, measured deflection.
[[nodiscard]] LoadRecording as_recording(const BenchRun& run, double preset);

/// The speed test: steps of the equilibrium without load.
struct SpeedOptions {
  double preset = 0;        ///< commanded, in the law's unit
  double step_rad = 1.57;   ///< of the equilibrium
  double hold_s = 2.0;      ///< half a period of the square wave
  int steps = 4;            ///< up, down, up, down; the first is commanded at time 0
  double sample_s = 0.001;  ///< between two samples
};
/// Throws InputError: options out of range (a hold of 0.05 … 1e4 s, 1 … 1000 steps …), and as check_preset().
[[nodiscard]] BenchRun run_speed(const Specimen& specimen, const SpeedOptions& options, Watch* watch = nullptr);

/// The preset step, unloaded or with the lever held out.
struct PresetStepOptions {
  double preset = 0.75;     ///< from → preset at time 0, → from after hold_s
  double from = 0;          ///< above 0 where the softest joint doesn't carry the lever
  bool loaded = false;      ///< the lever held out so that the shaft carries about M g r all the time, see run_preset_step()
  double hold_s = 2.0;      ///< until it goes back
  double sample_s = 0.001;  ///< between two samples
  double load_share = 1;    ///< as StiffnessOptions has it
};
/// Loaded: while the preset steps the equilibrium stays, so that the lever rises by about δ(from) − δ(preset), the law's deflections
/// under M g r. At preset `from` it is lifted to 90° less half of that and so ends as far beyond: the load stays within a few percent of
/// M g r. Where the unit can't lift it so far, a notice tells.
[[nodiscard]] BenchRun run_preset_step(const Specimen& specimen, const PresetStepOptions& options, Watch* watch = nullptr);

/// How much each simulates, about: what Watch::simulated_ns counts up to. How long finding an amplitude or a lift takes shows only
/// then.
[[nodiscard]] double simulated_s(const StiffnessOptions& options);
/// Of the speed test.
[[nodiscard]] double simulated_s(const SpeedOptions& options);
/// Of the preset step.
[[nodiscard]] double simulated_s(const PresetStepOptions& options);

}  // namespace vsa::experiment
