// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "mobility.hpp"

#include <algorithm>
#include <functional>

#include "versions.hpp"

namespace vsa::mujoco {

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

void Mobility::of(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out) {
  with_dampers(m, d, [&] {
    const auto nv = static_cast<std::size_t>(m.nv);
    unit_.assign(nv, 0);
    column_.resize(nv);
    const std::size_t n = dofs.size();
    for (std::size_t i = 0; i < n; ++i) {
      unit_[static_cast<std::size_t>(dofs[i])] = 1;
      solve(m, d);
      unit_[static_cast<std::size_t>(dofs[i])] = 0;
      for (std::size_t k = 0; k < n; ++k) out[i * n + k] = column_[static_cast<std::size_t>(dofs[k])];
    }
    tie(m, d, dofs, out);
  });
}

void Mobility::solve(const mjModel& m, mjData& d) { mj_solveM(&m, &d, column_.data(), unit_.data(), 1); }

/// tied_ := M⁻¹ Jᵀ by rows, ties_ := the factor of J M⁻¹ Jᵀ + R; M as solve() has it.
void Mobility::factor_ties(const mjModel& m, mjData& d) {
  const auto rows = static_cast<std::size_t>(d.ne), nv = static_cast<std::size_t>(m.nv);
  row_.assign(static_cast<std::size_t>(d.nefc), 0);
  moved_.resize(row_.size());
  tied_.resize(rows * nv);
  ties_.resize(rows * rows);
  of_joint_.resize(2 * rows);
  for (std::size_t r = 0; r < rows; ++r) {
    row_[r] = 1;
    mj_mulJacTVec(&m, &d, unit_.data(), row_.data());
    row_[r] = 0;
    solve(m, d);
    std::copy(column_.begin(), column_.end(), &tied_[r * nv]);
    mj_mulJacVec(&m, &d, moved_.data(), column_.data());
    std::copy_n(moved_.begin(), rows, &ties_[r * rows]);
    ties_[r * rows + r] += d.efc_R[r];
  }
  mju_cholFactor(ties_.data(), static_cast<int>(rows), mjMINVAL);
}

void Mobility::tie(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out) {
  const auto rows = static_cast<std::size_t>(d.ne), nv = static_cast<std::size_t>(m.nv), n = dofs.size();
  if (rows == 0) return;
  factor_ties(m, d);
  double *const x = of_joint_.data(), *const y = x + rows;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = 0; r < rows; ++r) x[r] = tied_[r * nv + static_cast<std::size_t>(dofs[i])];
    mju_cholSolve(y, ties_.data(), x, static_cast<int>(rows));
    for (std::size_t k = 0; k <= i; ++k) {
      double sum = 0;
      for (std::size_t r = 0; r < rows; ++r) sum += tied_[r * nv + static_cast<std::size_t>(dofs[k])] * y[r];
      out[i * n + k] -= sum;
      if (k < i) out[k * n + i] -= sum;
    }
  }
}

std::span<const double> Mobility::foresee(const mjModel& m, mjData& d, std::span<const double> pushed) {
  const auto rows = static_cast<std::size_t>(d.ne), nv = static_cast<std::size_t>(m.nv);
  unit_.resize(nv);
  column_.resize(nv);
  force_.resize(nv);
  for (std::size_t i = 0; i < nv; ++i) force_[i] = d.qfrc_passive[i] - d.qfrc_bias[i] + pushed[i];
  if (rows > 0) {  // MuJoCo works constraints out with M, and takes dampers implicitly after that
    factor_ties(m, d);
    unit_ = force_;
    solve(m, d);
    mj_mulJacVec(&m, &d, moved_.data(), column_.data());
    double *const x = of_joint_.data(), *const f = x + rows;
    for (std::size_t r = 0; r < rows; ++r) x[r] = d.efc_aref[r] - moved_[r];
    mju_cholSolve(f, ties_.data(), x, static_cast<int>(rows));
    std::copy_n(f, rows, row_.begin());
    mj_mulJacTVec(&m, &d, unit_.data(), row_.data());
    std::transform(force_.begin(), force_.end(), unit_.begin(), force_.begin(), std::plus<>());
  }
  unit_ = force_;
  with_dampers(m, d, [&] { solve(m, d); });
  return column_;
}

void Mobility::push(const mjModel& m, mjData& d, std::span<double> out) {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = d.qfrc_smooth[i] - d.qfrc_passive[i] + d.qfrc_bias[i] + d.qfrc_constraint[i];
  if (d.ne == 0) return;
  row_.assign(static_cast<std::size_t>(d.nefc), 0);
  std::copy_n(d.efc_force, d.ne, row_.begin());
  unit_.resize(out.size());
  mj_mulJacTVec(&m, &d, unit_.data(), row_.data());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= unit_[i];
}

}  // namespace vsa::mujoco
