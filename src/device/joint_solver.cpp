// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/joint_solver.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/device/unit.hpp"

namespace vsa::device {
namespace {

/// A guess may lie where the spring's exponential law has no numbers left, so it goes no further than this at once.
constexpr double kReach_rad = 0.25;
/// A step along which the slope still has this part of what it had, with the other sign, went too far. Where a friction begins or
/// ends to slide Newton can go to and fro, so after some rounds less is allowed.
constexpr double kOvershoot = 0.9, kOvershootLater = 0.3;
constexpr int kEarly = 8;

/// A = L D Lᵀ in place, lower triangle by rows: L below the diagonal, 1/D on it. False: not positive definite.
bool factor(std::span<double> a, std::size_t n) noexcept {
  for (std::size_t j = 0; j < n; ++j) {
    double* const row_j = &a[j * n];
    double pivot = row_j[j];
    for (std::size_t k = 0; k < j; ++k) {
      const double l = row_j[k] * a[k * n + k];  // row_j holds L·D so far
      pivot -= l * row_j[k];
      row_j[k] = l;
    }
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    row_j[j] = 1.0 / pivot;
    for (std::size_t i = j + 1; i < n; ++i) {
      double* const row_i = &a[i * n];
      double sum = row_i[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row_i[k] * row_j[k];
      row_i[j] = sum;
    }
  }
  return true;
}

/// Solves with that factor, in place.
void substitute(std::span<const double> a, std::size_t n, std::span<double> x) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    double sum = x[i];
    for (std::size_t k = 0; k < i; ++k) sum -= a[i * n + k] * x[k];
    x[i] = sum;
  }
  for (std::size_t i = 0; i < n; ++i) x[i] *= a[i * n + i];
  for (std::size_t i = n; i-- > 1;) {
    const double xi = x[i];
    for (std::size_t k = 0; k < i; ++k) x[k] -= a[i * n + k] * xi;
  }
}

}  // namespace

JointSolver::JointSolver(std::size_t joints)
    : n_(joints),
      mobility_(joints * joints),
      inertia_(joints * joints),
      work_(joints * joints),
      dy_(joints),
      off_(joints),
      move_(joints),
      gradient_(joints),
      torque_(joints),
      slope_(joints) {}

void JointSolver::set(std::span<const double> mobility, std::int64_t dt_ns) noexcept {
  if (dt_ns == dt_ns_ && std::equal(mobility.begin(), mobility.end(), mobility_.begin())) return;
  dt_ns_ = dt_ns;
  std::copy(mobility.begin(), mobility.end(), mobility_.begin());
  factor_mobility();
}

void JointSolver::factor_mobility() noexcept {
  const double dt = static_cast<double>(dt_ns_) * 1e-9, scale = 2.0 / (dt * dt);
  std::fill(inertia_.begin(), inertia_.end(), 0.0);
  coupled_ = false;
  if (n_ > 1) {
    std::copy(mobility_.begin(), mobility_.end(), work_.begin());
    coupled_ = factor(work_, n_);
  }
  for (std::size_t j = 0; j < n_; ++j) {
    if (!coupled_) {
      const double b = mobility_[j * n_ + j];
      inertia_[j * n_ + j] = b > 0 && std::isfinite(b) ? scale / b : 0.0;
      continue;
    }
    std::span<double> row(&inertia_[j * n_], n_);
    row[j] = scale;
    substitute(work_, n_, row);
  }
}

void JointSolver::gradient(std::span<const JointInStep> joints) noexcept {
  for (std::size_t i = 0; i < n_; ++i) off_[i] = dy_[i] - joints[i].plan->free;
  for (std::size_t i = 0; i < n_; ++i) {
    const double* const row = &inertia_[i * n_];
    double sum = joints[i].plan->last_torque - torque_[i];
    for (std::size_t k = 0; k < n_; ++k) sum += row[k] * off_[k];
    gradient_[i] = sum;
  }
}

/// move_ := −(C⁻¹ + S)⁻¹ g
bool JointSolver::newton() noexcept {
  std::copy(inertia_.begin(), inertia_.end(), work_.begin());
  for (std::size_t i = 0; i < n_; ++i) {
    work_[i * n_ + i] += slope_[i];
    move_[i] = -gradient_[i];
  }
  if (!factor(work_, n_)) return false;
  substitute(work_, n_, move_);
  return true;
}

double JointSolver::along() const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < n_; ++i) sum += move_[i] * gradient_[i];
  return sum;
}

/// dy_ := a linear step from where the joints would go without new torques, with what torque_ and slope_ tell of there.
void JointSolver::guess(std::span<const JointInStep> joints) noexcept {
  gradient(joints);
  if (!newton()) return;
  for (std::size_t i = 0; i < n_; ++i) dy_[i] = std::clamp(dy_[i] + move_[i], -kReach_rad, kReach_rad);
}

void JointSolver::predict(std::span<const JointInStep> joints) noexcept {
  for (std::size_t i = 0; i < n_; ++i) {
    const JointInStep& j = joints[i];
    dy_[i] = std::clamp(j.plan->free, -kReach_rad, kReach_rad);
    const ShaftTorque t = j.state->started ? j.unit->expect(*j.state, *j.plan, dy_[i]) : ShaftTorque{};
    torque_[i] = t.torque;
    slope_[i] = t.slope;
  }
  guess(joints);
  for (std::size_t i = 0; i < n_; ++i) joints[i].plan->dy = dy_[i];
}

bool JointSolver::solve(std::span<const JointInStep> joints, std::span<double> torques) noexcept {
  const bool prescribed = n_ == 1 && inertia_[0] == 0;
  for (std::size_t i = 0; i < n_; ++i) {
    const JointInStep& j = joints[i];
    dy_[i] = prescribed ? j.plan->free : std::clamp(j.plan->free, -kReach_rad, kReach_rad);
    j.unit->begin_trials(*j.state, *j.plan);
    const ShaftTorque t = j.unit->foresee(*j.state, *j.plan, dy_[i]);
    torque_[i] = t.torque;
    slope_[i] = t.slope;
  }
  if (!prescribed) guess(joints);
  double descent = 0;  // along move_, where it began; 0: nowhere yet
  double part = 1;     // of move_ that led to dy_
  bool settled = false;
  for (int iteration = 0; iteration < kMaxIterations && !settled; ++iteration) {
    for (std::size_t i = 0; i < n_; ++i) {
      const JointInStep& j = joints[i];
      const ShaftTorque t = j.unit->attempt(*j.state, *j.plan, dy_[i], iteration == 0 && !prescribed);
      torque_[i] = t.torque;
      slope_[i] = t.slope;
    }
    if (prescribed) {
      move_[0] = 0;
      settled = true;
      break;
    }
    gradient(joints);
    const double now = descent < 0 ? along() : 0.0;
    if (!(now <= -(iteration < kEarly ? kOvershoot : kOvershootLater) * descent)) {
      const double shorter = part * std::clamp(descent / (descent - now), 0.1, 0.9);
      const double back = std::isfinite(shorter) ? shorter - part : -0.75 * part;
      for (std::size_t i = 0; i < n_; ++i) dy_[i] += back * move_[i];
      part += back;
      continue;
    }
    if (!newton()) break;
    settled = true;
    for (std::size_t i = 0; i < n_; ++i) settled = settled && joints[i].unit->carried(*joints[i].state, *joints[i].plan, move_[i]).settled;
    if (settled) break;
    descent = along();
    part = 1;
    double farthest = 0;
    for (std::size_t i = 0; i < n_; ++i) farthest = std::max(farthest, std::abs(move_[i]));
    if (farthest > kReach_rad) part = kReach_rad / farthest;
    for (std::size_t i = 0; i < n_; ++i) dy_[i] += part * move_[i];
  }
  for (std::size_t i = 0; i < n_; ++i) {
    const JointInStep& j = joints[i];
    const double move = settled ? move_[i] : 0.0;
    torques[i] = j.unit->carried(*j.state, *j.plan, move).torque;
    j.unit->finish(*j.state, *j.plan, move, torques[i]);
  }
  return settled;
}

}  // namespace vsa::device
