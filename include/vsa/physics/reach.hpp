// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which kinematic trees of an mjModel may ever touch each other, or the same thing: by the place of each one's root and by how far its
// shapes reach from there, whatever its joints do. What floats, or stands on what a program moves (mocap), reaches everywhere. Trees that
// an equality may tie reach as one.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "vsa/physics/tree_roots.hpp"

namespace vsa::physics {

/// Of a compiled model; looks at nothing but sizes and places that it is made with.
class Reach {
 public:
  /// Of a model, which it doesn't keep.
  explicit Reach(const mjModel& m);
  /// For each of those degrees of freedom a number, equal where their trees may touch, each other or through others: through the thing
  /// that two hold, no larger than the largest that nothing in `dofs` moves, and through trees that none of them moves.
  [[nodiscard]] std::vector<std::size_t> neighbours(std::span<const int> dofs) const;

 private:
  struct Tree {
    std::array<mjtNum, 3> root{};
    mjtNum reach = -1;  // of its shapes, m; -1: it has none that collide
    mjtNum size = 0;    // likewise, of one that floats, from its own origin
    bool floats = false;
  };
  struct Placed {
    std::array<mjtNum, 3> at{};
    std::array<mjtNum, 4> turn{1, 0, 0, 0};
  };
  struct Places {
    std::vector<Placed> fixed;  // of a body that no joint moves
    std::vector<char> moved;    // by a program
    std::vector<mjtNum> away;   // of a body's origin from its tree's root, at most
  };
  void add_body(const mjModel& m, int body, Places& places);
  [[nodiscard]] static std::vector<char> collide(const mjModel& m);  // by geom

  std::vector<int> of_body_, of_dof_;  // into trees_; -1: nothing moves it
  std::vector<Tree> trees_;
  std::vector<std::size_t> tied_;  // of a tree: the first of those that equalities tie to it
};

inline Reach::Reach(const mjModel& m) : of_body_(static_cast<std::size_t>(m.nbody), -1), of_dof_(static_cast<std::size_t>(m.nv)) {
  Places places{std::vector<Placed>(of_body_.size()), std::vector<char>(of_body_.size()), std::vector<mjtNum>(of_body_.size())};
  for (int b = 1; b < static_cast<int>(m.nbody); ++b) add_body(m, b, places);
  const TreeRoots roots(m);
  std::vector<std::size_t> first(of_dof_.size(), trees_.size());
  tied_.resize(trees_.size());
  for (int v = 0; v < static_cast<int>(m.nv); ++v) {
    of_dof_[v] = of_body_[m.dof_bodyid[v]];
    std::size_t& of_root = first[roots.root(v)];
    of_root = std::min(of_root, static_cast<std::size_t>(of_dof_[v]));
    tied_[of_dof_[v]] = of_root;
  }
  const std::vector<char> collides = collide(m);
  for (int g = 0; g < static_cast<int>(m.ngeom); ++g) {
    const int tree = of_body_[m.geom_bodyid[g]];
    if (tree < 0 || !collides[g]) continue;
    const mjtNum around = mju_norm3(m.geom_pos + 3 * g) + m.geom_rbound[g] + m.geom_margin[g],
                 far = places.away[m.geom_bodyid[g]] + around;
    trees_[tree].reach = std::max(trees_[tree].reach, far);
    trees_[tree].size = std::max(trees_[tree].size, far);
  }
  for (Tree& tree : trees_)
    if (tree.floats && tree.reach >= 0) tree.reach = std::numeric_limits<mjtNum>::infinity();
}

/// By their kinds, or in pairs that the model names.
inline std::vector<char> Reach::collide(const mjModel& m) {
  std::vector<char> out(static_cast<std::size_t>(m.ngeom));
  for (std::size_t g = 0; g < out.size(); ++g) out[g] = m.geom_contype[g] != 0 || m.geom_conaffinity[g] != 0;
  for (int p = 0; p < static_cast<int>(m.npair); ++p) out[m.pair_geom1[p]] = out[m.pair_geom2[p]] = 1;
  return out;
}

inline void Reach::add_body(const mjModel& m, int body, Places& places) {
  auto& [fixed, moved, away] = places;
  const int parent = m.body_parentid[body];
  of_body_[body] = of_body_[parent];
  moved[body] = moved[parent] || m.body_mocapid[body] >= 0;
  if (of_body_[body] < 0) {
    Placed& here = fixed[body];
    mju_rotVecQuat(here.at.data(), m.body_pos + 3 * body, fixed[parent].turn.data());
    for (int k = 0; k < 3; ++k) here.at[k] += fixed[parent].at[k];
    mju_mulQuat(here.turn.data(), fixed[parent].turn.data(), m.body_quat + 4 * body);
    if (m.body_dofnum[body] == 0) return;
    of_body_[body] = static_cast<int>(trees_.size());
    trees_.push_back({here.at});
    trees_.back().floats = moved[parent] != 0;
  } else {
    away[body] = away[parent] + mju_norm3(m.body_pos + 3 * body);
  }
  for (int j = m.body_jntadr[body]; j >= 0 && j < m.body_jntadr[body] + m.body_jntnum[body]; ++j) {
    Tree& tree = trees_[of_body_[body]];
    away[body] += 2 * mju_norm3(m.jnt_pos + 3 * j);  // a body turns about there
    if (m.jnt_type[j] == mjJNT_FREE || (m.jnt_type[j] == mjJNT_SLIDE && m.jnt_limited[j] == 0)) tree.floats = true;
    if (m.jnt_type[j] == mjJNT_SLIDE && m.jnt_limited[j] != 0)
      away[body] += std::max(std::abs(m.jnt_range[2 * j]), std::abs(m.jnt_range[2 * j + 1]));
  }
}

inline std::vector<std::size_t> Reach::neighbours(std::span<const int> dofs) const {
  std::vector<char> driven(trees_.size());
  for (const int v : dofs) driven[of_dof_[v]] = 1;
  mjtNum between = 0;
  for (std::size_t t = 0; t < trees_.size(); ++t)
    if (!driven[t] && trees_[t].floats) between = std::max(between, 2 * trees_[t].size);
  std::vector<std::size_t> label(trees_.size());
  std::iota(label.begin(), label.end(), std::size_t{0});
  const auto unite = [&label](std::size_t a, std::size_t b) {
    const std::size_t from = std::max(label[a], label[b]), to = std::min(label[a], label[b]);
    if (from != to) std::replace(label.begin(), label.end(), from, to);
  };
  for (std::size_t t = 0; t < trees_.size(); ++t) unite(t, tied_[t]);
  const auto takes_part = [&](std::size_t t) { return trees_[t].reach >= 0 && (driven[t] || !trees_[t].floats); };
  for (std::size_t a = 0; a < trees_.size(); ++a) {
    for (std::size_t b = 0; takes_part(a) && b < a; ++b) {
      if (label[a] == label[b] || !takes_part(b)) continue;
      if (mju_dist3(trees_[a].root.data(), trees_[b].root.data()) <= trees_[a].reach + trees_[b].reach + between) unite(a, b);
    }
  }
  std::vector<std::size_t> out;
  for (const int v : dofs) out.push_back(label[of_dof_[v]]);
  return out;
}

}  // namespace vsa::physics
