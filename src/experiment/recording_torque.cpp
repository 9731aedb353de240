// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "vsa/experiment/recording.hpp"
#include "vsa/not_a_number.hpp"

namespace vsa::experiment {
namespace {

constexpr double kEnd_Nm = 0.5 + 1e-9;  // of a branch: the torques whose slope it is followed by; a loop's turn alone is too steep

/// Neighbours pooled until their means increase.
struct Pool {
  double deflection_sum = 0, torque_sum = 0, count = 0;

  [[nodiscard]] double deflection() const { return deflection_sum / count; }
  [[nodiscard]] double torque() const { return torque_sum / count; }
  void take(const Pool& other) {
    deflection_sum += other.deflection_sum;
    torque_sum += other.torque_sum;
    count += other.count;
  }
};

struct Squares {
  double sum = 0;
  std::size_t points = 0;
  [[nodiscard]] double root_mean() const { return points == 0 ? kNaN : std::sqrt(sum / static_cast<double>(points)); }
};

}  // namespace

BranchInverse::BranchInverse(const std::vector<double>& torque_Nm, const std::vector<double>& deflection_rad) {
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < torque_Nm.size(); ++i) {
    if (!std::isfinite(torque_Nm[i]) || !std::isfinite(deflection_rad[i])) continue;
    pools.push_back({deflection_rad[i], torque_Nm[i], 1});
    while (pools.size() > 1 && pools.back().deflection() <= pools[pools.size() - 2].deflection()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().take(last);
    }
  }
  for (const Pool& p : pools) {
    deflection_.push_back(p.deflection());
    torque_.push_back(p.torque());
  }
}

BranchTorque BranchInverse::at(double deflection_rad) const {
  const std::size_t n = deflection_.size();
  if (n < 2) return {kNaN, false};
  const auto line = [&](std::size_t from, std::size_t to) {
    const double slope = (torque_[to] - torque_[from]) / (deflection_[to] - deflection_[from]);
    return torque_[from] + slope * (deflection_rad - deflection_[from]);
  };
  if (deflection_rad < deflection_.front()) {
    std::size_t far = 1;
    while (far + 1 < n && torque_[far + 1] - torque_[0] <= kEnd_Nm) ++far;
    return {line(0, far), true};
  }
  if (deflection_rad > deflection_.back()) {
    std::size_t far = n - 2;
    while (far > 0 && torque_[n - 1] - torque_[far - 1] <= kEnd_Nm) --far;
    return {line(n - 1, far), true};
  }
  const auto above = std::lower_bound(deflection_.begin() + 1, deflection_.end() - 1, deflection_rad);
  const auto k = static_cast<std::size_t>(above - deflection_.begin());
  return {line(k - 1, k), false};
}

TorqueDifference torque_difference(const Branches& simulated, const Branches& recorded) {
  TorqueDifference out;
  const auto compare = [&](const std::vector<double>& ours, const std::vector<double>& theirs) {
    const BranchInverse inverse(simulated.torque_Nm, ours);
    Squares s;
    for (std::size_t i = 0; i < theirs.size() && inverse.knots() > 1; ++i) {
      if (!std::isfinite(theirs[i])) continue;
      const BranchTorque found = inverse.at(theirs[i]);
      const double d = found.torque_Nm - recorded.torque_Nm[i];
      s.sum += d * d;
      ++s.points;
      out.extrapolated += found.beyond ? 1 : 0;
    }
    return s;
  };
  const Squares rising = compare(simulated.rising_rad, recorded.rising_rad);
  const Squares falling = compare(simulated.falling_rad, recorded.falling_rad);
  out.points = rising.points + falling.points;
  out.rising_Nm = rising.root_mean();
  out.falling_Nm = falling.root_mean();
  out.both_Nm = Squares{rising.sum + falling.sum, out.points}.root_mean();
  return out;
}

}  // namespace vsa::experiment
