// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The embedded simulator for C++ users.
//
//   auto world = vsa::engine::World::load("snake_flat.sdf");
//   world.command("joint_1", 0.5, 0.2);
//   world.run(2.0);
//   auto now = world.read("joint_1");
//
// A World owns time. The same inputs give the same bits; snapshot()/restore() are bit-exact; reset() returns to the first sample.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/plugin_xml.hpp"
#include "vsa/config/preset.hpp"
#include "vsa/engine/handles.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::seat {
class Seat;
}

namespace vsa::engine {

/// Collision meshes that aren't convex, which the engine would fill to their hulls without a word. A <mesh> that says
/// optimization="convex_hull" or "convex_decomposition" has its own way.
enum class Concave {
  refuse,
  hull,      ///< filled to the convex hull, and warned of
  decompose  ///< cut into convex parts (at most 3000 triangles), and warned of
};

struct WorldOptions {
  std::optional<double> step_s;  ///< none: the SDF's <physics><max_step_size>
  config::PresetLibrary presets{};
  config::Replacement actuator{};                 ///< puts another actuator on the world's robots
  std::vector<std::filesystem::path> model_path;  ///< searched for model:// URIs after Gazebo's variables and the built-in models
  Concave concave = Concave::refuse;
  bool actuators = true;  ///< false: no robots, so no torques and no substeps; for measuring the engine alone
};

/// A blow-up: the state is no longer finite or an engine warning was raised. what() names time, joint and value.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Pose {
  std::array<double, 3> position{};              ///< m, world
  std::array<double, 4> quaternion{1, 0, 0, 0};  ///< w x y z
};

/// Geometry for pictures; primitive kinds as in SDF.
struct Shape {
  enum class Kind { box, sphere, cylinder, capsule, plane, mesh, heightmap } kind = Kind::box;
  Pose pose;                     ///< in its link
  std::array<double, 3> size{};  ///< box x y z; sphere r; cylinder/capsule r, length; plane x y; mesh: scale; heightmap: extent
  std::array<float, 4> rgba{0.7f, 0.7f, 0.7f, 1};
  std::vector<float> vertices;  ///< mesh and heightmap: triangles' corners, xyz each, link frame
  std::vector<std::uint32_t> indices;
};

struct LinkInfo {
  std::string name;   ///< scoped: "model::link"
  std::string model;  ///< top-level model
  double mass_kg = 0;
  bool is_static = false;
  std::vector<Shape> visuals;  ///< the SDF's visuals (collisions where a link has none)
};

/// A spring from a point of a link to a place in the world, as a hand pulls: F = k·(target − p) − c·ṗ with its damper, never more
/// than force_max_N. Worked out implicitly, so that no stiffness of it shakes a light link.
struct Pull {
  std::size_t link = 0;              ///< into links(); one that isn't static
  std::array<double, 3> point_m{};   ///< in the link's frame
  std::array<double, 3> target_m{};  ///< in the world
  double stiffness_N_per_m = 100;    ///< k, 0 … 1e5
  double damping_Ns_per_m = 5;       ///< c, 0 … 1e4
  double force_max_N = 20;           ///< 0 … 1e4
};

/// Where two bodies touched in the last step.
struct Contact {
  std::array<double, 3> position{};  ///< m, world
  std::array<double, 3> force_N{};   ///< world; on `link` by `other`
  std::size_t link = 0, other = 0;   ///< into links(); `link` isn't static
};

struct ActuatorRef {
  std::string model;                 ///< top-level model's name
  std::string name;                  ///< the actuator's
  std::size_t robot = 0, index = 0;  ///< into robots(), and the robot's own index
};

/// A world that was moved from throws std::logic_error from everything but its destructor and assignment.
class World {
 public:
  /// A file, or the name of a built-in world ("snake_flat.sdf"). Throws InputError with all problems. Safe from several
  /// threads at once (reading takes turns); a World itself belongs to one thread, but for commands. The second World of a file
  /// that hasn't changed takes milliseconds: what was read is kept (docs/explanation/8-engine.md). Presets are read each time.
  [[nodiscard]] static World load(const std::filesystem::path& sdf, WorldOptions options = {});
  [[nodiscard]] static World load_string(std::string_view sdf, WorldOptions options = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  /// Another world that goes on just as this one would: state, parameters, hands and what reset() returns to. What was read of the
  /// file and the engine's model are shared. Commands that no step has taken yet aren't taken along. Each clone may have a thread
  /// of its own.
  [[nodiscard]] World clone() const;

  [[nodiscard]] const std::string& name() const;  ///< the SDF world's
  [[nodiscard]] double step_s() const;
  /// How many steps of engine and actuators together are made of one of the world's: the robots' <substeps>, else 1. Firmware, bus,
  /// sensors, contacts and hands know those only; time, samples and commands' beginnings are the world's steps'.
  [[nodiscard]] int substeps() const;
  [[nodiscard]] std::int64_t time_ns() const;
  [[nodiscard]] double time_s() const;

  /// One step, of substeps() where there are several; throws SimulationError on a blow-up and stays where it was before.
  void step();
  /// Whole steps until `duration_s` more has passed, 0 … 1e9 s: a part of a step counts as one. Else: InputError.
  void run(double duration_s);

  // Actuators, by name ("joint_1", or "model/joint_1" where several models have it) or reference.
  [[nodiscard]] const std::vector<ActuatorRef>& actuators() const;
  [[nodiscard]] const ActuatorRef& actuator(std::string_view name) const;  ///< throws InputError with the names there are
  /// From any thread, as host::Robot::command; by reference nothing is searched and nothing allocated. A reference of another
  /// world: InputError, here and below.
  bool command(std::string_view actuator, double equilibrium_rad, double preset);
  bool command(const ActuatorRef& actuator, double equilibrium_rad, double preset);
  /// Puts an actuator and its joint somewhere without a kick: see host::Robot::place. InputError beyond the joint's limits, too.
  void place(std::string_view actuator, double angle_rad, double preset, double speed_rad_per_s = 0);
  void place(const ActuatorRef& actuator, const host::Placement& at);
  [[nodiscard]] host::ActuatorReading read(std::string_view actuator) const;
  [[nodiscard]] host::ActuatorReading read(const ActuatorRef& actuator) const;
  [[nodiscard]] std::size_t robot_count() const;
  /// From 0 to robot_count() − 1; else InputError.
  [[nodiscard]] host::Robot& robot(std::size_t index);
  [[nodiscard]] const host::Robot& robot(std::size_t index) const;
  [[nodiscard]] const std::string& robot_model(std::size_t index) const;  ///< scoped model name
  /// A robot's ports, topics and faults (vsa/seat/seat.hpp). Its steps, joints, snapshots and reset are the world's.
  [[nodiscard]] seat::Seat& seat(std::size_t index);

  // Bodies
  [[nodiscard]] const std::vector<LinkInfo>& links() const;
  void poses(std::span<Pose> out) const;  ///< one an entry of links(); another size: InputError
  [[nodiscard]] std::array<double, 3> center_of_mass(std::string_view model) const;
  [[nodiscard]] const std::vector<JointInfo>& joints() const;
  [[nodiscard]] JointHandle joint(std::string_view scoped_joint) const;  ///< one with one axis; else InputError with their names
  [[nodiscard]] JointHandle joint(const ActuatorRef& actuator) const;    ///< that it drives
  [[nodiscard]] LinkHandle link(std::string_view scoped_link) const;
  [[nodiscard]] double joint_angle(std::string_view scoped_joint) const;
  [[nodiscard]] double joint_angle(JointHandle joint) const;
  [[nodiscard]] double joint_speed(std::string_view scoped_joint) const;
  [[nodiscard]] double joint_speed(JointHandle joint) const;
  /// Sets a one-axis joint's angle and speed (kicks, initial conditions), ±1e12; other state stays, its actuator's too: place()
  /// moves that along.
  void set_joint(std::string_view scoped_joint, double angle, double speed);
  void set_joint(JointHandle joint, double angle, double speed);
  [[nodiscard]] Pose pose(LinkHandle link) const;
  [[nodiscard]] Twist velocity(LinkHandle link) const;
  /// Moves a model that isn't fixed to the world (initial conditions): adds a yaw about the world's z axis and a translation, ±1e6.
  void displace_model(std::string_view model, double yaw_rad, std::array<double, 3> translation);
  /// Makes the present state the one that reset() returns to.
  void make_initial();

  /// Kinetic and gravitational energy of all bodies and that of the SDF's own joint springs, J, co-located with the actuators'
  /// ledger (see host/robot.hpp): velocities v with positions q − (dt/2)·v.
  struct Energy {
    double kinetic = 0, gravitational = 0, springs = 0;
  };
  [[nodiscard]] Energy energy() const;
  [[nodiscard]] actuator::Ledger ledger() const;  ///< over all robots
  [[nodiscard]] int contact_count() const;
  /// The contacts that the last step (of several substeps: the last one) worked with, each pair of points once; none before the
  /// first step and after a restore or reset. Clears `out` first.
  void contacts(std::vector<Contact>& out) const;

  /// From the next step on these hands pull, and no others; none lets go. They are no part of the state: reset() lets go of all,
  /// restore() leaves them as they are. Throws InputError for an unknown or static link and numbers out of range.
  void pull(std::vector<Pull> pulls);
  [[nodiscard]] const std::vector<Pull>& pulls() const;

  /// Acts in every step from the next on, until it is set anew; one a link, zero ends it. As pulls, wrenches and torques are no
  /// part of the state: reset() ends all, restore() leaves them. InputError: a static link, numbers out of range.
  void apply_wrench(LinkHandle link, const Wrench& wrench);
  /// The same on a joint with one axis (N·m, or N on a prismatic one; ±1e9), beside what its actuator gives where it has one.
  void apply_torque(JointHandle joint, double torque_Nm);

  /// Degrees of freedom v, in the engine's order: JointInfo::dof and free_dof() tell whose they are. In all below M v̇ + bias =
  /// torques: bias is what has to be given for v̇ = 0 against gravity and the motion's own forces; springs, dampers and contacts
  /// aren't in it. They hold for joint_angle(), joint_speed() as they are now. Spans of another size: InputError.
  [[nodiscard]] std::size_t dof_count() const;
  /// The first of six of a link that flies free: velocity of its origin in world axes, angular velocity in its own. None: it
  /// doesn't.
  [[nodiscard]] std::optional<std::size_t> free_dof(LinkHandle link) const;
  void mass_matrix(std::span<double> out) const;  ///< dof_count()², symmetric
  void bias_torques(std::span<double> out) const;
  void gravity_torques(std::span<double> out) const;  ///< bias at rest
  /// 6 × dof_count() by rows: velocity of a point of the link (in its frame), then angular velocity, both in world axes, a v.
  void jacobian(LinkHandle link, const std::array<double, 3>& point_m, std::span<double> out) const;

  struct Snapshot;
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;
  /// Of this world or of another of the same file (the same links, joints and robots; the step may differ): between those it is as
  /// exact as within one. Any other: InputError, and nothing changed.
  void restore(const Snapshot& snapshot);
  void reset();

  [[nodiscard]] const std::vector<std::string>& warnings() const;  ///< what the SDF has and the engine leaves out

 private:
  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  [[nodiscard]] std::size_t at(JointHandle joint) const;
  [[nodiscard]] std::size_t at(LinkHandle link) const;
  [[nodiscard]] std::size_t at(const ActuatorRef& actuator) const;
  Owner<Impl> impl_;
};

}  // namespace vsa::engine
