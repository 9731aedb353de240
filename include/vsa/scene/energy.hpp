// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::scene {

/// Kinetic and gravitational energy of all bodies and that of the description's own springs, J. What a file switches off counts for
/// nothing.
struct Energy {
  double kinetic = 0,     ///< of all bodies
      gravitational = 0,  ///< 0 of a body at the world's origin
      springs = 0;        ///< the description's own, of joints, and of an MJCF's tendons
};

}  // namespace vsa::scene
