// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The model of the identification: the load test on the simulated bench, full dynamics, measured as the unit measures.
#pragma once

#include <memory>
#include <optional>

#include "vsa/experiment/bench.hpp"
#include "vsa/identify/task.hpp"

namespace vsa::identify {

/// The sweep, common to all recordings. Of the simulated cycles the first half is left out, as in the recordings.
struct SweepOptions {
  double period_s = 38.0;               ///< of the sweep
  std::optional<double> amplitude_rad;  ///< none: by experiment::sweep_amplitude() at each solution's start, then held
  double cycles = 1.5;                  ///< 1.5 or more
  double sample_s = 0.01;               ///< between two samples
  double load_share = 1;                ///< of the bench's mass, 1 kg
};

/// Puts `model`, `prepare` and, where the unit has one (quasi_static.hpp), `surrogate` into a task whose parameters and
/// observations are there. `watch` ends it from another thread; `threads` are those of `prepare`, 0: all that the machine has.
void use_bench(Task& task, const experiment::Specimen& specimen, const SweepOptions& sweep, experiment::Watch* watch = nullptr,
               unsigned threads = 0);

/// One run of it, as the model sees it; for plots and for making recordings to try the identification on.
[[nodiscard]] experiment::LoadRecording simulated_recording(const experiment::Specimen& specimen, double preset,
                                                            const SweepOptions& sweep, experiment::Watch* watch = nullptr);

}  // namespace vsa::identify
