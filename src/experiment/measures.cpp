// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "vsa/not_a_number.hpp"

namespace vsa::experiment {
namespace {

constexpr std::size_t kTerms = 4;  // of a cubic

using Vector = std::array<double, kTerms>;
using Matrix = std::array<Vector, kTerms>;

/// Solves m x = b by elimination with pivots; NaN where m is singular.
Vector solve(Matrix m, Vector b) {
  for (std::size_t c = 0; c < kTerms; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < kTerms; ++r) pivot = std::abs(m[r][c]) > std::abs(m[pivot][c]) ? r : pivot;
    std::swap(m[c], m[pivot]);
    std::swap(b[c], b[pivot]);
    constexpr double kSingular = 1e-12;  // entries are of the order of 1
    if (!(std::abs(m[c][c]) > kSingular)) return {kNaN, kNaN, kNaN, kNaN};
    for (std::size_t r = c + 1; r < kTerms; ++r) {
      const double factor = m[r][c] / m[c][c];
      for (std::size_t k = c; k < kTerms; ++k) m[r][k] -= factor * m[c][k];
      b[r] -= factor * b[c];
    }
  }
  for (std::size_t c = kTerms; c-- > 0;) {
    for (std::size_t k = c + 1; k < kTerms; ++k) b[c] -= m[c][k] * b[k];
    b[c] /= m[c][c];
  }
  return b;
}

struct Slope {
  double value = kNaN, variance = kNaN;
};

/// dy/dx at x = 0 of the cubic that fits best; x within about ±1.
Slope fit_slope(const std::vector<double>& x, const std::vector<double>& y) {
  Matrix normal{};
  Vector right{};
  const auto basis = [](double u) { return Vector{1, u, u * u, u * u * u}; };
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vector v = basis(x[i]);
    for (std::size_t r = 0; r < kTerms; ++r) {
      right[r] += v[r] * y[i];
      for (std::size_t c = 0; c < kTerms; ++c) normal[r][c] += v[r] * v[c];
    }
  }
  const Vector coefficient = solve(normal, right);
  double residual = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vector v = basis(x[i]);
    double fitted = 0;
    for (std::size_t c = 0; c < kTerms; ++c) fitted += coefficient[c] * v[c];
    residual += (y[i] - fitted) * (y[i] - fitted);
  }
  const double variance = residual / static_cast<double>(x.size() - kTerms);
  return {coefficient[1], variance * solve(normal, {0, 1, 0, 0})[1]};
}

/// One branch's dτ/dδ at grid point i; NaN where the branch doesn't fill the window.
Slope local_stiffness(const std::vector<double>& torque, const std::vector<double>& deflection, std::size_t i, double half_Nm) {
  constexpr double kSlack = 1e-9;  // of the window: grid values are sums of steps
  std::vector<double> x, y;
  double widest = 0;
  for (std::size_t k = 0; k < torque.size(); ++k) {
    if (std::abs(torque[k] - torque[i]) > half_Nm * (1 + kSlack)) continue;
    x.push_back(deflection[k] - deflection[i]);
    y.push_back(torque[k] - torque[i]);
    if (!std::isfinite(x.back())) return {};
    widest = std::max(widest, std::abs(x.back()));
  }
  if (x.size() <= kTerms || widest == 0) return {};
  for (double& u : x) u /= widest;
  const Slope scaled = fit_slope(x, y);
  return {scaled.value / widest, scaled.variance / (widest * widest)};
}

bool has_width(const Branches& b, std::size_t i) { return std::isfinite(b.falling_rad[i] - b.rising_rad[i]); }

/// At the torques at which the other has a width, too.
Branches shared(const Branches& of, const Branches& other) {
  constexpr double kSame_Nm = 1e-6;
  Branches out;
  for (std::size_t i = 0; i < of.torque_Nm.size(); ++i) {
    bool there = false;
    for (std::size_t k = 0; k < other.torque_Nm.size() && !there; ++k)
      there = std::abs(other.torque_Nm[k] - of.torque_Nm[i]) < kSame_Nm && has_width(other, k);
    if (!there) continue;
    out.torque_Nm.push_back(of.torque_Nm[i]);
    out.rising_rad.push_back(of.rising_rad[i]);
    out.falling_rad.push_back(of.falling_rad[i]);
  }
  return out;
}

double largest_magnitude(const std::vector<double>& v) {
  double out = kNaN;
  for (const double x : v) out = std::isfinite(x) ? std::fmax(out, std::abs(x)) : out;
  return out;
}

}  // namespace

Loop loop(const Branches& branches) {
  std::vector<double> torque, width;
  for (std::size_t i = 0; i < branches.torque_Nm.size(); ++i) {
    const double w = branches.falling_rad[i] - branches.rising_rad[i];
    if (!std::isfinite(w)) continue;
    torque.push_back(branches.torque_Nm[i]);
    width.push_back(w);
  }
  if (width.size() < 2) return {kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
  Loop out;
  for (std::size_t i = 1; i < width.size(); ++i) {
    out.area_Nm_rad += 0.5 * (width[i] + width[i - 1]) * (torque[i] - torque[i - 1]);
  }
  for (const double w : width) {
    out.mean_width_rad += w / static_cast<double>(width.size());
    out.mean_abs_width_rad += std::abs(w) / static_cast<double>(width.size());
  }
  out.largest_width_rad = *std::max_element(width.begin(), width.end());
  out.smallest_width_rad = *std::min_element(width.begin(), width.end());
  out.peak_rising_rad = largest_magnitude(branches.rising_rad);
  out.peak_falling_rad = largest_magnitude(branches.falling_rad);
  return out;
}

std::array<Loop, 2> loops(const Branches& a, const Branches& b) { return {loop(shared(a, b)), loop(shared(b, a))}; }

std::vector<StiffnessPoint> stiffness_curve(const Branches& branches, double window_Nm) {
  std::vector<StiffnessPoint> out;
  if (branches.torque_Nm.empty()) return out;
  const double half = 0.5 * window_Nm, slack = 1e-9 * window_Nm;
  const auto [low, high] = std::minmax_element(branches.torque_Nm.begin(), branches.torque_Nm.end());
  for (std::size_t i = 0; i < branches.torque_Nm.size(); ++i) {
    const double at = branches.torque_Nm[i];
    if (at - half < *low - slack || at + half > *high + slack) continue;
    const Slope rising = local_stiffness(branches.torque_Nm, branches.rising_rad, i, half);
    const Slope falling = local_stiffness(branches.torque_Nm, branches.falling_rad, i, half);
    if (!(rising.value > 0 && falling.value > 0)) continue;
    out.push_back({0.5 * (branches.rising_rad[i] + branches.falling_rad[i]), at, 0.5 * (rising.value + falling.value),
                   0.5 * std::sqrt(rising.variance + falling.variance)});
  }
  return out;
}

}  // namespace vsa::experiment
