// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// JointIn::free_acceleration of joints of a tree of rigid bodies, for hosts whose engine doesn't tell it: what springs and dampers at
// the tree's joints, driven or not, and gravity do in this step and didn't in the last. To go on with what they did then makes a
// joint shake where dt·d or dt²·k is of its inertia's size. With q and v of all joints, Δ since the last step, to first order
//     free_acceleration = (v − v_before)/dt + (M + h·D + h²·K)⁻¹ (−D Δv − K (Δq + h Δv) + Δτ_g)
// h as in TreeBody::implicit_s. The joint's axis S carries the weight F of all bodies behind it, spatial vectors as in tree_inertia.hpp:
//     τ_g = Sᵀ F,   Δτ_g = ΔSᵀ F + Sᵀ ΔF,   by the motion of bodies, ΔX = ΔX_parent + S Δq
// Gravity counts in trees that stand on the ground: what flies free falls with all its joints at rest. Contacts, what users apply,
// velocity products and actuators go on as in the last step.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "vsa/host/tree_inertia.hpp"

namespace vsa::host {

/// Foresees how joints of trees are accelerated in a step if their actuators' torques stay, step after step without allocating.
class TreeForesight {
 public:
  /// What one step leaves for the next: a part of the host's state.
  struct Memory {
    double last_dt_s = 0;                      ///< length of the last step; 0: there was none
    std::vector<double> positions;             ///< at its start, of all bodies' joints, rad or m
    std::vector<double> speeds;                ///< likewise, rad/s or m/s
    void forget() noexcept { last_dt_s = 0; }  ///< as before the first step
    static auto fields(auto& s, auto&& visit) {
      return visit("last_dt", "s", s.last_dt_s, "position", "rad", s.positions, "speed", "rad/s", s.speeds);
    }
    /// What a state can't hold.
    [[nodiscard]] const char* impossible() const noexcept {
      return last_dt_s >= 0 && last_dt_s <= 1 ? nullptr : "a last_dt of 0 … 1 s";
    }
  };

  /// For so many bodies.
  explicit TreeForesight(std::size_t bodies);
  [[nodiscard]] Memory begin() const;  ///< before the first step

  /// How springs, dampers and gravity change the joints' torques, N·m or N, where joints move on by so much, rad and rad/s, or m and
  /// m/s: the bracket above. One entry a body; other sizes, here and below: one line on stderr, and abort.
  void torques(const std::vector<TreeBody>& bodies, std::span<const double> moved, std::span<const double> sped_up,
               std::span<double> out) noexcept;
  /// Once before each step, dt in s, with begin()'s memory: free accelerations of all bodies' joints, rad/s² or m/s². NaN where nothing
  /// is told: in the first step, and in trees without springs, dampers and weights. `inertia`: after update() with the same bodies.
  void foresee(const std::vector<TreeBody>& bodies, TreeInertia& inertia, std::span<const double> positions,
               std::span<const double> speeds, double dt_s, Memory& memory, std::span<double> out) noexcept;

 private:
  using Vector = std::array<double, 6>;
  struct Node {
    std::size_t root = 0;
    bool grounded = false,
         known = false;                  ///< of the root: the tree stands, and something acts there that isn't as in the last step
    Vector axis{}, moved{}, weight{};    ///< S, ΔX, F
    std::array<double, 3> overturned{};  ///< moment of ΔF
  };
  bool survey(const std::vector<TreeBody>& bodies) noexcept;
  void move(const std::vector<TreeBody>& bodies, std::span<const double> moved, std::span<const double> sped_up,
            std::span<double> out) noexcept;

  std::vector<Node> nodes_;
  std::vector<double> moved_, sped_up_, torques_, changes_;
};

}  // namespace vsa::host
