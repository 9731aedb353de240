// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An identification's fits as runs of a pool.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vsa/experiment/bench.hpp"
#include "vsa/identify/comparison.hpp"
#include "vsa/identify/identification.hpp"
#include "vsa/sweep/series.hpp"

namespace vsa::sweep {

/// A task that ends where the watch says so.
using MakeWatchedTask = std::function<identify::Task(unsigned threads, experiment::Watch& watch)>;

/// Run i is job i (vsa/identify/jobs.hpp); its numbers are those of its result. Jobs that come later go behind those that are there, so
/// that a run stays what it was. Fingerprint and text are the caller's to fill in.
[[nodiscard]] Series series_of(const MakeWatchedTask& make, const identify::FitOptions& options, std::size_t parameters,
                               std::vector<identify::Job> jobs);
/// What an outcome of such a run says.
[[nodiscard]] identify::Done done_of(const Outcome& outcome, const identify::Job& job);

/// Run i is fit i of a comparison, of identify::requests(); it has no numbers: `done` takes its record, from any thread. `threads`: for
/// each fit.
[[nodiscard]] Series series_of(const identify::Comparison& comparison, unsigned threads,
                               std::function<void(std::size_t run, identify::FitRecord record)> done);

}  // namespace vsa::sweep
