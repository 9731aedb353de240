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
#include "vsa/host/robot.hpp"

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
  bool actuators = true;  ///< false: no torques, for measuring the engine alone
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

class World {
 public:
  /// A file, or the name of a built-in world ("snake_flat.sdf"). Throws InputError with all problems. Safe from several
  /// threads at once (reading takes turns); a World itself belongs to one thread, but for commands.
  [[nodiscard]] static World load(const std::filesystem::path& sdf, WorldOptions options = {});
  [[nodiscard]] static World load_string(std::string_view sdf, WorldOptions options = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  [[nodiscard]] const std::string& name() const noexcept;  ///< the SDF world's
  [[nodiscard]] double step_s() const noexcept;
  [[nodiscard]] std::int64_t time_ns() const noexcept;
  [[nodiscard]] double time_s() const noexcept;

  /// One step; throws SimulationError on a blow-up and stays where it was before.
  void step();
  /// Whole steps until `duration_s` more has passed.
  void run(double duration_s);

  // Actuators, by name ("joint_1", or "model/joint_1" where several models have it) or reference.
  [[nodiscard]] const std::vector<ActuatorRef>& actuators() const noexcept;
  [[nodiscard]] const ActuatorRef& actuator(std::string_view name) const;  ///< throws InputError with the names there are
  bool command(std::string_view actuator, double equilibrium_rad, double preset);
  [[nodiscard]] host::ActuatorReading read(std::string_view actuator) const;
  [[nodiscard]] host::ActuatorReading read(const ActuatorRef& actuator) const;
  [[nodiscard]] std::size_t robot_count() const noexcept;
  [[nodiscard]] host::Robot& robot(std::size_t index) noexcept;
  [[nodiscard]] const host::Robot& robot(std::size_t index) const noexcept;
  [[nodiscard]] const std::string& robot_model(std::size_t index) const noexcept;  ///< scoped model name

  // Bodies
  [[nodiscard]] const std::vector<LinkInfo>& links() const noexcept;
  void poses(std::span<Pose> out) const;  ///< one an entry of links()
  [[nodiscard]] std::array<double, 3> center_of_mass(std::string_view model) const;
  [[nodiscard]] double joint_angle(std::string_view scoped_joint) const;
  [[nodiscard]] double joint_speed(std::string_view scoped_joint) const;
  /// Sets a one-axis joint's angle and speed (kicks, initial conditions); other state stays.
  void set_joint(std::string_view scoped_joint, double angle, double speed);
  /// Moves a model that isn't fixed to the world (initial conditions): adds a yaw about the world's z axis and a translation.
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
  [[nodiscard]] int contact_count() const noexcept;
  /// The contacts that the last step worked with, each pair of points once; none before the first step and after a restore or
  /// reset. Clears `out` first.
  void contacts(std::vector<Contact>& out) const;

  /// From the next step on these hands pull, and no others; none lets go. They are no part of the state: reset() lets go of all,
  /// restore() leaves them as they are. Throws InputError for an unknown or static link and numbers out of range.
  void pull(std::vector<Pull> pulls);
  [[nodiscard]] const std::vector<Pull>& pulls() const noexcept;

  struct Snapshot;
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;
  void restore(const Snapshot& snapshot);
  void reset();

  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept;  ///< what the SDF has and the engine leaves out

 private:
  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::engine
