// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs on the threads of one process.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "vsa/sweep/series.hpp"

namespace vsa::sweep {

/// What keeps a pool busy. All are called from several threads at once.
struct Work {
  std::function<std::optional<std::size_t>()> next;  ///< the run that comes next; none: no more
  std::function<void(const Outcome&)> done;          ///< what it throws ends all, and comes out of run_pool
  std::function<bool()> wanted;                      ///< false: end now; runs under way have no outcome
};

/// Where the processors' time went, from the first run's beginning to the last one's end.
struct Account {
  std::size_t runs = 0,    ///< that were made
      failed = 0,          ///< of these, with an error
      threads = 0;         ///< of the pool
  double span_s = 0;       ///< by the wall clock
  double run_wall_s = 0;   ///< Σ over runs: span·threads, if nobody waited
  double run_cpu_s = 0;    ///< Σ over runs
  double all_cpu_s = 0;    ///< of the process
  double most_waited = 0;  ///< waited() of the process that waited most; of one alone nobody asks
  /// The share of the threads' time in which they had nothing to run.
  [[nodiscard]] double waited() const noexcept;
  Account& operator+=(const Account& other) noexcept;  ///< of another process beside this one
};

/// `threads`: 0: as many as the machine runs at once.
Account run_pool(const Series& series, unsigned threads, const Work& work);

/// How many runs the next chunk has: a part of what is left, so that few questions are asked at first and all end together.
///   max(1, left/(kShare·takers))
[[nodiscard]] std::size_t guided_chunk(std::size_t left, std::size_t takers) noexcept;
inline constexpr std::size_t kShare = 3;  ///< of a chunk

}  // namespace vsa::sweep
