// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// When a segment's Newton rounds end, and what counts as nothing.
#pragma once

#include <limits>

namespace vsa::actuator::step {

inline constexpr int kMaxIterations = 60;  ///< Newton's rounds for a segment
/// Newton converges quadratically: a last correction that moves a load by this fraction leaves about its square. What it leaves is
/// not lost but booked as integrator error.
inline constexpr double kRelativeTolerance = 1e-4;                       ///< of a pulley's load
inline constexpr double kAbsoluteTolerance_Nm = 1e-6;                    ///< N·m
inline constexpr double kRough_rad = 0.02;                               ///< a correction that is larger isn't trusted unseen
inline constexpr double kNothing = std::numeric_limits<double>::min();   ///< stands for 0 in a divisor
inline constexpr double kFar = std::numeric_limits<double>::infinity();  ///< no limit
/// Where no bristle begins or ends to slide, a correction that moves a spring's load by this fraction leaves half of its square.
inline constexpr double kStraight = 3e-3;  ///< of a pulley's load

}  // namespace vsa::actuator::step
