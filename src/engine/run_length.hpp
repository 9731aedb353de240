// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "vsa/errors.hpp"

namespace vsa::engine {

inline constexpr double kLongestRun_s = 1e9;

/// When a run that begins now ends. Throws InputError.
[[nodiscard]] inline std::int64_t run_end_ns(std::int64_t now_ns, double duration_s) {
  if (!(duration_s >= 0 && duration_s <= kLongestRun_s)) {
    throw InputError(
        Problem{"", "duration_s", fmt::format("{}", duration_s), "out of range", fmt::format("0 … {} s", kLongestRun_s)});
  }
  return now_ns + std::llround(duration_s * 1e9);
}

}  // namespace vsa::engine
