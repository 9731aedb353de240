// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Parts of a plan's file, read by themselves; what is wrong goes to the section's problems.
#pragma once

#include <array>
#include <limits>
#include <string>

#include "sweep/plan_impl.hpp"
#include "vsa/config/toml_section.hpp"

namespace vsa::sweep {

/// Tables of a scenario's or a study's that a plan may have itself, and first words of keys that vary in them.
inline constexpr std::array kParts{"scenario", "study", "set", "motion", "command"};
/// Of [scenario]: what changes none of a run's numbers.
inline constexpr std::array kOutside{"speed", "low_latency", "view", "view_port", "view_records", "paused", "topics"};
/// What a number that any bound would be wrong for may have as its bounds.
inline constexpr double kAny = std::numeric_limits<double>::max();
inline constexpr double kMostSamples = Plan::kMostRuns;

[[nodiscard]] Axis read_axis(config::TomlSection s);
[[nodiscard]] Measure read_measure(config::TomlSection s);
[[nodiscard]] Measure read_study_measure(config::TomlSection s);
/// [optimize] and [[objective]], into `out`; they and searched axes go together.
void read_search(config::TomlSection& top, const std::string& file, Plan::Impl& out, Problems& problems);

}  // namespace vsa::sweep
