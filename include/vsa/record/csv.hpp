// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The CSV files of a recording (RFC 4180 quoting, "\n" line ends, "." decimal point, shortest digits that read back the same
// double):
//
//   MODEL_actuators.csv  one per robot, long form, one line an actuator and sample:
//     time_s,actuator,shaft_rad,shaft_speed_rad_per_s,equilibrium_command_rad,equilibrium_rad,preset_command_rad,preset_rad,
//     deflection_rad,stiffness_Nm_per_rad,torque_Nm,motor_1_rad,motor_2_rad,current_1_A,current_2_A
//     The preset's columns end in its unit (_Nm_per_rad of torque servos); where a robot mixes units, a last column preset_unit
//     tells. One-motor actuators leave the second motor's cells empty. Where all are linear actuators, the shaft's columns are in
//     m and N (shaft_m, …, force_N); where some are, a column shaft_unit tells.
//   links.csv            time_s,link,x_m,y_m,z_m,qw,qx,qy,qz   pose in the world of every link that isn't static
//   energy.csv           time_s, the energy ledger summed over all actuators (actuator/ledger.hpp), kinetic_J and gravitational_J
//                        of all bodies (empty where the simulator doesn't tell them)
//
// A sample is appended as whole lines with one write a file, so that a run that ends badly leaves whole lines.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vsa/record/run_data.hpp"

namespace vsa::record {

/// The CSV files of one recording, while it runs.
class CsvFiles {
 public:
  /// Makes the directory where it is missing, replaces the files, writes the headers. Throws InputError with every file that can't
  /// be opened, also of `others`, which come into the directory with these; then all stay as they are.
  CsvFiles(const RunInfo& info, const std::filesystem::path& directory, const std::vector<std::string>& others = {});
  ~CsvFiles();
  CsvFiles(const CsvFiles&) = delete;
  CsvFiles& operator=(const CsvFiles&) = delete;

  /// Throws RecordError with path and reason; whole lines written before stay.
  void write(const Sample& sample);
  /// Back to the headers alone.
  void restart();
  /// Reports what the system could tell only now (RecordError). Nothing may be written afterwards.
  void close();
  void release() noexcept;  ///< the directory is free for another recording

  [[nodiscard]] std::vector<std::filesystem::path> files() const;  ///< with their paths; they are there from the start

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "snake::arm" → "snake_arm": a file name of letters, digits, '.', '_' and '-' only.
[[nodiscard]] std::string file_stem(std::string_view model);

}  // namespace vsa::record
