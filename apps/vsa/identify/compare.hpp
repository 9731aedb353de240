// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa identify --compare FILE.toml`: hypotheses side by side (vsa/identify/comparison.hpp), whoever makes the fits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identify/compare_output.hpp"
#include "sweep/steps.hpp"
#include "terminal/console.hpp"
#include "vsa/sweep/series.hpp"

namespace vsa::app {

struct CompareOptions {
  std::string file;            ///< the hypotheses
  std::string out;             ///< directory; empty: compare_FILE
  std::optional<int> threads;  ///< fits side by side; none: as the file says
  std::string part;            ///< "2/8"
  double wait_s = kWait_s;
};

/// What is compared, read and checked, and its fits as runs.
class Comparing {
 public:
  /// Simulates a little of each fit, to know whether one that is there is still what it would be; a signal ends that
  /// (experiment::Stopped). Throws InputError with every problem.
  explicit Comparing(const CompareOptions& options);

  [[nodiscard]] const CompareOptions& options() const { return options_; }
  [[nodiscard]] const identify::Comparison& comparison() const { return comparison_; }
  [[nodiscard]] std::size_t fits() const { return requests_.size(); }
  [[nodiscard]] std::string name(std::size_t fit) const { return identify::request_name(comparison_, requests_[fit]); }
  [[nodiscard]] std::filesystem::path out() const;
  [[nodiscard]] std::optional<identify::FitRecord> stored(std::size_t fit) const;
  struct Failure {
    std::string why;
    bool is_news = false;  ///< noted since this process began: what was there before may be tried again by now
  };
  /// What it failed of in another part, if it did and hasn't been stored since.
  [[nodiscard]] std::optional<Failure> failure(std::size_t fit) const;
  void note_failure(std::size_t fit, const std::string& why) const;
  /// Begun anew: what was noted of it goes.
  void forget_failure(std::size_t fit) const;
  /// Runs that store their fits; each on so many threads.
  [[nodiscard]] sweep::Series series(unsigned threads, Console& console) const;
  [[nodiscard]] std::uint64_t fingerprint() const;
  [[nodiscard]] std::string command() const;

 private:
  CompareOptions options_;
  identify::Comparison comparison_;
  std::vector<identify::FitRequest> requests_;
  std::vector<std::optional<std::filesystem::file_time_type>> failed_before_;  // by fit
  std::vector<std::string> hashes_;
};

/// Makes these fits, and they are stored then, as far as they didn't fail. False: a signal came.
using MakeFits = std::function<bool(const Todo& fits)>;
/// Says so where a fit failed, to the other parts too.
void tell_failed(const Comparing& what, const sweep::Outcome& outcome, Console& console);
/// Takes what is stored, asks for the rest, writes and shows the judgement. The exit code: failed where a fit did,
/// another part's too. Throws std::runtime_error where the others' don't come.
int compare_with(const Comparing& what, Console& console, const MakeFits& make);

/// Writes each fit into OUT/fits when it is done, takes those from there that were asked the same, and ends with comparison.json,
/// comparison.md and the table on standard output.
int run_compare(const CompareOptions& options);

}  // namespace vsa::app
