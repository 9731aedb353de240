// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a World's public functions ask of their arguments.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "vsa/errors.hpp"

namespace vsa::engine {

inline constexpr double kMostState = 1e12;  ///< of what is set of bodies; beyond 1e10 the next step is a blow-up

inline void check_size(const char* what, std::size_t given, std::size_t wanted) {
  if (given != wanted)
    throw InputError(Problem{"", what, fmt::format("{} numbers", given), "wrong size", fmt::format("{}", wanted)});
}

/// |value| ≤ most, and a number.
inline void check_within(const char* what, double value, double most) {
  if (!(std::abs(value) <= most))
    throw InputError(Problem{"", what, fmt::format("{}", value), "out of range", fmt::format("±{}", most)});
}

struct WorldOptions;
/// Adds what options ask for that an export, which is of a file, can't have: another step and, `robots`, other actuators.
void check_file_is_exported(const WorldOptions& options, bool robots, Problems& problems);

}  // namespace vsa::engine
