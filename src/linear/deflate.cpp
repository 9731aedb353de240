// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linear/deflate.hpp"

#include <cmath>

namespace vsa::linear {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Powers of two d for which D⁻¹AD has rows and columns of one size (Parlett and Reinsch, 1969): exact.
VectorXd balance(MatrixXd& a) {
  constexpr int kRounds = 100;
  const Index n = a.rows();
  VectorXd d = VectorXd::Ones(n);
  bool done = false;
  for (int round = 0; round < kRounds && !done; ++round) {
    done = true;
    for (Index i = 0; i < n; ++i) {
      const double own = std::abs(a(i, i)), column = a.col(i).lpNorm<1>() - own, row = a.row(i).lpNorm<1>() - own;
      if (!(column > 0) || !(row > 0) || !std::isfinite(column) || !std::isfinite(row)) continue;
      const double f = std::exp2(std::round(std::log2(row / column) / 2));
      if (!(column * f + row / f < 0.95 * (column + row))) continue;
      done = false;
      d[i] *= f;
      a.col(i) *= f;
      a.row(i) /= f;
    }
  }
  return d;
}

/// One round: what is left, and how it goes together with what was taken out.
struct Level {
  MatrixXd kept, null, coupling;  // V₁, V₂, C
};

std::vector<Level> take_zeros(MatrixXd& b, double noise) {
  std::vector<Level> out;
  const double tolerance = noise * b.norm();
  while (b.rows() > 0) {
    const Eigen::BDCSVD<MatrixXd> svd(b, Eigen::ComputeFullV);
    Index rank = 0;
    while (rank < b.rows() && svd.singularValues()[rank] > tolerance) ++rank;
    if (rank == b.rows()) break;
    Level level{svd.matrixV().leftCols(rank), svd.matrixV().rightCols(b.rows() - rank), {}};
    const MatrixXd pushed = b * level.kept;
    level.coupling = level.null.transpose() * pushed;
    b = level.kept.transpose() * pushed;
    out.push_back(std::move(level));
  }
  return out;
}

/// Of the whole matrix, from a vector of what was left after `levels` of them. 0: one that the matrix turns into an eigenvector of 0
/// in as many rounds.
MatrixXcd lift(const std::vector<Level>& all, std::size_t levels, MatrixXcd x, std::complex<double> value) {
  for (std::size_t k = levels; k-- > 0;) {
    MatrixXcd out = all[k].kept * x;
    if (value != 0.0) out += all[k].null * (all[k].coupling * x) / value;
    x = std::move(out);
  }
  return x;
}

}  // namespace

Spectrum spectrum(const MatrixXd& a, double noise) {
  MatrixXd scaled = a;
  const VectorXd d = balance(scaled);
  MatrixXd left = scaled;
  const std::vector<Level> levels = take_zeros(left, noise);
  Spectrum out;
  const Index n = a.rows();
  out.values = VectorXcd::Zero(n);
  out.vectors = MatrixXcd::Zero(n, n);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    MatrixXcd x = lift(levels, k, levels[k].null.cast<std::complex<double>>(), 0.0);
    for (std::size_t i = 0; i < k; ++i) x = scaled * x;
    if (k > 0) x = levels[0].null * (levels[0].null.transpose() * x);  // there already, but for rounding
    out.vectors.middleCols(out.zeros, x.cols()) = x;
    out.zeros += x.cols();
  }
  if (left.rows() > 0) {
    const Eigen::EigenSolver<MatrixXd> solver(left);
    out.values.tail(left.rows()) = solver.eigenvalues();
    const MatrixXcd vectors = solver.eigenvectors();
    for (Index i = 0; i < left.rows(); ++i)
      out.vectors.col(out.zeros + i) = lift(levels, levels.size(), vectors.col(i), solver.eigenvalues()[i]);
  }
  out.vectors = d.asDiagonal() * out.vectors;
  out.vectors.colwise().normalize();
  return out;
}

}  // namespace vsa::linear
