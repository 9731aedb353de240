// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::device {

inline constexpr double kDutyScale = 101.0;  ///< the PWM counter's period: the program's percents are counts of it

}  // namespace vsa::device
