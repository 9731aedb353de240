// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The engine's own dampers at driven joints, for hosts that can't work out JointIn::free_acceleration. What a damper did in the
// last step is of that step's speeds; to go on with it makes a joint shake where dt·d is of its inertia's size. With what it does now,
//     free_acceleration = (v − v_before)/dt − B D (v − v_before)
// D of the driven joints, diagonal; all else goes on as in the last step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vsa/errors.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/owner.hpp"

namespace vsa::host {

/// Fills JointIn::free_acceleration_rad_per_s2 of joints with dampers, step after step.
class JointDampers {
 public:
  /// What one step leaves for the next: a part of the host's state.
  struct Memory {
    double last_dt_s = 0;                      ///< length of the last step; 0: there was none
    std::vector<double> speeds;                ///< at its start; none without dampers
    void forget() noexcept { last_dt_s = 0; }  ///< as before the first step
    static auto fields(auto& s, auto&& visit) { return visit("last_dt", "s", s.last_dt_s, "speed", "rad/s", s.speeds); }
    /// What a state can't hold.
    [[nodiscard]] const char* impossible() const noexcept {
      return last_dt_s >= 0 && last_dt_s <= 1 ? nullptr : "a last_dt of 0 … 1 s";
    }
  };

  JointDampers() = default;
  /// d of each driven joint, N·m·s/rad or N·s/m, ≥ 0, and `trees` as Robot::join() has them. Throws InputError.
  JointDampers(std::vector<double> damping, std::vector<std::vector<std::size_t>> trees)
      : damping_(std::move(damping)), trees_(std::move(trees)) {
    Problems problems;
    for (std::size_t i = 0; i < damping_.size(); ++i)
      if (!(damping_[i] >= 0 && std::isfinite(damping_[i])))
        problems.add({"", "damping[" + std::to_string(i) + "]", std::to_string(damping_[i]), "can't be", "0 or more"});
    for (const auto& tree : trees_)
      for (const std::size_t i : tree)
        if (i >= damping_.size())
          problems.add({"", "tree", std::to_string(i), "no such joint", "below " + std::to_string(damping_.size())});
    problems.throw_if_any();
    if (std::all_of(damping_.begin(), damping_.end(), [](double d) { return d == 0; })) trees_.clear();
  }

  /// Before the first step.
  [[nodiscard]] Memory begin() const { return {0, std::vector<double>(trees_.empty() ? 0 : damping_.size())}; }

  /// Once before each step, with begin()'s memory. `mobility`: B of the trees, as Robot::advance() gets it, those dampers in it where
  /// the engine takes them implicitly; dt in s. In the first step, and of a joint that was placed, nothing is told. Other sizes: one
  /// line on stderr, and abort.
  void tell(std::span<JointIn> joints, std::span<const double> mobility, double dt_s, Memory& memory) const noexcept {
    if (trees_.empty()) return;
    require(joints.size() == damping_.size() && joints.size() == memory.speeds.size(), "vsa::host::JointDampers::tell",
            "joints has one entry a driven joint, and memory is begin()'s");
    std::size_t numbers = 0;
    for (const auto& tree : trees_) numbers += tree.size() * tree.size();
    require(mobility.size() >= numbers, "vsa::host::JointDampers::tell", "mobility has n² numbers a tree");
    for (const auto& tree : trees_) {
      const std::size_t n = tree.size();
      for (std::size_t i = 0; i < n; ++i) {
        JointIn& joint = joints[tree[i]];
        joint.free_acceleration_rad_per_s2.reset();
        if (memory.last_dt_s == 0 || joint.placed) continue;
        double a = (joint.speed_rad_per_s - memory.speeds[tree[i]]) / memory.last_dt_s;
        for (std::size_t k = 0; k < n; ++k)
          a -= mobility[i * n + k] * damping_[tree[k]] * (joints[tree[k]].speed_rad_per_s - memory.speeds[tree[k]]);
        if (std::isfinite(a)) joint.free_acceleration_rad_per_s2 = a;
      }
      mobility = mobility.subspan(n * n);
    }
    memory.last_dt_s = dt_s;
    std::transform(joints.begin(), joints.end(), memory.speeds.begin(), [](const JointIn& j) { return j.speed_rad_per_s; });
  }

 private:
  std::vector<double> damping_;
  std::vector<std::vector<std::size_t>> trees_;  // none without dampers
};

}  // namespace vsa::host
