// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace vsa {

/// What wasn't measured, or has no value: a quiet NaN.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace vsa
