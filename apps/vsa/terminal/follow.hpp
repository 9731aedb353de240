// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "terminal/console.hpp"
#include "vsa/study/progress.hpp"

namespace vsa::app {

/// Draws a study's progress and stops it at the first signal that interrupted() tells of. Refers to `console`.
[[nodiscard]] study::OnProgress follow(Console& console);

}  // namespace vsa::app
