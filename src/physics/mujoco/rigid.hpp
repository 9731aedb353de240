// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What hangs rigidly together by fixed joints, as one body: a light bracket on a heavy beam moves with all of the beam's inertia.
#pragma once

#include <vector>

#include "physics/description.hpp"

namespace vsa::physics {

class RigidGroups {
 public:
  explicit RigidGroups(const description::World& world);
  /// How far from `from` the link's group has its mass, or its inertia's; 0: it can't move, or is the world.
  [[nodiscard]] double reach(std::optional<std::size_t> link, const Vec3& from) const;

 private:
  [[nodiscard]] std::size_t top(std::size_t link) const;

  const description::World& world_;
  std::vector<std::size_t> of_;  ///< of a link its group's last, which stands for it; the last of all is the world
};

}  // namespace vsa::physics
