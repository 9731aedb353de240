// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which kinematic trees equalities act on in this step, or all constraints: those with a number in such a row, and those that touch one of
// them. Others move as if there were none.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace vsa::physics {

class TiedTrees {
 public:
  TiedTrees() = default;
  explicit TiedTrees(const mjModel& m);
  /// After mj_fwdPosition. `all`: not equalities alone.
  void look(const mjModel& m, const mjData& d, bool all);
  [[nodiscard]] bool of_all() const noexcept { return all_; }
  [[nodiscard]] bool tied(int dof) const noexcept { return any_ && tied_[static_cast<std::size_t>(tree(dof))] != 0; }
  /// By its first degree of freedom.
  [[nodiscard]] int tree(int dof) const noexcept { return tree_[static_cast<std::size_t>(dof)]; }

 private:
  bool any_ = false, all_ = false;
  std::vector<int> tree_, of_body_;  ///< of a degree of freedom; of a body, −1: nothing moves it
  std::vector<char> tied_;           ///< by tree()
};

}  // namespace vsa::physics
