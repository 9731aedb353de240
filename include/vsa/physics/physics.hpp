// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The door to a physics engine. A step has two halves, so that torques can follow from positions and from what the engine has
// worked out for them:
//
//   prepare()      everything that depends on the present state: poses, inertia, contacts
//   apply(j, τ)    for every driven joint; what isn't applied is zero
//   advance()      v' = v + dt·a(q, v, τ), q' = q + dt·v'   (semi-implicit Euler)
//
// States: positions, velocities, and what an engine carries over as a first guess: as numbers (vsa/state.hpp), all that decides what
// comes next. Equal numbers, equal future.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vsa/errors.hpp"
#include "vsa/physics/error.hpp"
#include "vsa/scene/energy.hpp"
#include "vsa/scene/link_parameters.hpp"
#include "vsa/scene/pose.hpp"
#include "vsa/scene/touch.hpp"
#include "vsa/state.hpp"

namespace vsa::description {
struct Capabilities;
struct World;
}  // namespace vsa::description

namespace vsa::physics {

/// Of a joint with one axis: rad and rad/s, or m and m/s.
struct JointState {
  double position = 0,  ///< rad or m
      speed = 0;        ///< rad/s or m/s
};

/// Where kinematic loops are (Physics::loops_with).
struct LoopPosture {
  std::vector<std::pair<std::size_t, JointState>> along;  ///< joints with one axis that go along, and where they are then
  std::vector<double> numbers;                            ///< the engine's; none: the joint is in no loop, set_joint() is all
};

/// Why a step was refused.
struct Refusal {
  std::string where;     ///< "joint m::j", "link m::l", or the engine
  std::string quantity;  ///< "acceleration", "position", an engine's warning
  double value = 0;      ///< what it was
};

/// Masses and frictions of all links as an engine works with them. Never changed, so that several threads may share one.
class Bodies {
 public:
  virtual ~Bodies() = default;
  [[nodiscard]] virtual std::span<const scene::LinkParameters> links() const = 0;  ///< by link
};

/// One world's bodies in an engine, in motion: prepare(), apply(), advance(). One thread at a time; indices of links and joints are
/// those of description::World.
class Physics {
 public:
  virtual ~Physics() = default;

  virtual void prepare() = 0;  ///< first half of a step; clears what was applied
  /// Before it: joints with actuators stiffer than a step resolves; all others aren't. In their trees limits, contacts and frictions count
  /// in mobility() and foresee() as equalities do.
  virtual void set_stiff(std::span<const std::size_t> joints) = 0;
  /// After it: whether such a constraint is there for one of those joints, so that B is another than in the step before.
  [[nodiscard]] virtual bool is_held(std::span<const std::size_t> joints) const = 0;
  /// One-axis joints whose torques move each other, by groups: indices into `joints`. Fixed for a world.
  [[nodiscard]] virtual std::vector<std::vector<std::size_t>> trees(std::span<const std::size_t> joints) const = 0;
  /// B of those joints: how advance() answers to torques, (v' − v)/dt = … + B τ, contacts, limits and frictions aside but those
  /// that hold set_stiff() joints. By rows, 1/(kg·m²); between foresee() and advance().
  virtual void mobility(std::span<const std::size_t> joints, std::span<double> out) = 0;
  /// B_jj of each of those joints if nothing held it, 1/(kg·m²); after prepare().
  virtual void free_mobility(std::span<const std::size_t> joints, std::span<double> out) = 0;
  /// The same without prepare(), and but for dampers.
  virtual void first_mobility(std::span<const std::size_t> joints, std::span<double> out) = 0;
  /// The same with all joints at their zeros, whatever they are at.
  virtual void zero_mobility(std::span<const std::size_t> joints, std::span<double> out) const = 0;
  /// For each of those joints a number, equal where their trees may ever touch each other, or the same thing. Fixed for a world.
  [[nodiscard]] virtual std::vector<std::size_t> neighbours(std::span<const std::size_t> joints) const = 0;
  /// Degrees of freedom that change B of those joints without being theirs. Fixed for a world.
  [[nodiscard]] virtual std::vector<std::size_t> beside(std::span<const std::size_t> joints) const = 0;
  /// How far the fastest of such goes in the next step at its present speed, rad; a slide counts ten radians for a metre. 0: of none.
  [[nodiscard]] virtual double turned_rad(std::span<const std::size_t> dofs) const = 0;
  /// How advance() would accelerate those joints, rad/s² or m/s², if what pushes the bodies stayed as it was in the last step
  /// (apply(), contacts and limits; nothing before the first); what follows from positions and speeds, dampers and equalities
  /// among it, and what was pushed by now, is of now. Between prepare() and apply().
  virtual void foresee(std::span<const std::size_t> joints, std::span<double> out) = 0;
  /// Whether with these torques on such joints, and on others those of the last call or else of the last step, other limits, contacts and
  /// frictions hold than those that these joints were told of last, by foresee() or here. If so, tells of those: how advance() would
  /// accelerate the joints, rad/s², and mobility(). Between foresee() and apply().
  virtual bool holds_else(std::span<const std::size_t> joints, std::span<const double> torques, std::span<double> accelerations,
                          std::span<double> mobility) = 0;
  /// Adds to what is applied to a driven one-axis joint, N·m or N.
  virtual void apply(std::size_t joint, double torque) = 0;
  /// Adds the spring's force to what is applied, as if all else pushed as in the last step; after all push(), before foresee().
  virtual void pull(const scene::Pull& pull) = 0;
  /// A fault leaves the state as it was at prepare().
  [[nodiscard]] virtual std::optional<Refusal> advance() = 0;

  [[nodiscard]] virtual JointState joint(std::size_t joint) const = 0;  ///< one-axis joints
  virtual void set_joint(std::size_t joint, JointState state) = 0;      ///< of a one-axis joint; contacts() are void then

  virtual void poses(std::span<scene::Pose> links) const = 0;  ///< of all links, by index
  /// Of those together, m, world.
  [[nodiscard]] virtual std::array<double, 3> center_of_mass(std::span<const std::size_t> links) const = 0;
  /// Turns about the world's z axis and shifts every free body among `links`. False where one of them is tied to the world.
  [[nodiscard]] virtual bool displace(std::span<const std::size_t> links, double yaw, const std::array<double, 3>& shift) = 0;
  /// With positions moved back by half a step, velocities as they are.
  [[nodiscard]] virtual scene::Energy energy() const = 0;
  [[nodiscard]] virtual int contact_count() const = 0;                     ///< at the present positions
  [[nodiscard]] virtual std::vector<scene::Overlap> overlaps() const = 0;  ///< likewise; each pair of links once
  virtual void contacts(std::vector<scene::Contact>& out) const = 0;  ///< of the last advance(); none where the state was set since

  [[nodiscard]] virtual StateLayout state_layout() const = 0;  ///< of the numbers of save()
  [[nodiscard]] virtual std::size_t state_size() const = 0;    ///< how many
  /// state_size() numbers; nothing is allocated.
  virtual void save(std::span<double> out) const = 0;
  virtual void restore(std::span<const double> in) = 0;  ///< finite numbers

  /// The same world in the same state, with data of its own.
  [[nodiscard]] virtual std::unique_ptr<Physics> clone() const = 0;
  /// What users apply, before foresee().
  virtual void push(std::size_t joint, double torque) = 0;
  /// On a link, in world axes.
  virtual void push(std::size_t link, const scene::Wrench& wrench) = 0;

  /// How many degrees of freedom. As the next ones, of the present state and in engine::World's order.
  [[nodiscard]] virtual std::size_t dofs() const = 0;
  [[nodiscard]] virtual std::optional<std::size_t> joint_dof(std::size_t joint) const = 0;  ///< the first of a joint; none: fixed
  /// The first of six of a link that flies free; else none.
  [[nodiscard]] virtual std::optional<std::size_t> free_dof(std::size_t link) const = 0;
  [[nodiscard]] virtual scene::Pose pose(std::size_t link) const = 0;       ///< now, world
  [[nodiscard]] virtual scene::Twist velocity(std::size_t link) const = 0;  ///< now, world axes
  virtual void mass_matrix(std::span<double> out) const = 0;                ///< M, dofs()² numbers by rows
  virtual void bias(std::span<double> out, bool moving) const = 0;          ///< moving: at the present speeds, else at rest
  /// 6 × dofs() by rows, as engine::World::jacobian().
  virtual void jacobian(std::size_t link, const std::array<double, 3>& point, std::span<double> out) const = 0;

  /// What the links weigh and how they rub, now.
  [[nodiscard]] virtual std::shared_ptr<const Bodies> bodies() const = 0;
  /// `base` of links with these parameters, one a link, which the caller has checked (engine::World::parameters_with). Those in
  /// force and the state stay.
  [[nodiscard]] virtual std::shared_ptr<const Bodies> bodies_with(const Bodies& base,
                                                                  std::span<const scene::LinkParameters> links) = 0;
  /// Goes on with those; the state stays. InputError, here and above: of another world.
  virtual void use(std::shared_ptr<const Bodies> bodies) = 0;

  /// Where a joint's kinematic loops are once it is put somewhere and the joints that aren't `held` go along; nothing has changed yet.
  /// None: they don't get there from where they are. An engine without loops has none to take along.
  [[nodiscard]] virtual std::optional<LoopPosture> loops_with(std::size_t joint, JointState state,
                                                              std::span<const std::size_t> held) {
    static_cast<void>(joint), static_cast<void>(state), static_cast<void>(held);
    return LoopPosture{};
  }
  virtual void take(const LoopPosture& posture) { static_cast<void>(posture); }  ///< one of loops_with() at this state
};

/// What an engine makes of a description, the same for all who step it; never changed.
class CompiledWorld {
 public:
  virtual ~CompiledWorld() = default;
  [[nodiscard]] virtual std::unique_ptr<Physics> start() const = 0;  ///< at its joints' zeros
};

/// A physics engine: makes of a description what steps it. Give it to engine::WorldOptions.
class Engine {
 public:
  virtual ~Engine() = default;
  /// What it can simulate; the rest of a description is refused or left out.
  [[nodiscard]] virtual const description::Capabilities& capabilities() const = 0;
  /// Adds to `problems` and returns null where it can't. Safe from several threads.
  [[nodiscard]] virtual std::shared_ptr<const CompiledWorld> compile(const std::shared_ptr<const description::World>& world,
                                                                     double step_s, std::string_view file,
                                                                     Problems& problems) const = 0;
};

}  // namespace vsa::physics
