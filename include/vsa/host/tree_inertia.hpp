// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A_j = (M⁻¹)_jj of every joint of a tree of rigid bodies, for hosts whose engine doesn't tell it (host/robot.hpp needs it).
//
// With S the joint's axis as a spatial vector, I the articulated inertia of a body and all that hangs on it, and Ω the acceleration
// of the parent for a force on it (6×6; all in world axes about one point, so that nothing needs to be transformed):
//     U = I S,   D = Sᵀ U,   I_parent += I − U Uᵀ/D                          from the leaves to the roots
//     A = 1/D + (U/D)ᵀ Ω_parent (U/D),
//     Ω = S Sᵀ/D + (1 − S Uᵀ/D) Ω_parent (1 − S Uᵀ/D)ᵀ                       from the roots to the leaves
// with Ω = 0 for the ground and Ω = I⁻¹ for a body that flies free. Contacts aren't in it. Reference: R. Featherstone, Rigid Body
// Dynamics Algorithms, ch. 7; K. Kreutz-Delgado, A. Jain, G. Rodriguez, Recursive formulation of operational space control, 1992.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace vsa::host {

/// A body and the joint that it hangs on. Positions in world coordinates, m.
struct TreeBody {
  enum class Joint { free, fixed, revolute, prismatic };
  static constexpr std::size_t kGround = static_cast<std::size_t>(-1);

  std::size_t parent = kGround;  ///< an earlier entry of the list, or the ground
  Joint joint = Joint::free;     ///< free: of the ground only
  std::array<double, 3> axis{};  ///< unit vector, world
  std::array<double, 3> anchor{};
  double mass_kg = 0;
  std::array<double, 3> center_of_mass{};
  std::array<double, 9> inertia_kgm2{};  ///< about the centre of mass, world axes, by rows
};

class TreeInertia {
 public:
  /// Resizes only; update() then allocates nothing.
  explicit TreeInertia(std::size_t bodies);

  /// Fills `inverse` for the bodies' joints, 1/(kg·m²) or 1/kg; 0 for fixed and free ones. NaN where the bodies give no answer
  /// (no mass). Other sizes than it was made for, or a parent behind its child: one line on stderr, and abort.
  void update(const std::vector<TreeBody>& bodies, std::vector<double>& inverse) noexcept;

 private:
  using Vector = std::array<double, 6>;
  using Matrix = std::array<Vector, 6>;
  struct Node {
    Matrix inertia, response;
    Vector axis, momentum;
    double reciprocal = 0;  ///< 1/D
  };

  void gather(const std::vector<TreeBody>& bodies) noexcept;
  std::vector<Node> nodes_;
};

}  // namespace vsa::host
