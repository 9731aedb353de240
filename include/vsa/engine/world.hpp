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
#include <utility>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/engine/handles.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/host/simulation.hpp"
#include "vsa/motion/stage.hpp"
#include "vsa/physics/error.hpp"
#include "vsa/scene/link_parameters.hpp"
#include "vsa/sdf/concave.hpp"
#include "vsa/sdf/impossible_inertia.hpp"

namespace vsa::physics {
class Engine;
}
namespace vsa::seat {
class Seat;
}

namespace vsa::engine {

using physics::SimulationError;
using reader::Concave;
using reader::ImpossibleInertia;

inline constexpr double kShortestStep_s = 1e-6,  ///< of a world's step
    kLongestStep_s = host::kLongestStep_s;       ///< of a world's step

/// How a world is to be loaded, beside its file: World::load().
struct WorldOptions {
  std::optional<double> step_s;                   ///< none: the SDF's `<physics><max_step_size>`
  config::TypeLibrary types{};                    ///< where the types that the file names are looked for
  config::Replacement actuator{};                 ///< puts another actuator on the world's robots
  std::vector<std::filesystem::path> model_path;  ///< searched for model:// URIs after Gazebo's variables and the built-in models
  Concave concave = Concave::refuse;              ///< what becomes of a mesh that collides and isn't convex
  ImpossibleInertia impossible_inertia = ImpossibleInertia::refuse;  ///< what becomes of an inertia that no body can have
  bool actuators = true;  ///< false: no robots, so no torques and no substeps; for measuring the engine alone
  std::shared_ptr<const physics::Engine> physics{};  ///< that moves the bodies (vsa/physics/physics.hpp); none: MuJoCo
};

using scene::Contact;
using scene::LinkInfo;
using scene::LinkParameters;
using scene::Pose;
using scene::Pull;
using scene::Shape;

/// An actuator by number instead of by name: one of World::actuators(). Good for every world of the same file; any other refuses
/// it.
struct ActuatorRef {
  std::string model;      ///< top-level model's name
  std::string name;       ///< the actuator's
  std::size_t robot = 0,  ///< into robots()
      index = 0;          ///< the robot's own index of it
};

/// Other parameters for some of a world's actuators and links; of an actuator `unit`, and `type` and `changed` that tell of it.
struct ParameterChanges {
  std::vector<std::pair<ActuatorRef, host::ActuatorConfig>> actuators;  ///< each with the parameters that it is to have
  std::vector<std::pair<LinkHandle, LinkParameters>> links;             ///< each with the parameters that it is to have
};

/// The embedded simulator: bodies and contacts, actuators with their firmware and buses. It owns time; the same inputs give the
/// same bits. One that was moved from throws std::logic_error from everything but its destructor, assignment, has_contacts() and
/// has_hands(). A motion::Gait plays on it.
class World : public motion::Stage, public host::Simulation {
 public:
  /// A file, or the name of a built-in world ("snake_flat.sdf"). Throws InputError with all problems. Safe from several
  /// threads at once (reading takes turns); a World itself belongs to one thread, but for commands. The second World of a file
  /// that hasn't changed takes milliseconds: what was read is kept (docs/explanation/8-engine.md). Actuator types are read each time.
  [[nodiscard]] static World load(const std::filesystem::path& sdf, WorldOptions options = {});
  [[nodiscard]] static World load_string(std::string_view sdf, WorldOptions options = {});  ///< from a file's text
  ~World() override;
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  /// Another world that goes on just as this one would: state, parameters, hands and what reset() returns to. What was read of the
  /// file and the engine's model are shared. Commands that no step has taken yet aren't taken along. Each clone may have a thread
  /// of its own.
  [[nodiscard]] World clone() const;

  [[nodiscard]] const std::string& name() const override;  ///< the SDF world's
  [[nodiscard]] double step_s() const override;            ///< of the world; a part of it is 1/substeps()
  /// How many steps of engine and actuators together are made of one of the world's: the robots' `<substeps>`, else 1. Firmware,
  /// bus, sensors, contacts and hands know those only; time, samples and commands' beginnings are the world's steps'.
  [[nodiscard]] int substeps() const;
  [[nodiscard]] std::int64_t time_ns() const override;  ///< since the first sample

  /// One step, of substeps() where there are several; throws SimulationError on a blow-up and stays where it was before.
  void step();
  /// Whole steps until `duration_s` more has passed, 0 … 1e9 s: a part of a step counts as one. Else: InputError.
  void run(double duration_s);

  [[nodiscard]] const std::vector<ActuatorRef>& actuators() const;  ///< of all robots, robot by robot
  /// By "joint_1", "model/joint_1" or "outer/model/joint_1", as far as it takes to tell it from all others; throws InputError with
  /// the names there are.
  [[nodiscard]] const ActuatorRef& actuator(std::string_view name) const;
  /// The shortest that actuator() understands: "joint_1", "model/joint_1", or by a nested model's whole name "outer/model/joint_1".
  [[nodiscard]] std::string name_of(const ActuatorRef& ref) const;
  /// From any thread, as host::Robot::command; by reference nothing is searched and nothing allocated. A reference of another
  /// world: InputError, here and below.
  bool command(std::string_view actuator, double equilibrium_rad, double preset);
  bool command(const ActuatorRef& actuator, double equilibrium_rad, double preset);  ///< by reference
  /// Puts an actuator and its joint somewhere without a kick: see host::Robot::place. Its kinematic loops go along, other actuators of
  /// theirs only where the loops leave no other way; joints that were put since the last step stay. InputError beyond the joint's limits,
  /// where its loops don't get there from where they are (a dead centre counts as not reached where there is a speed), and where they
  /// would take another joint beyond its limits; nothing has changed then.
  void place(std::string_view actuator, double angle_rad, double preset, double speed_rad_per_s = 0);
  void place(const ActuatorRef& actuator, const host::Placement& at);           ///< by reference
  [[nodiscard]] host::ActuatorReading read(std::string_view actuator) const;    ///< at the end of the last step
  [[nodiscard]] host::ActuatorReading read(const ActuatorRef& actuator) const;  ///< by reference
  [[nodiscard]] std::size_t robot_count() const override;                       ///< one per plug-in element
  /// From 0 to robot_count() − 1; else InputError.
  [[nodiscard]] host::Robot& robot(std::size_t index) override;
  [[nodiscard]] const host::Robot& robot(std::size_t index) const override;        ///< to look at
  [[nodiscard]] const std::string& robot_model(std::size_t index) const override;  ///< scoped model name
  /// A robot's ports, topics and faults (vsa/seat/seat.hpp). Its steps, joints, snapshots and reset are the world's.
  [[nodiscard]] seat::Seat& seat(std::size_t index);

  [[nodiscard]] const std::vector<LinkInfo>& links() const override;  ///< in the file's order; static ones, too
  void poses(std::span<Pose> out) const override;                     ///< one an entry of links(); another size: InputError
  /// Of the links below that model (scoped name), m, world axes. InputError: no such model.
  [[nodiscard]] std::array<double, 3> center_of_mass(std::string_view model) const override;
  [[nodiscard]] const std::vector<JointInfo>& joints() const;             ///< of any kind, in the file's order
  [[nodiscard]] JointHandle joint(std::string_view scoped_joint) const;   ///< one with one axis; else InputError with their names
  [[nodiscard]] JointHandle joint(const ActuatorRef& actuator) const;     ///< that it drives
  [[nodiscard]] LinkHandle link(std::string_view scoped_link) const;      ///< InputError with their names
  [[nodiscard]] double joint_angle(std::string_view scoped_joint) const;  ///< rad, or m of a prismatic one; after the last step
  [[nodiscard]] double joint_angle(JointHandle joint) const;              ///< by handle: no search
  [[nodiscard]] double joint_speed(std::string_view scoped_joint) const;  ///< rad/s, or m/s of a prismatic one
  [[nodiscard]] double joint_speed(JointHandle joint) const;              ///< by handle: no search
  /// Sets a one-axis joint's angle and speed (kicks, initial conditions), ±1e12, and those of joints that follow it (`<mimic>`); other
  /// state stays, its actuator's too: place() moves that along. Its kinematic loops go along as in place(); where they don't, the joint
  /// alone is set and the constraint pulls the loop together, so that all its joints may be set one by one. The others' speeds are those of
  /// half a step before, as the engine has them. InputError: an angle farther beyond the joint's limits than it is now (or than 0.05 rad,
  /// 5e-3 m), and a follower elsewhere than its leader has it (0.02 and 0.1 of speed are let pass).
  void set_joint(std::string_view scoped_joint, double angle, double speed);
  void set_joint(JointHandle joint, double angle, double speed);  ///< by handle: no search
  [[nodiscard]] Pose pose(LinkHandle link) const;                 ///< now, in the world
  [[nodiscard]] Twist velocity(LinkHandle link) const;            ///< now, in world axes
  /// Moves a model that isn't fixed to the world (initial conditions): adds a yaw about the world's z axis and a translation, ±1e6.
  void displace_model(std::string_view model, double yaw_rad, std::array<double, 3> translation);
  void make_initial();  ///< the present state becomes the one that reset() returns to

  /// Kinetic and gravitational energy of all bodies and that of the SDF's own joint springs, J, co-located with the actuators'
  /// ledger (see host/robot.hpp): velocities v with positions q − (dt/2)·v.
  using Energy = scene::Energy;
  [[nodiscard]] Energy energy() const;  ///< as it is now
  [[nodiscard]] std::optional<Energy> body_energy() const override { return energy(); }
  [[nodiscard]] actuator::Ledger ledger() const;  ///< over all robots
  [[nodiscard]] int contact_count() const;  ///< where bodies touch at their present positions; contacts() tells of the last step
  /// The contacts that the last step (of several substeps: the last one) worked with, each pair of points once; none before the
  /// first step and after a restore or reset. Clears `out` first.
  void contacts(std::vector<Contact>& out) const override;
  [[nodiscard]] bool has_contacts() const override { return true; }

  /// From the next step on these hands pull, and no others; none lets go. They are no part of the state: reset() lets go of all,
  /// restore() leaves them as they are. Throws InputError for an unknown or static link and numbers out of range.
  void pull(std::vector<Pull> pulls) override;
  [[nodiscard]] const std::vector<Pull>& pulls() const;                           ///< those that pull now
  [[nodiscard]] std::span<const Pull> hands() const override { return pulls(); }  ///< the same, as host::Simulation has it
  [[nodiscard]] bool has_hands() const override { return true; }

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
  void mass_matrix(std::span<double> out) const;      ///< dof_count()², symmetric
  void bias_torques(std::span<double> out) const;     ///< with the present speeds
  void gravity_torques(std::span<double> out) const;  ///< bias at rest
  /// 6 × dof_count() by rows: velocity of a point of the link (in its frame), then angular velocity, both in world axes, a v.
  void jacobian(LinkHandle link, const std::array<double, 3>& point_m, std::span<double> out) const;

  [[nodiscard]] const config::TypeLibrary& types() const;  ///< the actuators' types are from there
  /// In force. Parameters, the actuators' and the links', aren't state: reset() and restore() keep them; clone() takes them along.
  [[nodiscard]] LinkParameters link_parameters(LinkHandle link) const;
  /// From the next step on. What of it the engine derives follows; motion goes on. InputError: out of range, moments that no body has,
  /// another mass or inertia of a static link, friction of one without shapes. An actuator's: host::Robot::set_parameters.
  void set_link_parameters(LinkHandle link, const LinkParameters& to);
  /// All of them as one value that never changes and that worlds of this file share: those in force; others with changes, checked.
  struct Parameters;
  [[nodiscard]] std::shared_ptr<const Parameters> parameters() const;  ///< those in force
  /// `base` with those changes. Nothing in force changes. InputError with everything that is out of range, and for a base of
  /// another world.
  [[nodiscard]] std::shared_ptr<const Parameters> parameters_with(const Parameters& base, const ParameterChanges& changes) const;
  /// Those of one actuator in it.
  [[nodiscard]] const host::ActuatorConfig& actuator_parameters(const Parameters& of, const ActuatorRef& actuator) const;
  [[nodiscard]] LinkParameters link_parameters(const Parameters& of, LinkHandle link) const;  ///< those of one link in it
  /// As set_link_parameters() and host::Robot::set_parameters() of each that differs. InputError: of another world.
  void set_parameters(const Parameters& to);
  /// Goes on with those and leaves the state as it is, for one that came from a world with them. Each copy of a Batch is stepped so.
  /// InputError: of another world.
  void use(const Parameters& to);

  struct Snapshot;  ///< opaque, copyable: all of a world's state, without hands and parameters
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;  ///< allocates; exact to the bit
  /// Of this world or of another of the same file (the same links, joints and robots; the step may differ): between those it is as
  /// exact as within one. Any other: InputError, and nothing changed.
  void restore(const Snapshot& snapshot);
  /// Back to the first sample, or to what make_initial() kept; hands let go, commands that wait are dropped, parameters stay.
  void reset();

  /// The same as numbers (vsa/state.hpp): "world.time", the bodies' "physics/…", "robot[0]/elbow/unit.…". Worlds of the same file have
  /// the same layout. They go on bit for bit where the parameters are the same, too: those are no part of it, nor are hands, nor
  /// commands that no step has taken. save() and restore() allocate nothing but an error's text.
  ///   save     throws InputError where more is under way than the layout has room for (host/robot.hpp), as snapshot() never does
  ///   restore  throws InputError for another size and for numbers that no state has, and nothing has changed
  [[nodiscard]] StateLayout state_layout() const;
  [[nodiscard]] std::size_t state_size() const;    ///< how many numbers save() gives
  void save(std::span<double> out) const;          ///< fills state_size() numbers
  void restore(std::span<const double> in);        ///< as of a snapshot; kinds of units (host/unit_kind.hpp) go unseen
  [[nodiscard]] std::uint64_t state_hash() const;  ///< of the numbers that save() gives; allocates
  /// The numbers behind some that tell version, layout, kinds of units, and links' and actuators' parameters. restore_file throws
  /// InputError where those are others, for another length and a damaged one, and nothing has changed; save_file OutputError, and
  /// what was there stays.
  void save_file(const std::filesystem::path& file) const;
  void restore_file(const std::filesystem::path& file);  ///< as restore(), from such a file

  [[nodiscard]] const std::vector<std::string>& warnings() const override;  ///< what the SDF has and the engine leaves out

 private:
  // The rest of a motion::Stage, whose actuators are those of actuators().
  [[nodiscard]] std::size_t find_actuator(std::string_view name) const override;
  [[nodiscard]] const std::string& model_of(std::size_t actuator) const override;
  void send(std::size_t actuator, std::optional<double> equilibrium_rad, std::optional<double> preset) override;
  [[nodiscard]] motion::Commanded commanded(std::size_t actuator) const override;

  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  [[nodiscard]] std::size_t at(JointHandle joint) const;
  [[nodiscard]] std::size_t at(LinkHandle link) const;
  [[nodiscard]] std::size_t at(const ActuatorRef& actuator) const;
  void check_of_this_world(const Parameters& parameters) const;
  Owner<Impl> impl_;
};

}  // namespace vsa::engine
