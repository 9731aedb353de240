// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "vsa/experiment/bench.hpp"
#include "vsa/study/progress.hpp"

namespace vsa::study {

/// Runs the jobs, which `watch` watches, on `threads` threads, the first ones first. False: `on_progress` stopped them.
bool run_watched(const std::vector<std::function<void()>>& jobs, experiment::Watch& watch, double total_s,
                 const OnProgress& on_progress, unsigned threads);

}  // namespace vsa::study
