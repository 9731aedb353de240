// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// B = (M⁻¹)_aa of joints of a tree of rigid bodies, for hosts whose engine doesn't tell it (host/robot.hpp needs it): column j is
// how all joints accelerate for a unit torque at joint j.
//
// With S the joint's axis as a spatial vector and I the articulated inertia of a body and all that hangs on it (6×6; all in world
// axes about one point, so that nothing needs to be transformed), at rest and without gravity:
//     U = I S,   D = Sᵀ U + h·d + h²·k,   I_parent += I − U Uᵀ/D                                   from the leaves to the roots, once
//     u = τ − Sᵀ p,   p_parent += p + U u/D                                                  from joint j to its root
//     q̈ = (u − Uᵀ a_parent)/D,   a = a_parent + S q̈                                         from the roots to the leaves
// With d and k of a damper and a spring at the joint that the engine takes implicitly (h = dt, else 0), a = 0 for the ground and
// a = −I⁻¹ p for a body that flies free. Four columns at
// a time, and only as far out as their joints: B is symmetric. Contacts aren't in it. Reference: R. Featherstone, Rigid Body Dynamics Algorithms, ch. 7.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace vsa::host {

/// A body and the joint that it hangs on. Positions in world coordinates, m.
struct TreeBody {
  /// Of one degree of freedom, or of none; free: six.
  enum class Joint { free, fixed, revolute, prismatic };
  static constexpr std::size_t kGround = static_cast<std::size_t>(-1);  ///< as a parent

  std::size_t parent = kGround;            ///< an earlier entry of the list, or the ground
  Joint joint = Joint::free;               ///< free: of the ground only
  std::array<double, 3> axis{};            ///< unit vector, world
  std::array<double, 3> anchor{};          ///< a point on the axis
  double mass_kg = 0;                      ///< where nothing that moves has any, B isn't finite
  std::array<double, 3> center_of_mass{};  ///< world
  std::array<double, 9> inertia_kgm2{};    ///< about the centre of mass, world axes, by rows
  double damping = 0;                      ///< d of the joint's own damper, N·m·s/rad or N·s/m
  double stiffness = 0;                    ///< k of its own spring, N·m/rad or N/m
  double implicit_s = 0;             ///< h: dt where the engine takes both implicitly, B = ((M + h·D + h²·K)⁻¹)_aa; else 0
  std::array<double, 3> weight_N{};  ///< gravity's pull at the centre of mass, world
};

/// Works out B = (M⁻¹)_aa of joints of a tree of rigid bodies, 1/(kg·m²), step after step without allocating.
class TreeInertia {
 public:
  static constexpr std::size_t kBlock = 4;  ///< columns that are worked out together

  /// Resizes only; update() and column() then allocate nothing.
  explicit TreeInertia(std::size_t bodies);

  /// Where the bodies are now. Other sizes than it was made for, or a parent behind its child: one line on stderr, and abort.
  void update(const std::vector<TreeBody>& bodies) noexcept;
  /// B of the joints of `of` (indices of their bodies), by rows, 1/(kg·m²) or 1/kg; symmetric. 0 for fixed and free ones; not
  /// finite where the bodies give no answer (no mass). After update() with the same bodies; sizes as there.
  void mobility(const std::vector<TreeBody>& bodies, std::span<const std::size_t> of, std::span<double> out) noexcept;
  /// How torques at all joints accelerate all of them, rad/s² or m/s²: (M + h·D + h²·K)⁻¹ τ. One entry a body, 0 for fixed and free
  /// ones; other sizes: one line on stderr, and abort. After update() with the same bodies.
  void answer(const std::vector<TreeBody>& bodies, std::span<const double> torques, std::span<double> accelerations) noexcept;

 private:
  using Vector = std::array<double, 6>;
  using Matrix = std::array<Vector, 6>;
  using Lanes = std::array<double, kBlock>;
  using Columns = std::array<Lanes, 6>;
  struct Node {
    Matrix inertia, response;  ///< response: I⁻¹ of a body that flies free
    Vector axis, momentum;
    double reciprocal = 0;       ///< 1/D
    Columns bias, acceleration;  ///< p, a
    Lanes drive{};               ///< u, then q̈
  };

  void push(const std::vector<TreeBody>& bodies, std::size_t last) noexcept;
  void pull(const std::vector<TreeBody>& bodies, std::size_t last) noexcept;
  std::vector<Node> nodes_;
};

/// Joints whose torques move each other: indices into `of`, by trees that no ground separates. An index of no body, or a parent
/// behind its child: one line on stderr, and abort.
[[nodiscard]] std::vector<std::vector<std::size_t>> joined(const std::vector<TreeBody>& bodies, std::span<const std::size_t> of);

}  // namespace vsa::host
