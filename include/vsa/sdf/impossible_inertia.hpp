// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::reader {

/// Links whose inertia no body can have: one principal moment is larger than the sum of the other two. Gazebo takes them as they are;
/// robots in use have them.
enum class ImpossibleInertia {
  refuse,  ///< the world can't be loaded
  lower    ///< the largest principal moment is lowered to the sum of the other two, about the same axes, and warned of
};

}  // namespace vsa::reader
