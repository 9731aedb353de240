// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which joints of an mjModel move each other: those of one kinematic tree, and those of trees that an equality ties together (a
// closed loop, two arms on one bar). One that is switched off counts, too: it may be switched on, and until then B has zeros there.
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace vsa::physics {

/// For each degree of freedom asked for, one number: equal where they move each other.
class TreeRoots {
 public:
  /// Of a compiled model, which must outlive it.
  explicit TreeRoots(const mjModel& m) : m_(m), root_(static_cast<std::size_t>(m.nv)) {
    std::iota(root_.begin(), root_.end(), 0);
    for (int v = 0; v < m.nv; ++v)
      if (m.dof_parentid[v] >= 0) unite(v, m.dof_parentid[v]);
    for (int e = 0; e < m.neq; ++e) tie(e);
  }
  /// Of a degree of freedom below nv.
  [[nodiscard]] int root(int dof) const noexcept {
    while (root_[static_cast<std::size_t>(dof)] != dof) dof = root_[static_cast<std::size_t>(dof)];
    return dof;
  }

 private:
  void unite(int a, int b) noexcept {
    if (a >= 0 && b >= 0) root_[static_cast<std::size_t>(root(a))] = root(b);
  }
  /// A degree of freedom that moves the body; −1: none does.
  [[nodiscard]] int of_body(int body) const noexcept {
    while (body > 0 && m_.body_dofnum[body] == 0) body = m_.body_parentid[body];
    return body > 0 ? m_.body_dofadr[body] : -1;
  }
  void tie(int e) noexcept {
    const int a = m_.eq_obj1id[e], b = m_.eq_obj2id[e];
    switch (m_.eq_type[e]) {
      case mjEQ_CONNECT:
      case mjEQ_WELD:
        return unite(of_end(e, a), of_end(e, b));
      case mjEQ_JOINT:
        if (b >= 0) unite(m_.jnt_dofadr[a], m_.jnt_dofadr[b]);
        return;
      case mjEQ_TENDON: {
        const int first = tie_tendon(a);
        if (b >= 0) unite(first, tie_tendon(b));
        return;
      }
      default:
        return;
    }
  }
  [[nodiscard]] int of_end(int e, int id) const noexcept {
    if (id < 0) return -1;
#if mjVERSION_HEADER >= 323
    if (m_.eq_objtype[e] == mjOBJ_SITE) return of_body(m_.site_bodyid[id]);
#else
    static_cast<void>(e);
#endif
    return of_body(id);
  }
  /// All that a tendon of fixed length moves; one of them.
  int tie_tendon(int tendon) noexcept {
    int first = -1;
    for (int w = m_.tendon_adr[tendon]; w < m_.tendon_adr[tendon] + m_.tendon_num[tendon]; ++w) {
      const int id = m_.wrap_objid[w];
      int dof = -1;
      if (m_.wrap_type[w] == mjWRAP_JOINT) dof = m_.jnt_dofadr[id];
      if (m_.wrap_type[w] == mjWRAP_SITE) dof = of_body(m_.site_bodyid[id]);
      unite(first, dof);
      first = first >= 0 ? first : dof;
    }
    return first;
  }

  const mjModel& m_;
  std::vector<int> root_;
};

}  // namespace vsa::physics
