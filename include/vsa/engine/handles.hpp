// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a World's joints and links are called in a loop that has no time for names, and what can be asked of them and done to them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "vsa/scene/pose.hpp"
#include "vsa/scene/touch.hpp"

namespace vsa::engine {

class World;
using scene::Twist;
using scene::Wrench;

/// A joint or a link of a world, found by its name once (World::joint, World::link). Good for every world with the same links and
/// joints: those of the same file, and clones. Given to another world, or made by nobody: InputError.
template <class Kind>
class Handle {
 public:
  Handle() = default;
  [[nodiscard]] std::size_t index() const noexcept { return index_; }  ///< into joints() or links()
  bool operator==(const Handle&) const = default;

 private:
  friend class World;
  Handle(std::size_t index, std::uint32_t tag) noexcept : index_(static_cast<std::uint32_t>(index)), tag_(tag) {}
  std::uint32_t index_ = 0, tag_ = 0;  // of the world's names; 0: of no world
};
using JointHandle = Handle<struct JointKind>;  ///< of a joint with one axis
using LinkHandle = Handle<struct LinkKind>;    ///< of a link, static ones too

/// What a world knows of one of its joints, as its file has it: World::joints(), where a JointHandle's index leads.
struct JointInfo {
  /// Universal: two axes.
  enum class Type { fixed, revolute, prismatic, ball, universal };
  std::string name;                            ///< scoped: "model::joint"
  Type type = Type::fixed;                     ///< only revolute and prismatic ones have handles, angles and speeds: one_axis()
  std::optional<std::array<double, 2>> range;  ///< of its one axis, rad or m; none: without limits
  std::optional<std::size_t> actuator;         ///< that drives it: an index into World::actuators()
  /// Its first degree of freedom: where it stands in vectors and matrices of World::dof_count(). Revolute, prismatic: 1; universal:
  /// 2; ball: 3 (angular velocity in the child's axes). None where it has no motion.
  std::optional<std::size_t> dof;
  /// Of its one axis, what the file gives the joint beside an actuator: torque −stiffness (q − rest) − damping q̇.
  double damping = 0,                  ///< N·m·s/rad; N·s/m of a prismatic one
      stiffness = 0,                   ///< N·m/rad; N/m of a prismatic one
      rest = 0;                        ///< where its spring rests, rad or m
  double dry_friction = 0;             ///< N·m; N of a prismatic one
  std::optional<std::size_t> follows;  ///< the joint that it follows (`<mimic>`): an index into World::joints()
  /// What else holds it with others or in its place ("weld of arm and world", "the loop that m::j closes"), but for the joint that it
  /// follows.
  std::vector<std::string> held;
  /// What else of an MJCF acts on it ("tendon t"): tendons, MuJoCo's own actuators where they pull at control 0, a fluid.
  std::vector<std::string> pulled;
  bool closes_loop = false;  ///< a constraint holds its two links together: it has no angle, and no handle
  /// Revolute or prismatic, and closes no loop: one with a handle, an angle and a speed.
  [[nodiscard]] bool one_axis() const noexcept { return !closes_loop && (type == Type::revolute || type == Type::prismatic); }
};

}  // namespace vsa::engine
