// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/implicit_bias.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::physics {
namespace {

constexpr int kRounds = 30;
constexpr mjtNum kClose = 1e-13;  ///< of the tree's largest speed
constexpr mjtNum kSmall = 1e-6;   ///< likewise, for differences
constexpr mjtNum kEnough = 1e-9;  ///< likewise, where rounding lets no round come closer
constexpr mjtNum kFar = 0.01;     ///< likewise: where a slope found farther away misleads
constexpr mjtNum kAstray = 1e3;   ///< likewise: no solution will be found
constexpr mjtNum kSlowly = 0.1;   ///< a round that moves by more than that of the last one wants another slope

mjtNum largest(const mjtNum* x, int count) {
  mjtNum out = 0;
  for (int i = 0; i < count; ++i) out = std::max(out, std::abs(x[i]));
  return out;
}

}  // namespace

void find_bias(const mjModel& m, mjData& d, mjtNum* out) {
  mj_comVel(&m, &d);
  mj_rne(&m, &d, 0, out);
}

ImplicitBias::ImplicitBias(const std::vector<Tree>& trees) {
  for (const Tree& tree : trees) trees_.emplace_back().tree = tree;
}

void ImplicitBias::want(std::size_t tree) { trees_[tree].state = Solution::State::steep; }

void ImplicitBias::find_slopes(const mjModel& m, mjData& d) {
  const auto nv = static_cast<std::size_t>(m.nv);
  int most = 0;
  for (const Solution& s : trees_)
    if (s.state == Solution::State::steep) most = std::max(most, s.tree.count);
  if (columns_.size() < nv * static_cast<std::size_t>(most)) columns_.resize(nv * static_cast<std::size_t>(most));
  mju_copy(at_.data(), d.qvel, m.nv);
  const auto small = [&](const Tree& tree) { return kSmall * largest(at_.data() + tree.first, tree.count); };
  for (int k = 0; k < most; ++k) {
    mjtNum* const column = &columns_[static_cast<std::size_t>(k) * nv];
    for (const Solution& s : trees_)
      if (s.state == Solution::State::steep && k < s.tree.count) d.qvel[s.tree.first + k] += small(s.tree);
    find_bias(m, d, column);
    mju_subFrom(column, d.qfrc_bias, m.nv);
    mj_solveM(&m, &d, column, column, 1);
    mju_copy(d.qvel, at_.data(), m.nv);
  }
  for (Solution& s : trees_) {
    if (s.state != Solution::State::steep) continue;
    const auto [first, count] = s.tree;
    const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> differences(columns_.data() + first, count, count,
                                                                                 Eigen::OuterStride<>(m.nv));
    s.slope.compute(Eigen::MatrixXd::Identity(count, count) + 0.5 * m.opt.timestep / small(s.tree) * differences);
    s.state = Solution::State::near;
  }
}

void ImplicitBias::step(Solution& of, mjtNum* x) {
  const auto [first, count] = of.tree;
  of.change =
      of.slope.solve(Eigen::Map<const Eigen::VectorXd>(missing_.data() + first, count));  // in place would take from the heap
  const mjtNum fastest = largest(x, count), moved = largest(of.change.data(), count);
  if (!(moved < kAstray * fastest)) {
    mju_copy(x, of.guess.data(), count);
    of.state = Solution::State::settled;
    return;
  }
  mju_addTo(x, of.change.data(), count);
  if (moved <= kClose * fastest || (moved >= of.moved && of.moved > 0 && moved <= kEnough * fastest))
    of.state = Solution::State::settled;
  else if (moved > kFar * fastest || (of.moved > 0 && moved > kSlowly * of.moved))
    of.state = Solution::State::steep;
  of.moved = moved;
}

void ImplicitBias::solve(const mjModel& m, mjData& d, const mjtNum* straight, const mjtNum* gravity) {
  const auto nv = static_cast<std::size_t>(m.nv);
  missing_.resize(nv);
  at_.resize(nv);
  for (Solution& s : trees_) {
    if (s.state == Solution::State::left) continue;
    s.guess.assign(d.qvel + s.tree.first, d.qvel + s.tree.first + s.tree.count);
    s.moved = 0;
  }
  const auto any = [&](auto... states) {
    return std::any_of(trees_.begin(), trees_.end(), [&](const Solution& s) { return ((s.state == states) || ...); });
  };
  find_bias(m, d, d.qfrc_bias);
  for (int round = 0; round < kRounds && any(Solution::State::steep, Solution::State::near); ++round) {
    if (any(Solution::State::steep)) find_slopes(m, d);
    mju_sub(missing_.data(), gravity, d.qfrc_bias, m.nv);
    mj_solveM(&m, &d, missing_.data(), missing_.data(), 1);
    for (Solution& s : trees_) {
      if (s.state != Solution::State::near) continue;
      for (int i = s.tree.first; i < s.tree.first + s.tree.count; ++i)
        missing_[i] = straight[i] + 0.5 * m.opt.timestep * missing_[i] - d.qvel[i];
      step(s, d.qvel + s.tree.first);
    }
    find_bias(m, d, d.qfrc_bias);
  }
  const bool lost = any(Solution::State::steep, Solution::State::near);
  for (Solution& s : trees_) {
    if (s.state == Solution::State::steep || s.state == Solution::State::near)
      mju_copy(d.qvel + s.tree.first, s.guess.data(), s.tree.count);
    s.state = Solution::State::left;
  }
  if (lost) find_bias(m, d, d.qfrc_bias);
}

}  // namespace vsa::physics
