// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/follow.hpp"

#include <algorithm>

#include "terminal/interrupt.hpp"

namespace vsa::app {

study::OnProgress follow(Console& console) {
  return [&console](const study::Progress& p) {
    console.progress(std::min(p.simulated_s, p.total_s), p.total_s, p.simulated_s / std::max(1e-3, p.wall_s));
    return interrupted() == 0;
  };
}

}  // namespace vsa::app
