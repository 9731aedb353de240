// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What holds the joints of an mjModel besides their actuators, and how they answer to torques then (vsa/device/holder.hpp asks for it):
//   set_stiff(), look()   which trees equalities tie, or any constraint holds, in this step
//   constrain()           all constraints with the forces that d has
//   begin(), changed()    whether other rows hold than at the last try
//   factor(), solve()     B with what holds, the columns of (M + J^T H J)⁻¹
//
// J has the rows that answer in proportion: equalities, limits that are pressed, frictions that stick, contacts that don't slide; H is
// R⁻¹, by which MuJoCo softens them. Those of a contact that slides answer together, by the Hessian of its cone's cost. Where nothing
// slides that is M⁻¹ − M⁻¹ J^T (J M⁻¹ J^T + R)⁻¹ J M⁻¹.
// M is what mj_factorM() takes at the time, so dampers that the integrator takes implicitly may be in it.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "vsa/physics/tied_trees.hpp"

namespace vsa::physics {

/// Of one model; one mjData at a time, whose functions are called in the order above.
class Holding {
 public:
  Holding() = default;  ///< of a model without joints
  /// Of a compiled model.
  explicit Holding(const mjModel& m) : trees_(m) {}
  void reserve(std::size_t rows) { row_.resize(std::max(row_.size(), rows)); }    ///< so that no more allocates later
  void set_stiff(std::span<const int> dofs) noexcept { trees_.set_stiff(dofs); }  ///< as TiedTrees has it
  void look(const mjModel& m, const mjData& d) { trees_.look(m, d); }             ///< as TiedTrees has it
  [[nodiscard]] const TiedTrees& trees() const noexcept { return trees_; }        ///< as look() has found them
  [[nodiscard]] bool tied(int dof) const noexcept { return trees_.tied(dof); }    ///< as TiedTrees has it
  [[nodiscard]] bool held(int dof) const noexcept { return trees_.held(dof); }    ///< as TiedTrees has it

  /// v̇ to qacc, from qfrc_smooth and qacc_smooth; in some versions qacc_warmstart goes along.
  void constrain(const mjModel& m, mjData& d) {
    mj_fwdConstraint(&m, &d);
#if mjVERSION_HEADER >= 333
    if (!trees_.any_stiff() || d.nefc == 0) return;  // solvers of islands leave efc_state as the warm start had it
#else
    if (!trees_.any_stiff() || std::count(d.efc_state, d.efc_state + d.nefc, mjCNSTRSTATE_CONE) == 0) return;
#endif
    // The Hessians of their cones, which not every solver of MuJoCo's leaves behind.
    reserve(static_cast<std::size_t>(d.nefc));
    mj_mulJacVec(&m, &d, row_.data(), d.qacc);
    for (int r = 0; r < d.nefc; ++r) row_[r] -= d.efc_aref[r];
    mj_constraintUpdate(&m, &d, row_.data(), nullptr, 1);
    std::fill_n(row_.begin(), d.nefc, 0.0);
  }
  /// After constrain() with the torques of the last step.
  void begin(const mjData& d) {
    note(d, at_first_);
    tried_ = -1;
  }
  /// After constrain() with torques of a tree, by any of its degrees of freedom: whether other rows hold than at its last try (begin(),
  /// where there was none), or what holds answers not in proportion.
  [[nodiscard]] bool changed(const mjData& d, int dof) {
    if (tried_ != dof) now_ = at_first_;
    tried_ = dof;
    std::swap(now_, before_);
    note(d, now_);
    return now_ != before_ || std::count(now_.begin(), now_.end(), static_cast<char>(mjCNSTRSTATE_CONE)) > 0;
  }
  /// M + J^T H J, factored, of the rows of constrain(). False: there is no such row on trees that are tied.
  [[nodiscard]] bool factor(const mjModel& m, mjData& d);
  /// x = (M + J^T H J)⁻¹ y, after factor(); nv numbers.
  void solve(std::span<mjtNum> x, std::span<const mjtNum> y) const {
    mju_cholSolve(x.data(), sum_.data(), y.data(), static_cast<int>(y.size()));
  }

 private:
  [[nodiscard]] static bool answers(const mjData& d, int row) noexcept {
    return row < d.ne || d.efc_state[row] == mjCNSTRSTATE_QUADRATIC;
  }
  [[nodiscard]] static bool slides(const mjData& d, int row) noexcept {
    return row >= d.ne && d.efc_state[row] == mjCNSTRSTATE_CONE;
  }
  void note(const mjData& d, std::vector<char>& out) const {
    out.clear();
    for (int r = 0; trees_.any_stiff() && r < d.nefc; ++r) out.push_back(static_cast<char>(d.efc_state[r]));
  }
  /// A contact's k-th row in jacobian_.
  [[nodiscard]] mjtNum* acting_on(const mjModel& m, int k) {
    return &jacobian_[static_cast<std::size_t>(k) * static_cast<std::size_t>(m.nv)];
  }
  [[nodiscard]] int find_acting_on(const mjModel& m, mjData& d, int row, int count);
  void take_mass(const mjModel& m, mjData& d);

  TiedTrees trees_;
  std::vector<char> at_first_, before_, now_;  // states of rows
  int tried_ = -1;                             // degree of freedom
  std::vector<mjtNum> row_;                    // zeros
  std::vector<mjtNum> jacobian_, sum_, unit_;  // of a contact's rows at most; M + J^T H J, factored; scratch
};

/// J of so many rows to jacobian_. Returns the first degree of freedom that they act on, nv: none.
inline int Holding::find_acting_on(const mjModel& m, mjData& d, int row, int count) {
  const int nv = static_cast<int>(m.nv);
  int first = nv;
  for (int k = 0; k < count; ++k) {
    mjtNum* const acts_on = acting_on(m, k);
    row_[row + k] = 1;
    mj_mulJacTVec(&m, &d, acts_on, row_.data());
    row_[row + k] = 0;
    first = std::min(first, static_cast<int>(std::find_if(acts_on, acts_on + nv, [](mjtNum x) { return x != 0; }) - acts_on));
  }
  return first;
}

/// M to sum_.
inline void Holding::take_mass(const mjModel& m, mjData& d) {
  const auto nv = static_cast<std::size_t>(m.nv);
  sum_.resize(nv * nv);
  unit_.assign(nv, 0);
  for (std::size_t i = 0; i < nv; ++i) {
    unit_[i] = 1;
    mj_mulM(&m, &d, &sum_[i * nv], unit_.data());
    unit_[i] = 0;
  }
}

inline bool Holding::factor(const mjModel& m, mjData& d) {
  constexpr std::size_t kMostRows = 6;  // of a contact
  const int nv = static_cast<int>(m.nv), rows = trees_.any_stiff() ? d.nefc : d.ne;
  const auto size = static_cast<std::size_t>(nv);
  reserve(static_cast<std::size_t>(d.nefc));
  jacobian_.resize(kMostRows * size);
  bool any = false;
  for (int r = 0, count = 1; r < rows; r += count) {
    count = slides(d, r) ? d.contact[d.efc_id[r]].dim : 1;
    if (!answers(d, r) && !slides(d, r)) continue;
    const int first = find_acting_on(m, d, r, count);
    if (first == nv || (r >= d.ne && !trees_.held(first))) continue;
    if (!any) {
      any = true;
      take_mass(m, d);
    }
    for (int k = 0; k < count; ++k) {
      for (int l = 0; l < count; ++l) {
        const mjtNum h = slides(d, r) ? d.contact[d.efc_id[r]].H[k * count + l] : 1 / d.efc_R[r];
        const mjtNum *const left = acting_on(m, k), *const right = acting_on(m, l);
        for (int i = first; i < nv; ++i)
          for (int j = first; left[i] != 0 && j < nv; ++j) sum_[static_cast<std::size_t>(i) * size + j] += h * left[i] * right[j];
      }
    }
  }
  if (any) mju_cholFactor(sum_.data(), nv, mjMINVAL);
  return any;
}

}  // namespace vsa::physics
