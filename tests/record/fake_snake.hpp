// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Data that look like a run, made from sines without a simulator: for tests of the writers and of the page.
#pragma once

#include "vsa/record/run_data.hpp"

namespace vsa::record::fake {

/// 12 modules (66 mm cubes with a darker flange) on a plane with a few boxes and a hill.
[[nodiscard]] RunInfo snake();
/// The moment `time_ns` of a snake that undulates and crawls along +x.
[[nodiscard]] Sample snake_at(std::int64_t time_ns);

/// One robot with one actuator and two links: small enough for golden bytes.
[[nodiscard]] RunInfo tiny();
[[nodiscard]] Sample tiny_at(std::int64_t time_ns);

}  // namespace vsa::record::fake
