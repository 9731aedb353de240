// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The simulator beside every recording in data/: the load test at each recorded preset, and the steps of the equilibrium and of the
// preset beside the 2015 program's; figures out of them, and verdicts on the figures that have a stated bound.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vsa/experiment/bounds.hpp"
#include "vsa/study/characterization.hpp"
#include "vsa/study/leave_one_out.hpp"

namespace vsa::study {

struct ValidationOptions {
  experiment::Specimen specimen{"qbmove_maker_pro", {}, config::TypeLibrary(), {}};
  std::vector<std::filesystem::path> recordings;  ///< directories beside data/
  std::filesystem::path leave_one_out;            ///< results.json of `vsa identify`; empty: data/TYPE/leave_one_out.json if there
  std::filesystem::path bounds;                   ///< TOML file; empty: data/bounds.toml
};

/// A load test's branch means.
struct Recording {
  std::string file;  ///< relative to the data directory, or as the user's directory leads to it
  double preset = 0;
  experiment::Branches data;
  std::string origin;  ///< where it comes from, by origin.txt beside it: "digitised from …"; empty: nobody says
};

/// What is compared with what, and what is to be run for it.
struct ValidationPlan {
  Characterization runs;
  std::vector<Recording> recordings;
  experiment::BoundsFile bounds;
  std::optional<LeaveOneOut> left_out;
  std::filesystem::path plugin_2015;  ///< directory with the 2015 program's curves
  double step_command_s = 0;          ///< when its equilibrium steps in figure 4, on its clock
};

/// One recording of the load test, and the simulation of it.
struct RecordingCheck {
  std::string file;    ///< relative to the data directory, or as the user named it
  std::string origin;  ///< where it comes from; empty: nobody says
  double preset = 0;
  experiment::Kind kind = experiment::Kind::calibrated;
  experiment::Branches data, ours;
  experiment::Loop data_loop, our_loop;
  experiment::Difference rms;
  experiment::TorqueDifference torque;
  std::optional<experiment::Published> published;
};

/// The same at another period of the sweep.
struct PeriodCheck {
  double preset = 0, period_s = 0;
  experiment::Difference rms;
  experiment::Loop loop;
};

/// A step of the equilibrium, and the 2015 program's.
struct SpeedCheck {
  double preset = 0;
  int percent = 0;
  experiment::StepMeasures shaft, pulleys, shaft_2015;
  experiment::TimeSeries ours, theirs;  ///< of the shaft, time from the command
};

/// A step of the preset and back, and the 2015 program's.
struct PresetStepCheck {
  bool loaded = false;
  experiment::StepMeasures up, down, up_2015, down_2015;
  experiment::TimeSeries ours, theirs;  ///< of the attained preset, time from the command
};

struct Validation {
  config::ActuatorType actuator;
  std::vector<config::Override> overrides;
  std::optional<config::Evidence> evidence;  ///< the type's; none where it has none, or where overrides changed what it speaks of
  std::optional<LeaveOneOut> left_out;       ///< the record of it, if there is one
  std::vector<RecordingCheck> recordings;    ///< the predicted ones first
  std::vector<PeriodCheck> periods;
  std::vector<SpeedCheck> speeds;
  std::vector<PresetStepCheck> preset_steps;
  std::vector<experiment::Verdict> verdicts;
  double wall_s = 0;
};

/// Everything that a bound may name: "stiffness.0.6903.rms_rad" and so on.
[[nodiscard]] std::map<std::string, double> quantities(const Validation& v);

/// "predicted", "calibrated", "not told".
[[nodiscard]] std::string recording_kind(const Validation& v, const RecordingCheck& r);

/// Reads data/, the directories with more recordings, bounds and record. Throws InputError with every problem of the first that has
/// one; they name the options as `vsa validate` does (--recordings).
[[nodiscard]] ValidationPlan plan_validation(const ValidationOptions& options);

/// Runs all experiments on `threads` threads (0: all the machine has), compares and judges. None: `on_progress` stopped it. Throws
/// InputError for a bound on a quantity that isn't there, engine::SimulationError where a run blows up.
[[nodiscard]] std::optional<Validation> run(ValidationPlan plan, const OnProgress& on_progress = {}, unsigned threads = 0);

/// results.json: every figure, bound and verdict; what couldn't be measured is null. `command`: what made it.
[[nodiscard]] std::string to_json(const Validation& v, const std::string& command);

}  // namespace vsa::study
