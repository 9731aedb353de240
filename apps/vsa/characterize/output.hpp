// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa characterize` leaves behind:
//   report.html                        curves and tables
//   results.json                       every measure, units in the keys; what couldn't be measured is null
//   stiffness_preset_P.PPPPrad.csv     time_s,load_torque_Nm,deflection_rad as the unit measures them, then the simulation's truth;
//                                      time counts from the sweep's start, the first cycle is left out
//   speed_preset_P.PPPPrad.csv         time counts from the first edge
//   preset_step_unloaded.csv, preset_step_loaded.csv
// An actuator without a preset has stiffness.csv and speed.csv.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "characterize/runs.hpp"
#include "vsa/report/report.hpp"

namespace vsa::app {

[[nodiscard]] std::string csv_text(const experiment::BenchRun& run);
[[nodiscard]] std::string stiffness_file(const Characterization& c, const StiffnessResult& r);
[[nodiscard]] std::string speed_file(const Characterization& c, const SpeedResult& r);
[[nodiscard]] std::string preset_step_file(const PresetStepResult& r);
[[nodiscard]] std::string results_json(const Characterization& c, const std::string& command);
[[nodiscard]] report::Report characterization_report(const Characterization& c, const std::string& command);

/// One table an experiment, units in the heads.
[[nodiscard]] report::Table stiffness_table(const Characterization& c);
[[nodiscard]] report::Table speed_table(const Characterization& c);
[[nodiscard]] report::Table preset_step_table(const Characterization& c);
/// The tables as text.
[[nodiscard]] std::string characterization_text(const Characterization& c);

/// Writes all of it; returns the names, the report first. Throws std::runtime_error.
std::vector<std::string> write_characterization(const Characterization& c, const std::string& command,
                                                const std::filesystem::path& directory);

}  // namespace vsa::app
