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
/// A direction whose slopes are wrong by less than this part needs no new factor.
constexpr double kStale = 0.01;
/// The torque that may be left over where no round settles.
constexpr double kLeft = 1e-3, kLeft_Nm = 1e-4;

/// N = 1: a joint alone, the usual case of many units, where all loops fall away. N = 0: as many as there are.
template <std::size_t N>
constexpr std::size_t count(std::size_t n) noexcept {
  return N > 0 ? N : n;
}

/// A = L D Lᵀ in place, lower triangle by rows: L below the diagonal, 1/D on it. `column` holds n. False: not positive definite.
template <std::size_t N>
bool factor(std::span<double> a, std::size_t size, double* column) noexcept {
  const std::size_t n = count<N>(size);
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
template <std::size_t N>
void substitute(std::span<const double> a, std::size_t size, std::span<double> x, std::size_t first = 0) noexcept {
  const std::size_t n = count<N>(size);
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

/// How far a joint has come since its unit's last attempt.
double beyond(const JointInStep& j, double dy) noexcept { return dy - j.plan->dy; }

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
      slope_(joints),
      factored_(joints),
      column_(joints),
      carried_(joints) {}

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
  const bool coupled = n_ > 1 && factor<0>(work_, n_, column_.data());
  for (std::size_t j = 0; j < n_; ++j) {
    std::span<double> row(&inertia_[j * n_], n_);
    const double b = mobility_[j * n_ + j];
    row[j] = coupled ? scale : b > 0 && std::isfinite(b) ? scale / b : 0.0;
    if (!coupled) continue;
    substitute<0>(work_, n_, row, j);
    for (std::size_t i = j + 1; i < n_; ++i) inertia_[i * n_ + j] = row[i];
  }
}

template <std::size_t N>
void JointSolver::gradient(std::span<const JointInStep> joints) noexcept {
  for (std::size_t i = 0; i < count<N>(n_); ++i) off_[i] = dy_[i] - joints[i].plan->free;
  for (std::size_t i = 0; i < count<N>(n_); ++i) {
    const double* const row = &inertia_[i * n_];
    double sum = joints[i].plan->last_torque - torque_[i];
    for (std::size_t k = 0; k < count<N>(n_); ++k) sum += row[k] * off_[k];
    gradient_[i] = sum;
  }
}

/// The factor of C⁻¹ + S.
template <std::size_t N>
bool JointSolver::factor_slopes() noexcept {
  std::copy(inertia_.begin(), inertia_.end(), work_.begin());
  for (std::size_t i = 0; i < count<N>(n_); ++i) {
    work_[i * n_ + i] += slope_[i];
    factored_[i] = slope_[i];
  }
  return factor<N>(work_, n_, column_.data());
}

/// Whether the slopes are others than those of the factor.
template <std::size_t N>
bool JointSolver::stale() const noexcept {
  if (N == 1) return true;
  for (std::size_t i = 0; i < count<N>(n_); ++i)
    if (std::abs(slope_[i] - factored_[i]) > kStale * (inertia_[i * n_ + i] + slope_[i])) return true;
  return false;
}

/// move_ := −(C⁻¹ + S)⁻¹ g
template <std::size_t N>
void JointSolver::newton() noexcept {
  for (std::size_t i = 0; i < count<N>(n_); ++i) move_[i] = -gradient_[i];
  substitute<N>(work_, n_, move_);
}

/// Whether every unit takes move_ for the last one; the torques that it leads to.
template <std::size_t N>
bool JointSolver::near(std::span<const JointInStep> joints, std::span<double> torques) noexcept {
  bool all = true;
  for (std::size_t i = 0; i < count<N>(n_); ++i) {
    carried_[i] = joints[i].unit->carried(*joints[i].state, *joints[i].plan, beyond(joints[i], dy_[i]) + move_[i]);
    torques[i] = carried_[i].torque;
    all = all && carried_[i].settled;
  }
  return all;
}

/// After a whole move_: who took it for the last keeps what that foretold, the others try it.
template <std::size_t N>
void JointSolver::go_on(std::span<const JointInStep> joints) noexcept {
  for (std::size_t i = 0; i < count<N>(n_); ++i) {
    const JointInStep& j = joints[i];
    const ShaftTorque t = carried_[i].settled ? carried_[i] : j.unit->attempt(*j.state, *j.plan, dy_[i], false);
    torque_[i] = t.torque;
    slope_[i] = t.slope;
  }
  gradient<N>(joints);
}

template <std::size_t N>
double JointSolver::along() const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < count<N>(n_); ++i) sum += move_[i] * gradient_[i];
  return sum;
}

/// dy_ := a linear step from where the joints would go without new torques, with what torque_ and slope_ tell of there.
template <std::size_t N>
void JointSolver::guess(std::span<const JointInStep> joints) noexcept {
  gradient<N>(joints);
  if (!factor_slopes<N>()) return;
  newton<N>();
  for (std::size_t i = 0; i < count<N>(n_); ++i) dy_[i] = std::clamp(dy_[i] + move_[i], -kReach_rad, kReach_rad);
}

void JointSolver::predict(std::span<const JointInStep> joints) noexcept {
  n_ == 1 ? predict_all<1>(joints) : predict_all<0>(joints);
}

template <std::size_t N>
void JointSolver::predict_all(std::span<const JointInStep> joints) noexcept {
  for (std::size_t i = 0; i < count<N>(n_); ++i) {
    const JointInStep& j = joints[i];
    dy_[i] = std::clamp(j.plan->free, -kReach_rad, kReach_rad);
    const ShaftTorque t = j.state->started ? j.unit->expect(*j.state, *j.plan, dy_[i]) : ShaftTorque{};
    torque_[i] = t.torque;
    slope_[i] = t.slope;
  }
  guess<N>(joints);
  for (std::size_t i = 0; i < count<N>(n_); ++i) joints[i].plan->dy = dy_[i];
}

/// The only joint of its tree, and moved by somebody else.
void JointSolver::follow(const JointInStep& j, double& torque) noexcept {
  j.unit->begin_trials(*j.state, *j.plan);
  torque = j.unit->attempt(*j.state, *j.plan, j.plan->free, false).torque;
  j.unit->finish(*j.state, *j.plan, 0.0, torque);
}

template <std::size_t N>
void JointSolver::attempt(std::span<const JointInStep> joints, bool rough) noexcept {
  for (std::size_t i = 0; i < count<N>(n_); ++i) {
    const ShaftTorque t = joints[i].unit->attempt(*joints[i].state, *joints[i].plan, dy_[i], rough);
    torque_[i] = t.torque;
    slope_[i] = t.slope;
  }
  gradient<N>(joints);
}

/// Newton's way from the last attempt; how long it may be. Returns where the slope along it begins.
template <std::size_t N>
double JointSolver::set_out(double& part) noexcept {
  double farthest = 0;
  for (std::size_t i = 0; i < count<N>(n_); ++i) farthest = std::max(farthest, std::abs(move_[i]));
  part = farthest > kReach_rad ? kReach_rad / farthest : 1.0;
  for (std::size_t i = 0; i < count<N>(n_); ++i) dy_[i] += part * move_[i];
  return along<N>();
}

template <std::size_t N>
bool JointSolver::search(std::span<const JointInStep> joints, std::span<double> torques) noexcept {
  // The guess is mostly good: what is left is linear, and the slopes foreseen serve once more.
  attempt<N>(joints, true);
  newton<N>();
  if (near<N>(joints, torques)) return true;
  if (stale<N>()) {
    if (!factor_slopes<N>()) return false;
    newton<N>();
    near<N>(joints, torques);
  }
  double part = 1, descent = set_out<N>(part);  // of move_; the slope along it where it began
  bool some = true;                             // tries only the units that aren't settled
  for (int iteration = 1; iteration < kMaxIterations; ++iteration) {
    some ? go_on<N>(joints) : attempt<N>(joints, false);
    const double now = along<N>();
    const bool too_far = !(now <= -(iteration < kEarly ? kOvershoot : kOvershootLater) * descent);
    if (too_far && some) {
      // A friction's edge may lie between what a unit foretold and what it finds there: from here on with all that they find.
      some = false;
      attempt<N>(joints, false);
    } else if (too_far) {
      const double shorter = part * std::clamp(descent / (descent - now), 0.1, 0.9);
      const double back = std::isfinite(shorter) ? shorter - part : -0.75 * part;
      for (std::size_t i = 0; i < count<N>(n_); ++i) dy_[i] += back * move_[i];
      part += back;
      continue;
    }
    if ((!some || stale<N>()) && !factor_slopes<N>()) return false;
    newton<N>();
    if (near<N>(joints, torques)) return true;
    descent = set_out<N>(part);
    some = some && part == 1;
  }
  return false;
}

bool JointSolver::solve(std::span<const JointInStep> joints, std::span<double> torques) noexcept {
  return n_ == 1 ? solve_all<1>(joints, torques) : solve_all<0>(joints, torques);
}

template <std::size_t N>
bool JointSolver::solve_all(std::span<const JointInStep> joints, std::span<double> torques) noexcept {
  if (N == 1 && inertia_[0] == 0) {
    follow(joints[0], torques[0]);
    return true;
  }
  for (std::size_t i = 0; i < count<N>(n_); ++i) {
    const JointInStep& j = joints[i];
    dy_[i] = std::clamp(j.plan->free, -kReach_rad, kReach_rad);
    j.unit->begin_trials(*j.state, *j.plan);
    const ShaftTorque t = j.unit->foresee(*j.state, *j.plan, dy_[i]);
    torque_[i] = t.torque;
    slope_[i] = t.slope;
  }
  guess<N>(joints);
  bool settled = search<N>(joints, torques);
  if (!settled) {
    // Where a friction's edge keeps Newton going to and fro, what is left may be little all the same.
    std::fill(move_.begin(), move_.end(), 0.0);
    attempt<N>(joints, false);
    near<N>(joints, torques);
    settled = true;
    for (std::size_t i = 0; i < count<N>(n_); ++i)
      settled = settled && std::abs(gradient_[i]) <= kLeft * std::abs(torque_[i]) + kLeft_Nm;
  }
  for (std::size_t i = 0; i < count<N>(n_); ++i)
    joints[i].unit->finish(*joints[i].state, *joints[i].plan, beyond(joints[i], dy_[i]) + move_[i], torques[i]);
  return settled;
}

}  // namespace vsa::device
