// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs that somebody looks into, or ends.
#pragma once

#include <functional>

#include "vsa/engine/world.hpp"

namespace vsa::engine {

/// World::run(), but `stepped` is called after each step: false ends it there, and run() returns false. What it throws comes out,
/// with the world between two steps. InputError as World::run's.
bool run(World& world, double duration_s, const std::function<bool()>& stepped);

}  // namespace vsa::engine
