// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scene/pose.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::scene {

bool finite(const Pose& pose) noexcept {
  const auto is_finite = [](double v) { return std::isfinite(v); };
  return std::all_of(pose.position.begin(), pose.position.end(), is_finite) &&
         std::all_of(pose.quaternion.begin(), pose.quaternion.end(), is_finite);
}

}  // namespace vsa::scene
