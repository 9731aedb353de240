// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What changes B beside the driven joints: joints of their trees that nothing drives (host::MobilityWatch::turned).
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "vsa/physics/tree_roots.hpp"

namespace vsa::physics {

/// Degrees of freedom that move with the driven ones and aren't among them. Not those of a free body at the root, which carries a tree
/// along as it is, unless equalities may tie it to something.
inline std::vector<int> dofs_beside(const mjModel& m, std::span<const int> driven) {
  const TreeRoots roots(m);
  std::vector<int> out;
  for (int v = 0; v < m.nv; ++v) {
    const bool carries = m.neq == 0 && m.jnt_type[m.dof_jntid[v]] == mjJNT_FREE;
    const auto moves_with = [&](int other) { return roots.root(other) == roots.root(v); };
    if (!carries && std::find(driven.begin(), driven.end(), v) == driven.end() &&
        std::any_of(driven.begin(), driven.end(), moves_with))
      out.push_back(v);
  }
  return out;
}

/// How far the fastest of them goes in dt_s at these speeds, rad; a slide counts ten radians for a metre.
inline double turned_rad(const mjModel& m, const mjtNum* speeds, std::span<const int> dofs, double dt_s) noexcept {
  double most = 0;
  for (const int v : dofs) {
    const int type = m.jnt_type[m.dof_jntid[v]];
    const bool slides = type == mjJNT_SLIDE || (type == mjJNT_FREE && v < m.jnt_dofadr[m.dof_jntid[v]] + 3);
    most = std::max(most, std::abs(speeds[v]) * (slides ? 10.0 : 1.0));
  }
  return most * dt_s;
}

}  // namespace vsa::physics
