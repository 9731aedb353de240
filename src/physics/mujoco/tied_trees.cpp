// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/tied_trees.hpp"

#include <algorithm>

namespace vsa::physics {

TiedTrees::TiedTrees(const mjModel& m)
    : tree_(static_cast<std::size_t>(m.nv)),
      of_body_(static_cast<std::size_t>(m.nbody), -1),
      tied_(tree_.size()),
      stiff_(tree_.size()) {
  for (int v = 0; v < m.nv; ++v) tree_[v] = m.dof_parentid[v] < 0 ? v : tree_[m.dof_parentid[v]];
  for (int b = 1; b < m.nbody; ++b) of_body_[b] = m.body_dofnum[b] > 0 ? tree_[m.body_dofadr[b]] : of_body_[m.body_parentid[b]];
}

void TiedTrees::set_stiff(std::span<const int> dofs) noexcept {
  if (any_stiff_) std::fill(stiff_.begin(), stiff_.end(), 0);
  any_stiff_ = !dofs.empty();
  for (const int v : dofs) stiff_[tree(v)] = 1;
}

void TiedTrees::look(const mjModel& m, const mjData& d) {
  const int rows = any_stiff_ ? d.nefc : d.ne;
  any_ = rows > 0;
  if (!any_) return;
  std::fill(tied_.begin(), tied_.end(), kFree);
  const bool sparse = mj_isSparse(&m) != 0;
  const auto each_tree = [&](int row, auto&& visit) {
    const int count = sparse ? d.efc_J_rownnz[row] : m.nv, first = sparse ? d.efc_J_rowadr[row] : row * m.nv;
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
