// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "mobility.hpp"

#include <algorithm>

#include "versions.hpp"

namespace vsa::mujoco {

void Mobility::of(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out) {
  const auto nv = static_cast<std::size_t>(m.nv);
  unit_.assign(nv, 0);
  column_.resize(nv);
  damped_ = damps_implicitly(m);
  if (damped_) factor_damped(m, d);
  const std::size_t n = dofs.size();
  for (std::size_t i = 0; i < n; ++i) {
    unit_[static_cast<std::size_t>(dofs[i])] = 1;
    solve(m, d);
    unit_[static_cast<std::size_t>(dofs[i])] = 0;
    for (std::size_t k = 0; k < n; ++k) out[i * n + k] = column_[static_cast<std::size_t>(dofs[k])];
  }
  tie(m, d, dofs, out);
}

void Mobility::factor_damped(const mjModel& m, const mjData& d) {
  const auto nv = static_cast<std::size_t>(m.nv);
  factor_.resize(nv * nv);
  mass_matrix(m, d, factor_);
  for (std::size_t i = 0; i < nv; ++i) factor_[i * nv + i] += m.opt.timestep * m.dof_damping[i];
  mju_cholFactor(factor_.data(), static_cast<int>(nv), mjMINVAL);
}

void Mobility::solve(const mjModel& m, mjData& d) {
  if (damped_) {
    mju_cholSolve(column_.data(), factor_.data(), unit_.data(), static_cast<int>(m.nv));
  } else {
    mj_solveM(&m, &d, column_.data(), unit_.data(), 1);
  }
}

void Mobility::tie(const mjModel& m, mjData& d, std::span<const int> dofs, std::span<double> out) {
  const auto rows = static_cast<std::size_t>(d.ne), nv = static_cast<std::size_t>(m.nv), n = dofs.size();
  if (rows == 0) return;
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

}  // namespace vsa::mujoco
