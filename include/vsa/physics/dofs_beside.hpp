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
/// along as it is, unless an equality may tie that tree to another one.
inline std::vector<std::size_t> dofs_beside(const mjModel& m, std::span<const int> driven) {
  const TreeRoots roots(m);
  std::vector<int> top(static_cast<std::size_t>(m.nv)),
      tops(top.size());  // of a tree; by root, one of its trees' or −1: of several
  for (int v = 0; v < m.nv; ++v) top[v] = m.dof_parentid[v] < 0 ? v : top[m.dof_parentid[v]];
  for (int v = 0; v < m.nv; ++v) tops[roots.root(v)] = top[v];
  for (int v = 0; v < m.nv; ++v)
    if (tops[roots.root(v)] != top[v]) tops[roots.root(v)] = -1;
  std::vector<char> moved(top.size());
  for (const int v : driven) moved[roots.root(v)] = 1;
  std::vector<std::size_t> out;
  for (int v = 0; v < m.nv; ++v) {
    const bool carries = m.jnt_type[m.dof_jntid[v]] == mjJNT_FREE && tops[roots.root(v)] >= 0;
    if (moved[roots.root(v)] && !carries && std::find(driven.begin(), driven.end(), v) == driven.end())
      out.push_back(static_cast<std::size_t>(v));
  }
  return out;
}

/// How far the fastest of them goes in dt_s at these speeds, rad; a slide counts ten radians for a metre.
inline double turned_rad(const mjModel& m, const mjtNum* speeds, std::span<const std::size_t> dofs, double dt_s) noexcept {
  double most = 0;
  for (const std::size_t v : dofs) {
    const int type = m.jnt_type[m.dof_jntid[v]];
    const bool slides = type == mjJNT_SLIDE || (type == mjJNT_FREE && static_cast<int>(v) < m.jnt_dofadr[m.dof_jntid[v]] + 3);
    most = std::max(most, std::abs(speeds[v]) * (slides ? 10.0 : 1.0));
  }
  return most * dt_s;
}

}  // namespace vsa::physics
