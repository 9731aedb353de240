// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// run.mcap of a recording: what the CSV files hold, and the shapes, as one file that robotics tools open (mcap.hpp). Times are
// simulated time. Messages are JSON with a JSON schema:
//
//   /model/M/actuators      vsasim.ActuatorStates      a robot's readings, SI, units in the field names (the preset's beside it)
//   /world/W/energy         vsasim.Energy              as energy.csv
//   /world/W/links          foxglove.FrameTransforms   pose in the frame "world" of every link that isn't static
//   /world/W/static_links   foxglove.FrameTransforms   once: of those that are
//   /world/W/shapes         foxglove.SceneUpdate       once: what the links look like, each in its link's frame
//
// The metadata record "vsasim.run" tells world, step, rate, version, and faults with their seeds, the only thing left to chance.
// JSON has no NaN: a number that isn't finite is left out.
#pragma once

#include <filesystem>
#include <memory>

#include "vsa/record/run_data.hpp"

namespace vsa::record {

/// Writes run.mcap, sample by sample.
class RunLog {
 public:
  static constexpr const char* kFile = "run.mcap";  ///< its name
  /// Replaces directory/run.mcap; the directory exists (CsvFiles makes and guards it). Throws InputError.
  RunLog(const RunInfo& info, const std::filesystem::path& directory, double rate_Hz);
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Throws RecordError with path and reason.
  void write(const Sample& sample);
  /// Back to a file without messages.
  void restart();
  /// Makes the file whole (RecordError). Nothing may be written afterwards.
  void close();

  [[nodiscard]] const std::filesystem::path& file() const noexcept;  ///< directory/run.mcap

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::record
