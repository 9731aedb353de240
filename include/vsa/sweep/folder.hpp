// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where a sweep's results lie, so that nothing is lost whoever dies when, and nothing counts twice:
//
//   plan.toml        the plan that the folder belongs to
//   sweep.id         its fingerprint
//   log/HOST-PID-N   one of each process that ran, only appended to: a line a run, with a checksum
//   results.csv, results.h5, page.html     made of the logs, by merge()
//
// A line that is damaged or cut short isn't there. Two lines of a run must say the same.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "vsa/output_file.hpp"
#include "vsa/sweep/plan.hpp"

namespace vsa::sweep {

/// A process's log. From any thread.
class Log {
 public:
  /// A new one in the folder. Throws InputError, OutputError.
  Log(const std::filesystem::path& folder, const Series& series);
  void add(const Outcome& outcome);  ///< throws OutputError; what was there stays whole
  [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }  ///< in the folder's log/

 private:
  std::mutex mutex_;
  OutputFile file_;
};

/// What a folder's logs tell of its runs.
struct Results {
  std::vector<Outcome> outcomes;  ///< by run; only those that are there
  std::size_t damaged = 0;        ///< lines that were left out
};

/// Makes the folder where it is missing and says whose it is. Throws InputError: it is another plan's, or holds something else.
void claim(const std::filesystem::path& folder, const Series& series);
/// All logs of a folder. Throws InputError: they are another plan's, or disagree about a run.
[[nodiscard]] Results read_logs(const std::filesystem::path& folder, const Series& series);

/// The table of all runs: sorted, the same bytes whoever ran what. Empty cells: not run, failed, no number.
[[nodiscard]] std::string csv(const Plan& plan, const Results& results);
/// Writes it, and the same by columns (HDF5) where this build has that; each beside it first, then renamed. Returns the files.
std::vector<std::filesystem::path> write_tables(const std::filesystem::path& folder, const Plan& plan, const Results& results);
[[nodiscard]] bool has_hdf5() noexcept;  ///< whether write_tables() writes HDF5

}  // namespace vsa::sweep
