// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/physics/physics.hpp"

namespace vsa::physics {

/// With which speeds a step works out Coriolis and centrifugal torques. MuJoCo's Euler step holds v of half a step ago beside q of now.
enum class Coriolis {
  of_now,         ///< v + dt/2·a: right in the second order of dt
  as_in_mj_step,  ///< v: for comparing with a MuJoCo by itself, to the last bit where nothing is damped
};

/// MuJoCo 2.2.2, as Debian 12 and 13 have it, or one from 3.2 on: the one that vsasim was built with.
[[nodiscard]] std::shared_ptr<const Engine> mujoco(Coriolis coriolis = Coriolis::of_now);

}  // namespace vsa::physics
