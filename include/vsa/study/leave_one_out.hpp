// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The leave-one-out figures of an actuator type: fitted without a recording, judged on it. They take minutes, so `vsa identify` finds them
// once; its results.json, kept as data/TYPE/leave_one_out.json, is the record. Read here: "command", "parameters",
// "leave_one_preset_out", "identified_values"; other keys are the identification's own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"

namespace vsa::study {

/// A record of `vsa identify`'s cross-validation.
struct LeaveOneOut {
  /// One preset left out.
  struct Row {
    double preset = 0;         ///< that was left out
    double predicted_rad = 0;  ///< root mean square by the fit to the other presets
    double fitted_rad = 0;     ///< and by the fit to all
  };
  /// A value of the identified type.
  struct Value {
    std::string key,  ///< "drive.friction_Nm"
        text;         ///< as a file has it
  };
  /// The 95 % interval of a parameter that was fitted; NaN where it isn't determined.
  struct Interval {
    std::string key;  ///< "drive.friction_Nm"
    double low = 0,   ///< end of the interval
        high = 0;     ///< end of the interval
  };
  std::string file,                 ///< where it lies
      command;                      ///< what made it
  std::vector<std::string> fitted;  ///< parameters that were fitted again each time; all others were held
  std::vector<Interval> intervals;  ///< of each key of them, tied ones each
  std::vector<Row> rows;            ///< one a preset left out
  std::vector<Value> values;        ///< of every parameter of the identified type
};

/// Where the record of a type is kept, below a data directory.
[[nodiscard]] std::filesystem::path record_name(const std::string& type);

/// Throws InputError where it isn't what `vsa identify` writes, or holds no cross-validation.
[[nodiscard]] LeaveOneOut read_leave_one_out(const std::filesystem::path& file);

/// What tells that the record isn't this type's: held values that differ, and what it doesn't know. Empty: it is this type's.
[[nodiscard]] std::vector<std::string> differences(const LeaveOneOut& record, const config::ActuatorType& type);

/// The fitted keys whose values in the type lie outside of the record's 95 % intervals: its fit to all ended elsewhere.
[[nodiscard]] std::vector<std::string> fitted_elsewhere(const LeaveOneOut& record, const config::ActuatorType& type);

}  // namespace vsa::study
