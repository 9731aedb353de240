// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace vsa::physics {

/// A blow-up: the state is no longer finite or an engine warning was raised. what() names time, joint and value.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vsa::physics
