// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/joint_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "device/unit_lanes.hpp"

namespace vsa::device {
namespace {

using namespace solver;

/// A factor of other slopes may leave this part of what may be left over at all.
constexpr double kStale = 0.1;

/// A = L D Lᵀ in place, lower triangle by rows: L below the diagonal, 1/D on it. `column` holds n. False: not positive definite.
bool factor(std::span<double> a, std::size_t size, double* column) noexcept {
  const std::size_t n = size;
  for (std::size_t j = 0; j < n; ++j) {
    const double pivot = a[j * n + j], reciprocal = 1.0 / pivot;
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    a[j * n + j] = reciprocal;
    for (std::size_t k = j + 1; k < n; ++k) column[k] = a[k * n + j];
    for (std::size_t i = j + 1; i < n; ++i) {
      double* const row = &a[i * n];
      const double l = row[j] * reciprocal;
      row[j] = l;
      for (std::size_t k = j + 1; k <= i; ++k) row[k] -= l * column[k];
    }
  }
  return true;
}

/// Solves with that factor, in place, for x[first] and what follows; what comes before is 0 in the right-hand side and left alone.
void substitute(std::span<const double> a, std::size_t size, std::span<double> x, std::size_t first = 0) noexcept {
  const std::size_t n = size;
  for (std::size_t i = first; i < n; ++i) {
    double sum = x[i];
    for (std::size_t k = first; k < i; ++k) sum -= a[i * n + k] * x[k];
    x[i] = sum;
  }
  for (std::size_t i = first; i < n; ++i) x[i] *= a[i * n + i];
  for (std::size_t i = n; i-- > first + 1;) {
    const double xi = x[i];
    for (std::size_t k = first; k < i; ++k) x[k] -= a[i * n + k] * xi;
  }
}

}  // namespace

JointSolver::JointSolver(std::size_t joints, std::string_view instructions)
    : n_(joints),
      mobility_(joints * joints),
      inertia_(joints * joints),
      work_(joints * joints),
      dy_(joints),
      off_(joints),
      move_(joints),
      gradient_(joints),
      factored_(joints),
      column_(joints),
      trials_(joints, joints > 1 ? joints : 0, instructions),
      tried_(joints) {}

void JointSolver::set(std::span<const double> mobility, std::int64_t dt_ns) noexcept {
  if (dt_ns == dt_ns_ && std::equal(mobility.begin(), mobility.end(), mobility_.begin())) return;
  dt_ns_ = dt_ns;
  std::copy(mobility.begin(), mobility.end(), mobility_.begin());
  factor_mobility();
}

void JointSolver::factor_mobility() noexcept {
  const double dt = static_cast<double>(dt_ns_) * 1e-9, scale = 2.0 / (dt * dt);
  std::fill(inertia_.begin(), inertia_.end(), 0.0);
  std::copy(mobility_.begin(), mobility_.end(), work_.begin());
  const bool coupled = n_ > 1 && factor(work_, n_, column_.data());
  for (std::size_t j = 0; j < n_; ++j) {
    std::span<double> row(&inertia_[j * n_], n_);
    const double b = mobility_[j * n_ + j];
    row[j] = coupled ? scale : b > 0 && std::isfinite(b) ? scale / b : 0.0;
    if (!coupled) continue;
    substitute(work_, n_, row, j);
    for (std::size_t i = j + 1; i < n_; ++i) inertia_[i * n_ + j] = row[i];
  }
}

void JointSolver::gradient() noexcept {
  for (std::size_t i = 0; i < n_; ++i) off_[i] = dy_[i] - tried_.free[i];
  for (std::size_t i = 0; i < n_; ++i) {
    const double* const row = &inertia_[i * n_];
    double sum = tried_.last_torque[i] - tried_.torque[i];
    for (std::size_t k = 0; k < n_; ++k) sum += row[k] * off_[k];
    gradient_[i] = sum;
  }
}

/// The factor of C⁻¹ + S. False: there is none, and none is kept.
bool JointSolver::factor_slopes() noexcept {
  std::copy(inertia_.begin(), inertia_.end(), work_.begin());
  for (std::size_t i = 0; i < n_; ++i) {
    work_[i * n_ + i] += tried_.slope[i];
    factored_[i] = tried_.slope[i];
  }
  const bool good = factor(work_, n_, column_.data());
  if (!good) factored_[0] = std::numeric_limits<double>::quiet_NaN();  // stale, whatever the slopes
  return good;
}

/// move_ := −(C⁻¹ + S)⁻¹ g
void JointSolver::newton() noexcept {
  for (std::size_t i = 0; i < n_; ++i) move_[i] = -gradient_[i];
  substitute(work_, n_, move_);
}

/// Whether move_ leaves too much of a torque, its factor's slopes being others than those found.
bool JointSolver::stale() const noexcept {
  for (std::size_t i = 0; i < n_; ++i) {
    const double left = std::abs((tried_.slope[i] - factored_[i]) * move_[i]);
    if (!(left <= kStale * (kLeft * std::abs(tried_.torque[i]) + kLeft_Nm))) return true;
  }
  return false;
}

/// Newton's move_, with the last factor where that does. False: with no new one either.
bool JointSolver::fresh_newton() noexcept {
  newton();
  if (!stale()) return true;
  if (!factor_slopes()) return false;
  newton();
  return true;
}

/// Whether every unit takes move_ for the last one.
bool JointSolver::near(std::span<const JointInStep> joints) noexcept { return trials_.carry(joints, tried_, dy_, move_); }

double JointSolver::along() const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < n_; ++i) sum += move_[i] * gradient_[i];
  return sum;
}

/// dy_ := a linear step from where the joints would go without new torques, with what is known of there.
void JointSolver::guess() noexcept {
  gradient();
  if (!factor_slopes()) return;
  newton();
  for (std::size_t i = 0; i < n_; ++i) dy_[i] = std::clamp(dy_[i] + move_[i], -kReach_rad, kReach_rad);
}

void JointSolver::predict(std::span<const JointInStep> joints) noexcept {
  for (std::size_t i = 0; i < n_; ++i) {
    const JointInStep& j = joints[i];
    tried_.free[i] = j.plan->free;
    tried_.last_torque[i] = j.plan->last_torque;
    dy_[i] = std::clamp(j.plan->free, -kReach_rad, kReach_rad);
    const ShaftTorque t = j.state->started ? j.unit->expect(*j.state, *j.plan, dy_[i]) : ShaftTorque{};
    tried_.torque[i] = t.torque;
    tried_.slope[i] = t.slope;
  }
  guess();
  for (std::size_t i = 0; i < n_; ++i) joints[i].plan->dy = dy_[i];
}

namespace {

struct Alone {
  const JointInStep& j;
  double free, last_torque;
  [[nodiscard]] double dy() const noexcept { return j.plan->dy; }
  [[nodiscard]] ShaftTorque foresee(double at) const noexcept { return j.unit->foresee(*j.state, *j.plan, at); }
  ShaftTorque attempt(double at, bool rough, bool which) const noexcept {
    return which ? j.unit->attempt(*j.state, *j.plan, at, rough) : ShaftTorque{};
  }
  [[nodiscard]] ShaftTorque carried(double move) const noexcept { return j.unit->carried(*j.state, *j.plan, move); }
};

}  // namespace

bool JointSolver::solve_alone(const JointInStep& j, double& torque) noexcept {
  j.unit->begin_trials(*j.state, *j.plan);
  Alone joint{j, j.plan->free, j.plan->last_torque};
  AloneSolver<double, Alone> solver;
  const bool settled = solver.solve(joint, inertia_[0]);
  torque = solver.torque;
  j.unit->finish(*j.state, *j.plan, solver.move(), torque);
  return settled;
}

/// `keep`: after a whole move_, who took it for the last has what that foretold.
void JointSolver::attempt(std::span<const JointInStep> joints, bool rough, bool keep) noexcept {
  trials_.attempt(joints, tried_, dy_, rough, keep);
  gradient();
}

/// Newton's way from the last attempt; how long it may be. Returns where the slope along it begins.
double JointSolver::set_out(double& part) noexcept {
  double farthest = 0;
  for (std::size_t i = 0; i < n_; ++i) farthest = std::max(farthest, std::abs(move_[i]));
  part = farthest > kReach_rad ? kReach_rad / farthest : 1.0;
  for (std::size_t i = 0; i < n_; ++i) dy_[i] += part * move_[i];
  return along();
}

bool JointSolver::search(std::span<const JointInStep> joints) noexcept {
  attempt(joints, true);
  if (!fresh_newton()) return false;
  if (near(joints)) return true;
  double part = 1, descent = set_out(part);  // of move_; the slope along it where it began
  bool some = true;                          // tries only the units that aren't settled
  for (int iteration = 1; iteration < kMaxIterations; ++iteration) {
    attempt(joints, false, some);
    const double now = along();
    const bool too_far = !(now <= -(iteration < kEarly ? kOvershoot : kOvershootLater) * descent);
    if (too_far && some) {
      // A friction's edge may lie between what a unit foretold and what it finds there: from here on with all that they find.
      some = false;
      attempt(joints, false);
    } else if (too_far) {
      const double shorter = part * std::clamp(descent / (descent - now), 0.1, 0.9);
      const double back = std::isfinite(shorter) ? shorter - part : -0.75 * part;
      for (std::size_t i = 0; i < n_; ++i) dy_[i] += back * move_[i];
      part += back;
      continue;
    }
    if (!fresh_newton()) return false;
    if (near(joints)) return true;
    descent = set_out(part);
    some = some && part == 1;
  }
  return false;
}

bool JointSolver::solve(std::span<const JointInStep> joints, std::span<double> torques) noexcept {
  if (n_ == 1) return solve_alone(joints[0], torques[0]);
  trials_.begin(joints, tried_, kReach_rad);
  for (std::size_t i = 0; i < n_; ++i) dy_[i] = std::clamp(tried_.free[i], -kReach_rad, kReach_rad);
  guess();
  bool settled = search(joints);
  if (!settled) {
    // Where a friction's edge keeps Newton going to and fro, what is left may be little all the same.
    std::fill(move_.begin(), move_.end(), 0.0);
    attempt(joints, false);
    near(joints);
    settled = true;
    for (std::size_t i = 0; i < n_; ++i)
      settled = settled && std::abs(gradient_[i]) <= kLeft * std::abs(tried_.torque[i]) + kLeft_Nm;
  }
  for (std::size_t i = 0; i < n_; ++i) torques[i] = tried_.carried[i].torque;
  trials_.finish(joints, tried_, dy_, move_, torques);
  return settled;
}

}  // namespace vsa::device
