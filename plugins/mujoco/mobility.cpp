// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "mobility.hpp"

#include <algorithm>
#include <functional>

#include "versions.hpp"

namespace vsa::mujoco {

Mobility::Mobility(const mjModel& m)
    : holding_(m),
      unit_(static_cast<std::size_t>(m.nv)),
      column_(unit_.size()),
      force_(unit_.size()),
      as_before_(unit_.size()),
      tried_(unit_.size()) {}

/// MuJoCo steps v' = v + dt·(M + dt·D)⁻¹ f with the joints' damping D: works where mj_solveM() solves with that matrix.
template <class Work>
void Mobility::with_dampers(const mjModel& m, mjData& d, Work&& work) {
  if (!damps_implicitly(m)) return work();
  const std::span<mjtNum> mass = mass_numbers(m, d);
  mass_.assign(mass.begin(), mass.end());
  for (int i = 0; i < static_cast<int>(m.nv); ++i) mass_of_dof(m, d, i) += m.opt.timestep * m.dof_damping[i];
  mj_factorM(&m, &d);
  work();
  std::copy(mass_.begin(), mass_.end(), mass.begin());
  mj_factorM(&m, &d);
}

void Mobility::solve(const mjModel& m, mjData& d) { mj_solveM(&m, &d, column_.data(), unit_.data(), 1); }

void Mobility::look(const mjModel& m, const mjData& d, std::span<const int> stiff) {
  holding_.set_stiff(stiff);
  holding_.look(m, d);
  any_tied_ = false;
  for (int v = 0; v < static_cast<int>(m.nv); ++v) any_tied_ = any_tied_ || holding_.tied(v);
}

void Mobility::of(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out) {
  with_dampers(m, d, [&] {
    const std::size_t n = dofs.size();
    const bool tied = std::any_of(dofs.begin(), dofs.end(), [&](int v) { return holding_.tied(v); }) && holding_.factor(m, d);
    for (std::size_t i = 0; i < n; ++i) {
      unit_[static_cast<std::size_t>(dofs[i])] = 1;
      if (tied) {
        holding_.solve(column_, unit_);
      } else {
        solve(m, d);
      }
      unit_[static_cast<std::size_t>(dofs[i])] = 0;
      for (std::size_t k = 0; k < n; ++k) out[i * n + k] = column_[static_cast<std::size_t>(dofs[k])];
    }
    for (std::size_t i = 0; tied && i < n; ++i)
      for (std::size_t k = 0; k < i; ++k) out[k * n + i] = out[i * n + k];
  });
}

void Mobility::of_each(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out) {
  with_dampers(m, d, [&] {
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      const auto v = static_cast<std::size_t>(dofs[i]);
      unit_[v] = 1;
      solve(m, d);
      unit_[v] = 0;
      out[i] = column_[v];
    }
  });
}

/// force_ with all constraints: their forces to qfrc_constraint, which MuJoCo works out with M, taking dampers implicitly after that. All
/// that this changes MuJoCo works out anew in this step.
void Mobility::constrain(const mjModel& m, mjData& d) {
  std::copy(force_.begin(), force_.end(), d.qfrc_smooth);
  mj_solveM(&m, &d, d.qacc_smooth, d.qfrc_smooth, 1);
  holding_.constrain(m, d);
}

std::span<const double> Mobility::foresee(const mjModel& m, mjData& d, Pushed pushed) {
  const auto nv = static_cast<std::size_t>(m.nv);
  for (std::size_t v = 0; v < nv; ++v) as_before_[v] = d.qfrc_passive[v] - d.qfrc_bias[v] + pushed.forces[v];
  force_ = tried_ = as_before_;
  if (any_tied_) {
    constrain(m, d);
    holding_.begin(d);
  }
  for (int v = 0; v < static_cast<int>(m.nv); ++v) {
    if (holding_.tied(v)) {
      force_[v] += d.qfrc_constraint[v];
    } else if (!holding_.trees().stiff(v)) {  // what held a stiff one in the last step has let go
      force_[v] += pushed.constraints[v];
    }
  }
  accelerate(m, d);
  return column_;
}

/// column_: what force_ does.
void Mobility::accelerate(const mjModel& m, mjData& d) {
  with_dampers(m, d, [&] { mj_solveM(&m, &d, column_.data(), force_.data(), 1); });
}

bool Mobility::holds_else(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<const double> more,
                          std::span<double> accelerations, std::span<double> mobility) {
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto v = static_cast<std::size_t>(dofs[i]);
    tried_[v] = as_before_[v] + more[i];
  }
  force_ = tried_;
  constrain(m, d);
  if (!holding_.changed(d, dofs.front()) && !damps_implicitly(m)) return false;
  std::transform(force_.begin(), force_.end(), d.qfrc_constraint, force_.begin(), std::plus<>());
  accelerate(m, d);
  for (std::size_t i = 0; i < dofs.size(); ++i) accelerations[i] = column_[static_cast<std::size_t>(dofs[i])];
  of(m, d, dofs, mobility);
  return true;
}

void Mobility::push(const mjModel& m, const mjData& d, Pushed out) {
  for (std::size_t v = 0; v < static_cast<std::size_t>(m.nv); ++v) {
    out.forces[v] = d.qfrc_smooth[v] - d.qfrc_passive[v] + d.qfrc_bias[v];
    out.constraints[v] = d.qfrc_constraint[v];
  }
}

}  // namespace vsa::mujoco
