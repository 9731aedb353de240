// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The simulator beside everything in data/.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "characterize/runs.hpp"
#include "validate/record.hpp"
#include "vsa/experiment/bounds.hpp"

namespace vsa::app {

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
  std::string command;
  config::Preset actuator;
  std::vector<config::Override> overrides;
  std::optional<config::Evidence> evidence;  ///< the preset's; none where it has none, or where --set changed what it speaks of
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

/// The torques at which the falling branch lies below the rising one, against the loop's usual sense: "−0.2 … 0.05"; "none".
[[nodiscard]] std::string reversed_text(const experiment::Branches& branches);

/// Reads data/ and the directories with more recordings, runs all experiments in parallel and compares. None: a signal stopped it.
/// `command`, `left_out` and `verdicts` stay empty.
[[nodiscard]] std::optional<Validation> validate(const experiment::Specimen& specimen, const experiment::BoundsFile& bounds,
                                                 const std::vector<std::string>& more_recordings, Console& console);

}  // namespace vsa::app
