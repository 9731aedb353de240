// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Curves of the 2015 program beside ours.
#pragma once

#include <array>
#include <cstddef>

#include "vsa/experiment/recording.hpp"

namespace vsa::study {

/// The presets of its figure 4, in percent of 0.75 rad.
inline constexpr std::array<int, 4> kPercents{0, 15, 40, 100};
inline constexpr double kFullPreset_rad = 0.75;

/// From `from_s` for `span_s`, time counted from `from_s`.
[[nodiscard]] experiment::TimeSeries cut(const experiment::TimeSeries& s, double from_s, double span_s);

/// When a recorded reference steps: the middle of its n-th jump. Throws InputError where it has fewer.
[[nodiscard]] double edge_s(const experiment::TimeSeries& reference, std::size_t n);

}  // namespace vsa::study
