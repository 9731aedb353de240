// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace vsa::device {

inline constexpr int kFull = 100;  ///< % of duty

[[nodiscard]] inline double seconds(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }

}  // namespace vsa::device
