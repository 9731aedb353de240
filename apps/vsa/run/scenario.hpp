// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A run as a file: a scenario (vsa/scenario/), and what else `vsa run`'s flags say.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/run.hpp"

namespace vsa::app {

inline constexpr const char* kScenario = "scenario.toml";  ///< in a record

[[nodiscard]] bool is_scenario(const std::string& world);  ///< by its name: .toml

/// Throws InputError with every problem of the file, but what its motion's changes hold: scenario::load_motion().
[[nodiscard]] RunOptions read_scenario(const std::filesystem::path& file);

/// The file that repeats a run of `duration_s`: what shapes the recorded numbers, but not where they go. Each remark is a comment at
/// its head.
[[nodiscard]] std::string scenario_text(const RunOptions& options, double duration_s, const std::vector<std::string>& remarks);

}  // namespace vsa::app
