// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A run as a file (TOML, docs/reference/scenario-files.md): what `vsa run`'s flags say, changes of the motion, and commands in
// simulated time. Relative paths in it are relative to the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/run.hpp"
#include "vsa/motion/gait.hpp"

namespace vsa::app {

inline constexpr const char* kScenario = "scenario.toml";  ///< in a record

[[nodiscard]] bool is_scenario(const std::string& world);  ///< by its name: .toml

/// Throws InputError with every problem of the file. What the motion's changes hold is read by load_motion().
[[nodiscard]] RunOptions read_scenario(const std::filesystem::path& file);

/// The gait or motion of a run, with the scenario's changes; none: it has none. Throws InputError.
[[nodiscard]] std::optional<motion::Gait> load_motion(const RunOptions& options);

/// The file that repeats a run of `duration_s`: what shapes the recorded numbers, but not where they go. Files are named so that it
/// may lie anywhere: built-in ones by name, others by their whole path. Each remark is a comment at its head.
[[nodiscard]] std::string scenario_text(const RunOptions& options, double duration_s, const std::vector<std::string>& remarks);

}  // namespace vsa::app
