// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whether a robot that is left alone comes to rest.
#pragma once

#include "chain/rest_meter.hpp"
#include "vsa/engine/world.hpp"

namespace vsa::test {

/// `seconds` of a world as it is; the last half second is measured.
inline Rest rest_of(engine::World& world, double seconds) {
  RestMeter meter(world.actuators().size());
  const double from = world.time_s() + seconds - 0.5, until = world.time_s() + seconds;
  while (world.time_s() < until) {
    world.step();
    const bool count = world.time_s() > from;
    for (std::size_t i = 0; i < world.actuators().size(); ++i) meter.sample(i, world.read(world.actuators()[i]), count);
  }
  return meter.rest(world.ledger());
}

}  // namespace vsa::test
