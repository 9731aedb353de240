// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/engine/run.hpp"

#include "engine/run_length.hpp"

namespace vsa::engine {

bool run(World& world, double duration_s, const std::function<bool()>& stepped) {
  const std::int64_t end_ns = run_end_ns(world.time_ns(), duration_s);
  while (world.time_ns() < end_ns) {
    world.step();
    if (!stepped()) return false;
  }
  return true;
}

}  // namespace vsa::engine
