// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Scenarios from and to TOML. For the project's own rooms, as vsa/config/toml_section.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vsa/config/toml_section.hpp"
#include "vsa/scenario/scenario.hpp"

namespace vsa::scenario {

/// Of a file's tables what is a scenario's: `run` is its [scenario], `top` has [set], [motion] and [[command]]. Files are sought beside
/// `file` first. What it didn't ask for is the caller's to refuse. What the motion's changes hold is read by load_motion().
[[nodiscard]] Scenario read(config::TomlSection& top, config::TomlSection& run, const std::filesystem::path& file,
                            Problems& problems);

/// The tables that repeat a run of `duration_s` (0: none is said). Files are named so that it may lie anywhere: built-in ones by name,
/// others by their whole path. Numbers are as short as can be. `own`: more for [scenario], of the caller's keys.
[[nodiscard]] std::string text(const Scenario& scenario, double duration_s, const toml::table& own = {});

}  // namespace vsa::scenario
