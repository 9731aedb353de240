// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "identify/error_model.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::identify {
namespace {

constexpr double kMostRho = 0.97;

/// Sums of r_j² and of r_j r_{j+1} of each recording.
struct Moments {
  std::vector<double> square, product;
};

Moments found(const std::vector<Segment>& all, std::size_t observations, const Eigen::VectorXd& r) {
  Moments m{std::vector<double>(observations, 0.0), std::vector<double>(observations, 0.0)};
  for (const Segment& s : all) {
    for (std::size_t i = s.first; i < s.last; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      m.square[s.observation] += r[k] * r[k];
      if (i + 1 < s.last) m.product[s.observation] += r[k] * r[k + 1];
    }
  }
  return m;
}

/// The same sums of M Σ Mᵀ, M = 1 − J G Jᵀ, without forming it.
Moments expected(const std::vector<Segment>& all, const std::vector<Point>& points, const ErrorModel& e, const Eigen::MatrixXd& j,
                 const Eigen::MatrixXd& g) {
  const Eigen::MatrixXd h = j * g;               // H = h Jᵀ
  const Eigen::MatrixXd a = e.apply(points, j);  // Σ J
  const Eigen::MatrixXd inner = h * (j.transpose() * a);
  const auto entry = [&](Eigen::Index p, Eigen::Index q, double sigma) {
    return sigma - h.row(p).dot(a.row(q)) - a.row(p).dot(h.row(q)) + inner.row(p).dot(h.row(q));
  };
  Moments m{std::vector<double>(e.sd.size(), 0.0), std::vector<double>(e.sd.size(), 0.0)};
  for (const Segment& s : all) {
    const double variance = e.sd[s.observation] * e.sd[s.observation];
    for (std::size_t i = s.first; i < s.last; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      m.square[s.observation] += entry(k, k, variance);
      if (i + 1 == s.last) continue;
      const double gap = static_cast<double>(points[i + 1].grid - points[i].grid);
      m.product[s.observation] += entry(k, k + 1, variance * std::pow(e.rho[s.observation], gap));
    }
  }
  return m;
}

double ratio(double a, double b) { return b > 0 ? a / b : 0.0; }

}  // namespace

std::vector<Segment> segments(const std::vector<Point>& points) {
  std::vector<Segment> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool same = i > 0 && points[i].observation == points[i - 1].observation && points[i].rising == points[i - 1].rising;
    if (same) {
      out.back().last = i + 1;
    } else {
      out.push_back({i, i + 1, points[i].observation});
    }
  }
  return out;
}

Eigen::MatrixXd ErrorModel::apply(const std::vector<Point>& points, const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  for (const Segment& s : segments(points)) {
    const double variance = sd[s.observation] * sd[s.observation];
    for (std::size_t i = s.first; i < s.last; ++i) {
      for (std::size_t k = s.first; k < s.last; ++k) {
        const double gap = std::abs(static_cast<double>(points[i].grid) - static_cast<double>(points[k].grid));
        out.row(static_cast<Eigen::Index>(i)) += variance * std::pow(rho[s.observation], gap) * x.row(static_cast<Eigen::Index>(k));
      }
    }
  }
  return out;
}

double ErrorModel::effective_samples() const {
  double sum = 0;
  for (std::size_t o = 0; o < rho.size(); ++o) sum += samples[o] * (1 - rho[o]) / (1 + rho[o]);
  return sum;
}

ErrorModel error_model(const std::vector<Point>& points, std::size_t observations, const Eigen::VectorXd& residuals,
                       const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& inverse) {
  constexpr int kRounds = 60;
  constexpr double kClose = 1e-9;
  const std::vector<Segment> all = segments(points);
  const Moments target = found(all, observations, residuals);
  ErrorModel e{std::vector<double>(observations), std::vector<double>(observations), std::vector<double>(observations, 0.0)};
  for (const Segment& s : all) e.samples[s.observation] += static_cast<double>(s.last - s.first);
  for (std::size_t o = 0; o < observations; ++o) {
    e.sd[o] = std::sqrt(target.square[o] / e.samples[o]);
    e.rho[o] = std::clamp(ratio(target.product[o], target.square[o]), 0.0, kMostRho);
  }
  for (int round = 0; round < kRounds; ++round) {
    const Moments now = expected(all, points, e, jacobian, inverse);
    double change = 0;
    for (std::size_t o = 0; o < observations; ++o) {
      const double missing = ratio(target.product[o], target.square[o]) - ratio(now.product[o], now.square[o]);
      const double rho = std::clamp(e.rho[o] + 0.5 * missing, 0.0, kMostRho);
      change = std::max(change, std::abs(rho - e.rho[o]));
      e.rho[o] = rho;
      if (now.square[o] > 0) e.sd[o] *= std::sqrt(target.square[o] / now.square[o]);
    }
    if (change < kClose) break;
  }
  return e;
}

}  // namespace vsa::identify
