// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which kinematic trees equalities act on in this step: those with a number in an equality's row, and those that touch one of them; and
// which are held: likewise, of any row of constraints that has a number of a stiff tree. Others move as if there were neither.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace vsa::physics {

/// Of one model; the rows of one mjData at a time.
class TiedTrees {
 public:
  TiedTrees() = default;  ///< of a model without joints
  /// Of a compiled model; none of its trees is stiff.
  explicit TiedTrees(const mjModel& m)
      : tree_(static_cast<std::size_t>(m.nv)),
        of_body_(static_cast<std::size_t>(m.nbody), -1),
        tied_(tree_.size()),
        stiff_(tree_.size()) {
    for (int v = 0; v < m.nv; ++v) tree_[v] = m.dof_parentid[v] < 0 ? v : tree_[m.dof_parentid[v]];
    for (int b = 1; b < m.nbody; ++b) of_body_[b] = m.body_dofnum[b] > 0 ? tree_[m.body_dofadr[b]] : of_body_[m.body_parentid[b]];
  }
  /// Which are stiff from now on, by a degree of freedom of each, below nv.
  void set_stiff(std::span<const int> dofs) noexcept {
    if (any_stiff_) std::fill(stiff_.begin(), stiff_.end(), 0);
    any_stiff_ = !dofs.empty();
    for (const int v : dofs) stiff_[tree(v)] = 1;
  }
  [[nodiscard]] bool any_stiff() const noexcept { return any_stiff_; }                               ///< by set_stiff()
  [[nodiscard]] bool stiff(int dof) const noexcept { return any_stiff_ && stiff_[tree(dof)] != 0; }  ///< likewise
  /// After mj_fwdPosition.
  void look(const mjModel& m, const mjData& d);
  /// By a degree of freedom below nv, as look() has found it: whether equalities act on its tree, or anything on a stiff one.
  [[nodiscard]] bool tied(int dof) const noexcept { return any_ && tied_[static_cast<std::size_t>(tree(dof))] != kFree; }
  /// Likewise, whether anything may hold it, stiff or in touch with a stiff one.
  [[nodiscard]] bool held(int dof) const noexcept { return any_ && tied_[static_cast<std::size_t>(tree(dof))] == kHeld; }
  /// By its first degree of freedom.
  [[nodiscard]] int tree(int dof) const noexcept { return tree_[static_cast<std::size_t>(dof)]; }

 private:
  enum How : char { kFree, kTied, kHeld };

  bool any_ = false, any_stiff_ = false;
  std::vector<int> tree_, of_body_;  // of a degree of freedom; of a body, −1: nothing moves it
  std::vector<How> tied_;            // by tree()
  std::vector<char> stiff_;          // by tree()
};

inline void TiedTrees::look(const mjModel& m, const mjData& d) {
  const int rows = any_stiff_ ? d.nefc : d.ne;
  any_ = rows > 0;
  if (!any_) return;
  std::fill(tied_.begin(), tied_.end(), kFree);
  const bool sparse = mj_isSparse(&m) != 0;
  const auto each_tree = [&](int row, auto&& visit) {
    const int count = sparse ? d.efc_J_rownnz[row] : static_cast<int>(m.nv),
              first = sparse ? d.efc_J_rowadr[row] : row * static_cast<int>(m.nv);
    for (int k = first; k < first + count; ++k)
      if (d.efc_J[k] != 0) visit(tree(sparse ? d.efc_J_colind[k] : k - first));
  };
  for (int r = 0; r < rows; ++r) {
    How how = r < d.ne ? kTied : kFree;
    each_tree(r, [&](int tree) { how = stiff_[tree] != 0 ? kHeld : how; });
    each_tree(r, [&](int tree) { tied_[tree] = std::max(tied_[tree], how); });
  }
  const auto tree_of = [&](int geom) { return geom < 0 ? -1 : of_body_[m.geom_bodyid[geom]]; };
  for (bool more = true; more;) {
    more = false;
    for (int i = 0; i < d.ncon; ++i) {
      const int a = tree_of(d.contact[i].geom1), b = tree_of(d.contact[i].geom2);
      if (a < 0 || b < 0 || tied_[a] == tied_[b]) continue;
      tied_[a] = tied_[b] = std::max(tied_[a], tied_[b]);
      more = true;
    }
  }
}

}  // namespace vsa::physics
