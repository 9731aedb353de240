// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/joint_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "device/lanes/table.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::device {
namespace {

using namespace solver;

/// A factor of other slopes may leave this part of what may be left over at all.
constexpr double kStale = 0.1;
/// A holder's answer may leave this part of it.
constexpr double kAnswerLeft = 0.01;
/// How often a move by such a factor is mended before a new one is made.
constexpr int kMends = 2;

}  // namespace

JointSolver::JointSolver(std::size_t joints, std::string_view instructions)
    : n_(joints),
      stride_((joints + kBlock - 1) / kBlock * kBlock),
      algebra_(instructions == "none" ? &lane_tables().back() : &lane_table(instructions)),
      mobility_(joints * joints),
      inertia_(joints * stride_),
      lower_inertia_(joints * stride_),
      lower_(joints * stride_),
      upper_(joints * stride_),
      reciprocal_(stride_),
      off_(stride_),
      move_(stride_),
      change_(stride_),
      gradient_(stride_),
      dy_(joints),
      factored_(joints),
      column_(joints),
      acceleration_(joints),
      told_(joints * joints),
      between_(joints),
      way_(joints),
      tried_before_(joints),
      trials_(joints, joints > 1 ? joints : 0, instructions),
      tried_(joints) {}

/// lower_ holds A's lower triangle by rows and becomes L, where A = L D Lᵀ. False: A isn't positive definite.
bool JointSolver::factor() noexcept {
  for (std::size_t j = 0; j < n_; ++j) {
    double& diagonal = lower_[j * stride_ + j];
    const double pivot = diagonal, reciprocal = 1.0 / pivot;
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    reciprocal_[j] = reciprocal;
    diagonal = 0;
    for (std::size_t k = j + 1; k < n_; ++k) column_[k] = lower_[k * stride_ + j];
    for (std::size_t i = j + 1; i < n_; ++i) {
      double* const row = &lower_[i * stride_];
      const double l = row[j] * reciprocal;
      upper_[j * stride_ + i] = row[j] = l;
      for (std::size_t k = j + 1; k <= i; ++k) row[k] -= l * column_[k];
    }
  }
  return true;
}

void JointSolver::substitute(Row& x) const noexcept {
  algebra_->substitute({n_, stride_, lower_.data(), upper_.data(), reciprocal_.data()}, x.data());
}

void JointSolver::set(std::span<const double> mobility, std::int64_t dt_ns) noexcept {
  if (dt_ns == dt_ns_ && std::memcmp(mobility.data(), mobility_.data(), mobility_.size() * sizeof(double)) == 0) return;
  dt_ns_ = dt_ns;
  std::copy(mobility.begin(), mobility.end(), mobility_.begin());
  factor_mobility();
}

void JointSolver::factor_mobility() noexcept {
  const double dt = static_cast<double>(dt_ns_) * 1e-9, scale = 2.0 / (dt * dt);
  std::fill(inertia_.begin(), inertia_.end(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) std::copy_n(&mobility_[i * n_], i + 1, &lower_[i * stride_]);
  const bool coupled = n_ > 1 && factor();
  for (std::size_t j = 0; j < n_; ++j) {
    double& diagonal = inertia_[j * stride_ + j];
    const double b = mobility_[j * n_ + j];
    diagonal = b > 0 && std::isfinite(b) ? scale / b : 0.0;
    if (!coupled) continue;
    std::fill(move_.begin(), move_.end(), 0.0);
    move_[j] = scale;
    substitute(move_);
    for (std::size_t i = j; i < n_; ++i) inertia_[j * stride_ + i] = inertia_[i * stride_ + j] = move_[i];
  }
  for (std::size_t i = 0; i < n_; ++i) std::copy_n(&inertia_[i * stride_], i + 1, &lower_inertia_[i * stride_]);
}

void JointSolver::gradient() noexcept {
  bool away = false;  // a first guess is not
  for (std::size_t i = 0; i < n_; ++i) {
    off_[i] = dy_[i] - tried_.free[i];
    away = away || off_[i] != 0.0;
    gradient_[i] = tried_.last_torque[i] - tried_.torque[i];
  }
  if (away) algebra_->add_product(inertia_.data(), n_, stride_, off_.data(), gradient_.data());
}

/// The factor of C⁻¹ + S. False: there is none, and none is kept.
bool JointSolver::factor_slopes() noexcept {
  std::copy(lower_inertia_.begin(), lower_inertia_.end(), lower_.begin());
  for (std::size_t i = 0; i < n_; ++i) {
    lower_[i * stride_ + i] += tried_.slope[i];
    factored_[i] = tried_.slope[i];
  }
  const bool good = factor();
  if (!good) factored_[0] = std::numeric_limits<double>::quiet_NaN();  // stale, whatever the slopes
  return good;
}

/// move_ := −(C⁻¹ + S)⁻¹ g
void JointSolver::newton() noexcept {
  for (std::size_t i = 0; i < n_; ++i) move_[i] = -gradient_[i];
  substitute(move_);
}

/// Whether what came to move_ last leaves too much of a torque, the factor's slopes being others than those found.
bool JointSolver::stale() const noexcept {
  for (std::size_t i = 0; i < n_; ++i) {
    const double left = std::abs((tried_.slope[i] - factored_[i]) * change_[i]);
    if (!(left <= kStale * (kLeft * std::abs(tried_.torque[i]) + kLeft_Nm))) return true;
  }
  return false;
}

/// Newton's move_ by the last factor, which is of slopes F, mended a few times: m += (C⁻¹ + F)⁻¹ (F − S) Δm of what came last. By a
/// new factor where that isn't enough; false: there is none.
bool JointSolver::fresh_newton() noexcept {
  newton();
  std::copy(move_.begin(), move_.end(), change_.begin());
  for (int mends = 0; stale(); ++mends) {
    if (mends == kMends) {
      if (!factor_slopes()) return false;
      newton();
      return true;
    }
    for (std::size_t i = 0; i < n_; ++i) change_[i] *= factored_[i] - tried_.slope[i];
    substitute(change_);
    for (std::size_t i = 0; i < n_; ++i) move_[i] += change_[i];
  }
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

/// Where the friction of a shaft, an edge beside a step, keeps Newton going to and fro: each of its ways is gone to where the slope along it
/// ends, which lies between two places of it, for the torques fall with Δy. There Newton sees the edge.
bool JointSolver::search_closely(std::span<const JointInStep> joints) noexcept {
  constexpr double kFlat = 0.1;  // of the slope that a way begins with
  attempt(joints, false);
  for (int way = 0; way < kMaxWays; ++way) {
    if (!fresh_newton()) return false;
    if (near(joints)) return true;
    double part = 1, low = 0, high = std::numeric_limits<double>::infinity();
    const double descent = set_out(part);
    for (int k = 0; k < kMaxHalvings; ++k) {
      attempt(joints, false);
      const double now = along();
      if (std::abs(now) <= -kFlat * descent || (now < 0 && high > 1)) break;
      (now < 0 ? low : high) = part;
      const double middle = 0.5 * (low + high);
      for (std::size_t i = 0; i < n_; ++i) dy_[i] += (middle - part) * move_[i];
      part = middle;
    }
  }
  return false;
}

/// From dy_ on.
bool JointSolver::settle(std::span<const JointInStep> joints) noexcept {
  // As near as it came: what is left may be little all the same.
  const auto stay = [&] {
    std::fill(move_.begin(), move_.end(), 0.0);
    attempt(joints, false);
    near(joints);
    bool little = true;
    for (std::size_t i = 0; i < n_; ++i) little = little && std::abs(gradient_[i]) <= kLeft * std::abs(tried_.torque[i]) + kLeft_Nm;
    return little;
  };
  const auto has_edge = [](const JointInStep& j) { return j.unit->has_edge(*j.plan); };
  return search(joints) || stay() || (std::any_of(joints.begin(), joints.end(), has_edge) && (search_closely(joints) || stay()));
}

/// Whether the holder's answer to the torques that were found isn't the units' Δy. Then free and C are what it tells of there, and dy_ is
/// where the units are. What holds makes that answer bend, as stops do, or saturate, as friction does, and by its slope at one torque
/// Newton may go too far: then it is the slope at a torque in between, where the answer and the units' Δy are about the same.
bool JointSolver::holds_else(std::span<const JointInStep> joints, Holder& holder, std::size_t tree, std::span<double> torques,
                             bool first) noexcept {
  constexpr int kShortenings = 8;
  const auto tells = [&](std::span<const double> with) {
    const auto finite = [](double x) { return std::isfinite(x); };
    return holder.holds_else(tree, with, acceleration_, told_) && std::all_of(acceleration_.begin(), acceleration_.end(), finite) &&
           std::all_of(told_.begin(), told_.end(), finite);
  };
  if (!tells(torques)) return false;
  const double dt = static_cast<double>(dt_ns_) * 1e-9;
  const auto off = [&](std::size_t i) { return dt * joints[i].plan->in.speed + 0.5 * dt * dt * acceleration_[i] - dy_[i]; };
  bool same = true;
  for (std::size_t i = 0; i < n_; ++i) {
    dy_[i] += move_[i];
    move_[i] = 0;
    way_[i] = torques[i] - tried_before_[i].torque;
    same = same && std::abs(tried_.carried[i].slope * off(i)) <= kAnswerLeft * (kLeft * std::abs(torques[i]) + kLeft_Nm);
  }
  if (same) return false;
  double before = 0;
  for (std::size_t i = 0; i < n_; ++i) before += way_[i] * tried_before_[i].off;
  const auto slope_along = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < n_; ++i) sum += way_[i] * off(i);
    return sum;
  };
  double now = slope_along();
  for (int n = 0; n < kShortenings && !first && before < 0 && now > -kOvershootLater * before; ++n) {
    const double part = std::clamp(before / (before - now), 0.1, 0.9);
    for (std::size_t i = 0; i < n_; ++i) between_[i] = tried_before_[i].torque + part * (torques[i] - tried_before_[i].torque);
    // Where the same holds in between, it answers in proportion from there to here.
    if (!holder.holds_else(tree, between_, acceleration_, told_)) {
      for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t k = 0; k < n_; ++k) acceleration_[i] += told_[i * n_ + k] * (between_[k] - torques[k]);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      torques[i] = between_[i];
      dy_[i] = tried_before_[i].dy + part * (dy_[i] - tried_before_[i].dy);
    }
    now = slope_along();
  }
  set(told_, dt_ns_);
  for (std::size_t i = 0; i < n_; ++i) {
    StepPlan& plan = *joints[i].plan;
    tried_before_[i] = {torques[i], dy_[i], off(i)};
    double a = acceleration_[i];
    for (std::size_t k = 0; k < n_; ++k) a -= told_[i * n_ + k] * (torques[k] - tried_.last_torque[k]);
    tried_.free[i] = plan.free = dt * plan.in.speed + 0.5 * dt * dt * a;
  }
  factor_slopes();
  return true;
}

bool JointSolver::solve(std::span<const JointInStep> joints, std::span<double> torques, Holder* holder, std::size_t tree) noexcept {
  if (n_ == 1 && holder == nullptr) {
    torques[0] = joints[0].unit->end_step(*joints[0].state, *joints[0].plan);
    return joints[0].unit->settled();
  }
  trials_.begin(joints, tried_, kReach_rad);
  for (std::size_t i = 0; i < n_; ++i) dy_[i] = std::clamp(tried_.free[i], -kReach_rad, kReach_rad);
  guess();
  bool settled = false;
  for (int changes = 0;; ++changes) {
    settled = settle(joints);
    for (std::size_t i = 0; i < n_; ++i) torques[i] = tried_.carried[i].torque;
    if (holder == nullptr || changes == kMaxChanges || !holds_else(joints, *holder, tree, torques, changes == 0)) break;
  }
  trials_.finish(joints, tried_, dy_, move_, torques);
  return settled;
}

}  // namespace vsa::device
