// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace vsa::study {

/// How far the runs of a study are.
struct Progress {
  double simulated_s = 0;  ///< by all runs together; finding an amplitude may take more than was foreseen
  double total_s = 0;      ///< foreseen, about
  double wall_s = 0;       ///< since the first run began
};

/// Called in the thread that runs the study: as it begins and about 20 times a second. False stops all runs within a step of each.
/// What it throws stops them too and comes out of the study.
using OnProgress = std::function<bool(const Progress&)>;

}  // namespace vsa::study
