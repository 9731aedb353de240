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

/// What is validated, beside which recordings.
struct ValidationOptions {
  experiment::Specimen specimen{"qbmove_maker_pro", {}, config::TypeLibrary(), {}};  ///< the actuator
  std::vector<std::filesystem::path> recordings;                                     ///< directories beside data/
  std::filesystem::path leave_one_out;  ///< results.json of `vsa identify`; empty: data/TYPE/leave_one_out.json if there
  std::filesystem::path bounds;         ///< TOML file; empty: data/bounds.toml
};

/// A load test's branch means.
struct Recording {
  std::string file;           ///< relative to the data directory, or as the user's directory leads to it
  double preset = 0;          ///< of the file's name
  experiment::Branches data;  ///< as the file has them
  std::string origin;         ///< where it comes from, by origin.txt beside it: "digitised from …"; empty: nobody says
};

/// What is compared with what, and what is to be run for it.
struct ValidationPlan {
  Characterization runs;                ///< what is to be simulated for it
  std::vector<Recording> recordings;    ///< of data/ and of the user's directories
  experiment::BoundsFile bounds;        ///< held to
  std::optional<LeaveOneOut> left_out;  ///< the record of the type; none: there is none
  std::filesystem::path plugin_2015;    ///< directory with the 2015 program's curves
  double step_command_s = 0;            ///< when its equilibrium steps in figure 4, on its clock
};

/// One recording of the load test, and the simulation of it.
struct RecordingCheck {
  std::string file;                                      ///< relative to the data directory, or as the user named it
  std::string origin;                                    ///< where it comes from; empty: nobody says
  double preset = 0;                                     ///< of the recording
  experiment::Kind kind = experiment::Kind::calibrated;  ///< whether the type was fitted to it
  experiment::Branches data,                             ///< recorded
      ours;                                              ///< simulated
  experiment::Loop data_loop,                            ///< recorded
      our_loop;                                          ///< simulated
  experiment::Difference rms;                            ///< in deflection
  experiment::TorqueDifference torque;                   ///< in torque
  std::optional<experiment::Published> published;        ///< what others reach on it
};

/// A recording beside the simulation at another period of the sweep.
struct PeriodCheck {
  double preset = 0,           ///< of the recording
      period_s = 0;            ///< of the sweep
  experiment::Difference rms;  ///< in deflection
  experiment::Loop loop;       ///< of the simulation
};

/// A step of the equilibrium, and the 2015 program's.
struct SpeedCheck {
  double preset = 0;               ///< commanded
  int percent = 0;                 ///< of the full preset, as the 2015 program's curves are named
  experiment::StepMeasures shaft,  ///< simulated
      pulleys,                     ///< the equilibrium's, simulated
      shaft_2015;                  ///< the 2015 program's
  experiment::TimeSeries ours,     ///< of the shaft, time from the command
      theirs;                      ///< the 2015 program's
};

/// A step of the preset and back, and the 2015 program's.
struct PresetStepCheck {
  bool loaded = false;          ///< with the lever held out
  experiment::StepMeasures up,  ///< simulated
      down,                     ///< and back, simulated
      up_2015,                  ///< the 2015 program's
      down_2015;                ///< and back, the 2015 program's
  experiment::TimeSeries ours,  ///< of the attained preset, time from the command
      theirs;                   ///< the 2015 program's
};

/// Everything that was compared, and what became of each bound.
struct Validation {
  config::ActuatorType actuator;              ///< as it was read
  std::vector<config::Override> overrides;    ///< what was changed in it
  std::optional<config::Evidence> evidence;   ///< the type's; none where it has none, or where overrides changed what it speaks of
  std::optional<LeaveOneOut> left_out;        ///< the record of it, if there is one
  std::vector<RecordingCheck> recordings;     ///< the predicted ones first
  std::vector<PeriodCheck> periods;           ///< at other periods of the sweep
  std::vector<SpeedCheck> speeds;             ///< one a recorded percentage
  std::vector<PresetStepCheck> preset_steps;  ///< without load, and with it
  std::vector<experiment::Verdict> verdicts;  ///< in the file's order
  double wall_s = 0;                          ///< of all runs
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
