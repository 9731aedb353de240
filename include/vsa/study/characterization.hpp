// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An actuator measured as the paper measured its hardware (section IV): what is run, what each run shows, and the results as files.
//
//   study::CharacterizationOptions options;
//   options.specimen.type = "qbmove_maker_pro";
//   const auto done = study::run(study::plan_characterization(options), [](const study::Progress& p) { return p.wall_s < 60; });
//   if (done) std::cout << study::to_json(*done, "my program");   // none: stopped
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vsa/experiment/bench.hpp"
#include "vsa/experiment/measures.hpp"
#include "vsa/study/bench_fit.hpp"
#include "vsa/study/progress.hpp"

namespace vsa::study {

/// The benches are those of vsa/experiment/bench.hpp.
enum class Experiment {
  stiffness,   ///< slow sweep of the equilibrium under load: torque–deflection loop, stiffness
  speed,       ///< square wave of the equilibrium without load: rise time, speed, overshoot, ringing
  preset_step  ///< the preset from 0 to its largest value and back, without load and with the lever held out
};
/// "stiffness", "speed", "preset-step"
[[nodiscard]] const char* word(Experiment experiment);

/// What is to be measured. Where nothing is said the paper's own values hold, as far as the actuator bears them.
struct CharacterizationOptions {
  experiment::Specimen specimen;        ///< the actuator
  std::vector<Experiment> experiments;  ///< empty: all that the actuator has
  std::vector<double> preset;      ///< in the law's unit; a preset step takes the largest. Empty: the paper's, see bench_fit.hpp
  std::optional<double> period_s;  ///< of the stiffness sweep, 1 … 3600; none: 38
  std::optional<double> amplitude_rad;  ///< of the stiffness sweep, 0.01 … 3; none: by the rule in experiment/bench.hpp
  std::optional<int> cycles;            ///< of the stiffness sweep after the first, 1 … 1000; none: 4
  std::optional<double> load_kg;        ///< on the load bench's lever, 0.001 … 1000; none: by fit_bench()
};

/// The ends of what one quantity went through in a run.
struct Range {
  double least = 0,  ///< of its samples
      most = 0;      ///< of its samples
};

/// One load test: what was run, and what it shows.
struct StiffnessResult {
  experiment::StiffnessOptions options;           ///< that it was run with
  experiment::BenchRun run;                       ///< its samples; empty in a plan
  experiment::Branches branches;                  ///< rising and falling means on a torque grid
  experiment::Loop loop;                          ///< hysteresis
  std::vector<experiment::StiffnessPoint> curve;  ///< stiffness against deflection
  /// As the unit measures them.
  Range shaft_rad,     ///< as the unit measures it
      load_Nm,         ///< as the unit measures it
      deflection_rad;  ///< as the unit measures it
  Range preset;        ///< attained
};

/// One edge of the square wave.
struct Edge {
  double command_s = 0,            ///< when it was commanded
      from_rad = 0,                ///< equilibrium before
      to_rad = 0;                  ///< equilibrium after
  experiment::StepMeasures shaft,  ///< its response
      pulleys;                     ///< that of the equilibrium, which the pulleys make
};

/// One speed test: what was run, and what it shows.
struct SpeedResult {
  experiment::SpeedOptions options;  ///< that it was run with
  experiment::BenchRun run;          ///< its samples; empty in a plan
  std::vector<Edge> edges;           ///< in order of time
  Edge mean;                         ///< over the edges; steady errors signed by the way of travel: negative where it falls short
};

/// One preset step and back: what was run, and what it shows.
struct PresetStepResult {
  experiment::PresetStepOptions options;  ///< that it was run with
  experiment::BenchRun run;               ///< its samples; empty in a plan
  experiment::StepMeasures up,            ///< of the attained preset, on the way up
      down;                               ///< and back
  Range load_Nm;                          ///< measured
};

/// Of the pinion that a linear actuator's output turns as a rack on the benches.
inline constexpr double kBenchPinion_m = 0.05;

/// An actuator measured on the paper's benches, run by run. A plan where the results' runs are empty: their options say what is to
/// be run.
struct Characterization {
  experiment::Specimen specimen;              ///< the actuator, as it was asked for
  config::ActuatorType actuator;              ///< the same, as it was read
  BenchFit fit;                               ///< what of the benches it can bear
  std::vector<StiffnessResult> stiffness;     ///< one a preset
  std::vector<SpeedResult> speed;             ///< one a preset
  std::vector<PresetStepResult> preset_step;  ///< without load, and with the lever held out
  /// What the bench's 1 N·m is at the specimen's output: 1, or of a linear actuator 1/m, in N.
  double load_scale = 1;
  /// Of a linear actuator, whose results are in m and N (named as those of others, in rad and N·m): it turns the bench as a rack on a
  /// pinion, and options of the plan are the bench's.
  [[nodiscard]] bool linear() const { return load_scale != 1; }
  /// "rad" …; empty: the law has no stiffness preset.
  [[nodiscard]] std::string preset_unit() const { return std::string(actuator.unit.actuator.transmission->preset_unit()); }
};

/// Throws InputError with every problem: an unknown type or override, a stiffness preset that the actuator doesn't have, accept or
/// that stands there twice, a value out of range, an option of the sweep without the sweep. They name the options as
/// `vsa characterize` does (--preset-rad).
[[nodiscard]] Characterization plan_characterization(const CharacterizationOptions& options);

/// Runs everything in `plan` on `threads` threads (0: all the machine has) and measures it. None: `on_progress` stopped it. Throws
/// engine::SimulationError where a run blows up.
[[nodiscard]] std::optional<Characterization> run(Characterization plan, const OnProgress& on_progress = {}, unsigned threads = 0);

/// Measures what a run shows. `run` must be one of `options`; `preset_unit` is the law's.
[[nodiscard]] StiffnessResult measure(const experiment::StiffnessOptions& options, experiment::BenchRun run,
                                      const std::string& preset_unit);
/// Of a speed test: edges of its square wave.
[[nodiscard]] SpeedResult measure(const experiment::SpeedOptions& options, experiment::BenchRun run);
/// Of a preset step.
[[nodiscard]] PresetStepResult measure(const experiment::PresetStepOptions& options, experiment::BenchRun run);

/// results.json: every measure, units in the keys; what couldn't be measured is null. `command`: what made it.
[[nodiscard]] std::string to_json(const Characterization& c, const std::string& command);

/// The samples, one per line, units in the head: of a linear actuator's, m and N.
[[nodiscard]] std::string csv_text(const experiment::BenchRun& run, bool linear = false);
/// "stiffness_preset_0.6903rad.csv", "speed_preset_0.1125rad.csv", "preset_step_loaded.csv"; an actuator without a preset has
/// "stiffness.csv" and "speed.csv". results.json names them.
[[nodiscard]] std::string csv_name(const Characterization& c, const StiffnessResult& r);
/// Of a speed test.
[[nodiscard]] std::string csv_name(const Characterization& c, const SpeedResult& r);
/// Of a preset step.
[[nodiscard]] std::string csv_name(const PresetStepResult& r);

}  // namespace vsa::study
