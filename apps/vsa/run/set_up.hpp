// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa run`'s options ask for beside the scenario, made. Each throws InputError.
#pragma once

#include <optional>

#include "run/run.hpp"
#include "vsa/record/recorder.hpp"

namespace vsa::app {

/// The options with their seed in every fault's text that has none.
[[nodiscard]] RunOptions seeded(RunOptions options);

/// Simulated by wall time; none: as fast as it can.
[[nodiscard]] std::optional<double> speed_of(const RunOptions& options);

[[nodiscard]] record::RecorderOptions recorder_options(const RunOptions& options);

}  // namespace vsa::app
