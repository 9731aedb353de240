// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs whose next ones follow from the outcomes of those before: a search's, an identification's. Whoever has a part of them makes its
// share of each generation and waits for the others'.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <vector>

#include "sweep/steps.hpp"
#include "terminal/console.hpp"
#include "vsa/output_file.hpp"
#include "vsa/sweep/folder.hpp"
#include "vsa/sweep/pool.hpp"

namespace vsa::app {

/// A signal came.
struct Interrupted {};

struct GenerationOptions {
  std::filesystem::path folder;
  Part part;
  bool resume = false, retry_failed = false;
  double wait_s = kWait_s;  ///< OthersRuns
};

class Generations {
 public:
  /// Claims the folder. Throws InputError: it has results of this part already and nobody said to resume, or another one is at work there.
  Generations(GenerationOptions options, const sweep::Series& series, Console& console);
  /// Makes those of the runs first … end − 1 that are this part's and that no log has, and gives the outcomes of 0 … end − 1, by run.
  /// `make`: they are in the log then; false: a signal came. Throws Interrupted;
  /// std::runtime_error where others' don't come.
  [[nodiscard]] std::vector<sweep::Outcome> complete(const sweep::Series& series, std::size_t first, std::size_t end,
                                                     const std::function<bool(const Todo&)>& make);

 private:
  GenerationOptions options_;
  DirectoryLock lock_;  // parts share the folder; whoever works alone would take away what another one needs
  Console& console_;
  std::set<std::size_t> again_;  // what had failed before
};

/// Makes them on this process's threads, as many of them as a signal lets.
sweep::Account make_here(const sweep::Series& series, const Todo& runs, unsigned threads, sweep::Log& log, Console& console);

}  // namespace vsa::app
