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

#include "vsa/report/report.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::app {

[[nodiscard]] report::Report characterization_report(const study::Characterization& c, const std::string& command);

/// One table an experiment, units in the heads.
[[nodiscard]] report::Table stiffness_table(const study::Characterization& c);
[[nodiscard]] report::Table speed_table(const study::Characterization& c);
[[nodiscard]] report::Table preset_step_table(const study::Characterization& c);
/// Where the benches aren't the paper's for this actuator: a sentence each.
[[nodiscard]] std::vector<std::string> fit_notes(const study::Characterization& c);
/// The tables as text.
[[nodiscard]] std::string characterization_text(const study::Characterization& c);

/// Writes all of it; returns the names, the report first. Throws std::runtime_error.
std::vector<std::string> write_characterization(const study::Characterization& c, const std::string& command,
                                                const std::filesystem::path& directory);

}  // namespace vsa::app
