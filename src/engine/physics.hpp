// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The door to a physics engine. A step has two halves, so that torques can follow from positions and from what the engine has
// worked out for them:
//
//   prepare()      everything that depends on the present state: poses, inertia, contacts
//   apply(j, τ)    for every driven joint; what isn't applied is zero
//   advance()      v' = v + dt·a(q, v, τ), q' = q + dt·v'   (semi-implicit Euler)
//
// States: positions, velocities, and what an engine carries over as a first guess (PhysicsState holds all that decides the next
// step).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "description.hpp"

namespace vsa::engine {

struct JointState {
  double position = 0, speed = 0;
};

/// All that decides what comes next. Equal values, equal future.
struct PhysicsState {
  std::vector<double> values;
};

/// Why a step was refused.
struct Fault {
  std::string where;     ///< "joint m::j", "link m::l", or the engine
  std::string quantity;  ///< "acceleration", "position", an engine's warning
  double value = 0;
};

class Physics {
 public:
  virtual ~Physics() = default;

  virtual void prepare() = 0;
  /// One-axis joints whose torques move each other, by groups: indices into `joints`. Fixed for a world.
  [[nodiscard]] virtual std::vector<std::vector<std::size_t>> trees(std::span<const std::size_t> joints) const = 0;
  /// B of those joints: how advance() answers to torques, (v' − v)/dt = … + B τ, contacts and limits aside. By rows, 1/(kg·m²);
  /// between prepare() and advance().
  virtual void mobility(std::span<const std::size_t> joints, std::span<double> out) = 0;
  virtual void apply(std::size_t joint, double torque) = 0;
  /// Adds the spring's force to what is applied; after all apply() of the step.
  virtual void pull(const Pull& pull) = 0;
  /// A fault leaves the state as it was at prepare().
  [[nodiscard]] virtual std::optional<Fault> advance() = 0;

  [[nodiscard]] virtual JointState joint(std::size_t joint) const = 0;  ///< one-axis joints
  virtual void set_joint(std::size_t joint, JointState state) = 0;

  virtual void poses(std::span<Pose> links) const = 0;
  [[nodiscard]] virtual Vec3 center_of_mass(std::span<const std::size_t> links) const = 0;
  /// Turns about the world's z axis and shifts every free body among `links`. False where one of them is tied to the world.
  [[nodiscard]] virtual bool displace(std::span<const std::size_t> links, double yaw, const Vec3& shift) = 0;
  /// With positions moved back by half a step, velocities as they are.
  [[nodiscard]] virtual World::Energy energy() const = 0;
  [[nodiscard]] virtual int contact_count() const = 0;
  virtual void contacts(std::vector<Contact>& out) const = 0;  ///< of the last advance(); none where the state was set since

  /// Into what was saved to before: allocates nothing.
  virtual void save(PhysicsState& into) const = 0;
  virtual void restore(const PhysicsState& state) = 0;

  /// The same world in the same state, with data of its own.
  [[nodiscard]] virtual std::unique_ptr<Physics> clone() const = 0;
  /// Add to what is applied; after all apply() of the step, before the pulls.
  virtual void push(std::size_t joint, double torque) = 0;
  virtual void push(std::size_t link, const Wrench& wrench) = 0;

  // Of the present state; degrees of freedom as in World.
  [[nodiscard]] virtual std::size_t dofs() const = 0;
  [[nodiscard]] virtual std::optional<std::size_t> joint_dof(std::size_t joint) const = 0;
  [[nodiscard]] virtual std::optional<std::size_t> free_dof(std::size_t link) const = 0;
  [[nodiscard]] virtual Pose pose(std::size_t link) const = 0;
  [[nodiscard]] virtual Twist velocity(std::size_t link) const = 0;
  virtual void mass_matrix(std::span<double> out) const = 0;
  virtual void bias(std::span<double> out, bool moving) const = 0;  ///< moving: at the present speeds, else at rest
  virtual void jacobian(std::size_t link, const std::array<double, 3>& point, std::span<double> out) const = 0;
};

/// What an engine makes of a description, the same for all who step it; never changed.
class CompiledWorld {
 public:
  virtual ~CompiledWorld() = default;
  [[nodiscard]] virtual std::unique_ptr<Physics> start() const = 0;  ///< at its joints' zeros
};

/// Compiles the world for MuJoCo. Adds to `problems` and returns null where it can't.
[[nodiscard]] std::shared_ptr<const CompiledWorld> compile_mujoco(const std::shared_ptr<const WorldDescription>& world,
                                                                  double step_s, std::string_view file, Problems& problems);

}  // namespace vsa::engine
