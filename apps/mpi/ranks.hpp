// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A sweep's runs on all ranks of an MPI job. Rank 0 deals them out in chunks (vsa/sweep/pool.hpp) and works too; a rank asks for its
// next chunk when it begins the last run that it has, so that nobody waits for an answer. One thread a process talks MPI
// (MPI_THREAD_FUNNELED) and sleeps between looks; others run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "sweep/steps.hpp"

namespace vsa::app {

/// MPI_Init_thread … MPI_Finalize.
class Job {
 public:
  /// Throws std::runtime_error: this MPI can't be used from a process with threads.
  Job(int& argc, char**& argv);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int size() const noexcept { return size_; }
  // Each of these waits for all ranks asleep, not spinning as MPI's own waiting does.
  /// Rank 0's, on all.
  [[nodiscard]] int from_first(int value) const;
  [[nodiscard]] std::size_t total(std::size_t value) const;
  /// Rank 0's numbers, on all.
  void share(std::vector<double>& numbers) const;
  /// The first rank whose value differs from rank 0's; −1: none.
  [[nodiscard]] int first_apart(std::uint64_t value) const;
  [[nodiscard]] bool any(bool value) const;
  /// Of all, on rank 0.
  [[nodiscard]] sweep::Account gathered(const sweep::Account& own) const;
  /// Ends every process of the job.
  [[noreturn]] void abort() const;

 private:
  void meet() const;
  int rank_ = 0, size_ = 1;
};

struct RankWork {
  unsigned threads = 1;
  std::function<void(const sweep::Outcome&)> done;  ///< from any thread
  std::function<bool()> wanted;                     ///< from any thread
  std::function<void(std::size_t dealt)> progress;  ///< rank 0
};
/// `dealer`: rank 0's; null on the others. Throws what a run's `done` throws; the job can't go on then.
[[nodiscard]] sweep::Account run_ranks(const Job& job, const sweep::Series& series, Dealer* dealer, const RankWork& work);

}  // namespace vsa::app
