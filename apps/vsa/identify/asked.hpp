// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An identification as it was asked for, and its course, whoever does its jobs: vsa identify's threads, vsa-mpi's ranks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "identify/identify.hpp"
#include "identify/output.hpp"
#include "sweep/generations.hpp"
#include "terminal/console.hpp"
#include "vsa/identify/bench_model.hpp"
#include "vsa/sweep/fits.hpp"

namespace vsa::app {

/// All that the numbers follow from, read and checked.
class Asked {
 public:
  /// Throws InputError with every problem.
  explicit Asked(const IdentifyOptions& options);

  [[nodiscard]] const IdentifyOptions& options() const { return options_; }
  [[nodiscard]] std::filesystem::path out() const;     ///< where the results go
  [[nodiscard]] std::filesystem::path folder() const;  ///< where the jobs' logs are until all is done
  [[nodiscard]] identify::Task task(unsigned threads, experiment::Watch* watch) const;
  [[nodiscard]] identify::IdentificationOptions settings() const;
  /// Which recordings go further than their grid.
  [[nodiscard]] std::vector<std::string> off_the_grid() const;
  /// These jobs' runs.
  [[nodiscard]] sweep::Series series(std::vector<identify::Job> jobs) const;
  [[nodiscard]] std::size_t parameters() const { return bare_.parameters.size(); }
  [[nodiscard]] const config::ActuatorType& type() const { return type_; }
  [[nodiscard]] const experiment::Specimen& specimen() const { return specimen_; }
  [[nodiscard]] std::string command() const;
  [[nodiscard]] std::uint64_t fingerprint() const;

 private:
  IdentifyOptions options_;
  experiment::Specimen specimen_;
  config::ActuatorType type_;
  identify::SweepOptions sweep_;
  identify::Task bare_;  // without models
};

/// `jobs`: all so far; of them those numbers are to be made, and be in the log then. False: a signal came.
using MakeJobs = std::function<bool(const std::vector<identify::Job>& jobs, const Todo& runs)>;
/// Makes the directory and claims the folder in it. Throws InputError: it has results and nobody said --resume.
[[nodiscard]] Generations generations_of(const Asked& asked, Console& console);
/// The identification itself; writes and shows the results. The exit code.
int identify_with(const Asked& asked, Generations& generations, Console& console, const MakeJobs& make);

}  // namespace vsa::app
