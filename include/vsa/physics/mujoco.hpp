// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/physics/physics.hpp"

namespace vsa::physics {

/// MuJoCo 2.2.2, as Debian 12 and 13 have it, or one from 3.2 on: the one that vsasim was built with.
[[nodiscard]] std::shared_ptr<const Engine> mujoco();

}  // namespace vsa::physics
