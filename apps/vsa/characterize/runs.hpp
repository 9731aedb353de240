// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa characterize` runs, and what it measures on each run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terminal/console.hpp"
#include "vsa/experiment/bench.hpp"
#include "vsa/experiment/measures.hpp"

namespace vsa::app {

struct Range {
  double least = 0, most = 0;
};

struct StiffnessResult {
  experiment::StiffnessOptions options;
  experiment::BenchRun run;
  experiment::Branches branches;
  experiment::Loop loop;
  std::vector<experiment::StiffnessPoint> curve;
  Range shaft_rad, load_Nm, deflection_rad;  ///< as the unit measures them
  Range preset;                              ///< attained
};

/// One edge of the square wave.
struct Edge {
  double command_s = 0, from_rad = 0, to_rad = 0;
  experiment::StepMeasures shaft, pulleys;  ///< of the shaft; of the equilibrium, which the pulleys make
};

struct SpeedResult {
  experiment::SpeedOptions options;
  experiment::BenchRun run;
  std::vector<Edge> edges;
  Edge mean;  ///< over the edges; steady errors signed by the way of travel: negative where it falls short
};

struct PresetStepResult {
  experiment::PresetStepOptions options;
  experiment::BenchRun run;
  experiment::StepMeasures up, down;  ///< of the attained preset
  Range load_Nm;                      ///< measured
};

struct Characterization {
  experiment::Specimen specimen;
  config::Preset actuator;
  std::vector<StiffnessResult> stiffness;
  std::vector<SpeedResult> speed;
  std::vector<PresetStepResult> preset_step;
  [[nodiscard]] std::string preset_unit() const { return std::string(actuator.unit.actuator.transmission->preset_unit()); }
};

/// Measures what a run shows. `run` must be one of `options`.
[[nodiscard]] StiffnessResult measure(const experiment::StiffnessOptions& options, experiment::BenchRun run,
                                      const std::string& preset_unit);
[[nodiscard]] SpeedResult measure(const experiment::SpeedOptions& options, experiment::BenchRun run);
[[nodiscard]] PresetStepResult measure(const experiment::PresetStepOptions& options, experiment::BenchRun run);

/// Runs everything whose options stand in `plan` (its results' runs are empty yet), on `threads` threads (0: all the machine has),
/// and measures it. None: a signal stopped it, see interrupted().
[[nodiscard]] std::optional<Characterization> run_plan(Characterization plan, Console& console, unsigned threads = 0);

}  // namespace vsa::app
