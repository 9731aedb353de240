// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which kinematic trees equalities act on in this step: those with a number in an equality's row, and those that touch one of them; and
// which are held: likewise, of any row of constraints that has a number of a stiff tree. Others move as if there were neither.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

namespace vsa::physics {

class TiedTrees {
 public:
  TiedTrees() = default;
  explicit TiedTrees(const mjModel& m);
  /// Which are stiff from now on, by a degree of freedom of each.
  void set_stiff(std::span<const int> dofs) noexcept;
  /// After mj_fwdPosition.
  void look(const mjModel& m, const mjData& d);
  [[nodiscard]] bool tied(int dof) const noexcept { return any_ && tied_[static_cast<std::size_t>(tree(dof))] != kFree; }
  [[nodiscard]] bool held(int dof) const noexcept { return any_ && tied_[static_cast<std::size_t>(tree(dof))] == kHeld; }
  /// By its first degree of freedom.
  [[nodiscard]] int tree(int dof) const noexcept { return tree_[static_cast<std::size_t>(dof)]; }

 private:
  enum How : char { kFree, kTied, kHeld };

  bool any_ = false, any_stiff_ = false;
  std::vector<int> tree_, of_body_;  ///< of a degree of freedom; of a body, −1: nothing moves it
  std::vector<How> tied_;            ///< by tree()
  std::vector<char> stiff_;          ///< by tree()
};

}  // namespace vsa::physics
