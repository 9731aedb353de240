// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What launchers of a sweep share: vsa sweep's threads, vsa-mpi's ranks.
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sweep/sweep.hpp"
#include "terminal/console.hpp"
#include "vsa/report/report.hpp"
#include "vsa/sweep/folder.hpp"
#include "vsa/sweep/pool.hpp"

namespace vsa::app {

[[nodiscard]] std::filesystem::path folder_of(const SweepOptions& options);

/// Runs that are still to be made, as begin and end of ranges.
struct Todo {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  std::size_t count = 0;
  void add(std::size_t run);
};
/// Reads what a claimed folder has. Throws InputError: results, and nobody said --resume.
[[nodiscard]] Todo what_is_left(const sweep::Plan& plan, const SweepOptions& options);

/// Every Nth run, from the Ith on.
struct Part {
  std::size_t number = 1, of = 1;
  [[nodiscard]] bool has(std::size_t run) const noexcept { return run % of == number - 1; }
};
/// "2/8"; empty: the whole. Throws InputError.
[[nodiscard]] Part part_of(const std::string& text);

/// s; throws InputError.
void check_wait(double wait_s);

/// One part's wait for the runs of the others, which may never have been started.
class OthersRuns {
 public:
  OthersRuns(Part part, double wait_s, Console& console) : part_(part), wait_s_(wait_s), console_(console) {}
  /// Looks again in a moment. Tells once which parts owe runs; throws std::runtime_error where none has come for wait_s.
  void wait_for(const std::vector<std::size_t>& missing, const char* runs);

 private:
  Part part_;
  double wait_s_;
  Console& console_;
  std::size_t missing_ = 0;
  bool told_ = false;
  std::chrono::steady_clock::time_point news_{}, begin_{};
};

/// The folder is this series', and this process's until the lock goes: alone, or with the other parts. Throws InputError: another plan's,
/// or another process is at work there.
[[nodiscard]] DirectoryLock claim_folder(const std::filesystem::path& folder, const sweep::Series& series, const Part& part);

/// Numbers of a todo list, one after the other. From any thread.
class Dealer {
 public:
  explicit Dealer(Todo todo) : todo_(std::move(todo)), left_(todo_.count) {}
  [[nodiscard]] std::size_t left() const {
    const std::scoped_lock lock(mutex_);
    return left_;
  }
  [[nodiscard]] std::optional<std::size_t> next();  ///< one; none: no more
  /// The next `count`, or all that are left.
  [[nodiscard]] std::vector<std::size_t> deal(std::size_t count);

 private:
  mutable std::mutex mutex_;
  Todo todo_;
  std::size_t left_, range_ = 0, at_ = 0;
};

/// Throws InputError where a plan is one to be searched (vsa optimize).
void refuse_search(const sweep::Plan& plan, const SweepOptions& options);

/// "12,345 runs: 3 axes …": what the plan asks for.
void tell_plan(const sweep::Plan& plan, Console& console);
/// "123 of 1000 runs, 45.6 a second, 20 s left"
class RunProgress {
 public:
  explicit RunProgress(std::size_t total) : total_(total), began_(std::chrono::steady_clock::now()) {}
  [[nodiscard]] std::string text(std::size_t done, std::size_t failed) const;

 private:
  std::size_t total_;
  std::chrono::steady_clock::time_point began_;
};

/// How well the processors were used.
[[nodiscard]] std::string account_text(const sweep::Account& account, std::size_t processes);

/// Writes the page beside its tables; where this installation lacks the page's program, that is said, and there is none.
[[nodiscard]] bool write_page(const report::Report& page, const std::filesystem::path& file, Console& console);

/// Reads all logs, writes the tables, tells what came of it. The exit code: failed where a run did or isn't there.
int merge(const sweep::Plan& plan, const SweepOptions& options, Console& console);

}  // namespace vsa::app
