// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A World's insides. States: physics, time and step count, and the robots' seats; Snapshot holds them all.
#pragma once

#include <map>

#include "vsa/description/world.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/physics/physics.hpp"
#include "vsa/sdf/read.hpp"
#include "vsa/seat/seat.hpp"
#include "vsa/seat/seat_group.hpp"

namespace vsa::engine {

struct World::Snapshot {
  std::shared_ptr<const description::World> world;
  std::vector<double> physics;
  std::int64_t time_ns = 0, steps = 0;
  std::vector<std::shared_ptr<const seat::Seat::Snapshot>> robots;
};

/// One <plugin>: a robot and its joints in the engine.
struct RobotSlot {
  std::unique_ptr<seat::Seat> seat;
  std::vector<std::size_t> joints;  ///< of its actuators, into description::World::joints
  std::vector<std::size_t> beside;  ///< degrees of freedom that change their B, too (physics::Physics::beside)

  [[nodiscard]] host::Robot& robot() const { return seat->robot(); }
};

/// Who is called what, made once and shared with clones.
struct WorldNames {
  static constexpr std::size_t kSeveral = static_cast<std::size_t>(-1);
  std::vector<JointInfo> joints;
  std::map<std::string, std::size_t, std::less<>> joint, link;     ///< by scoped name; joint: those with one axis
  std::map<std::string, std::size_t, std::less<>> full, actuator;  ///< into actuators, or kSeveral; by model/name, by name
  std::vector<std::size_t> first_actuator;                         ///< of each robot, into actuators
  std::uint32_t tag = 0;                                           ///< of links and joints; never 0
};

/// Throws InputError where the two differ in what a snapshot's numbers stand for.
/// InputError about `what`, where those aren't the same links and joints.
void check_same_world(const char* what, const description::World& theirs, const description::World& ours);
[[nodiscard]] std::uint32_t tag_of(const description::World& world);
[[nodiscard]] std::string list(std::vector<std::string> names);  ///< "a, b, c" without doubles

struct World::Impl {
  WorldOptions options;
  std::shared_ptr<const description::World> world;
  std::shared_ptr<const WorldNames> names;
  std::vector<std::string> warnings;
  std::unique_ptr<physics::Physics> physics;
  std::vector<RobotSlot> robots;
  seat::SeatGroup group;                        ///< of the robots
  std::vector<std::vector<std::size_t>> trees;  ///< of driven joints that move each other, as the group knows them
  std::vector<std::size_t> driven;              ///< the robots' joints, one robot after the other
  std::vector<double> foreseen;                 ///< of those, in the step under way
  std::vector<std::size_t> stiff;               ///< of those, too: scratch of a step, like the next two
  std::vector<double> alone;                    ///< B_jj of joints that nothing holds
  std::vector<char> begins_stiff;               ///< of driven
  std::vector<ActuatorRef> actuators;
  std::vector<Pull> pulls;
  std::vector<std::pair<std::size_t, Wrench>> wrenches;  ///< by link
  std::vector<std::pair<std::size_t, double>> torques;   ///< by joint
  std::vector<std::size_t> put_here;               ///< joints that were since the last step: they stay where their loops go along
  std::int64_t dt_ns = 0, time_ns = 0, steps = 0;  ///< dt_ns: of a step of `substeps`
  int substeps = 1;
  std::shared_ptr<const Snapshot> initial;
  std::vector<double> before;  ///< physics: the step under way, where physics takes back only the last of its substeps

  [[nodiscard]] static std::unique_ptr<Impl> load(const reader::SdfSource& source, WorldOptions options);
  void add_robots(const std::string& file, Problems& problems);
  void tell_overlaps();
  void tell_open_loops();
  void find_substeps(const std::string& file, Problems& problems);
  [[nodiscard]] std::int64_t substep_ns() const { return dt_ns / substeps; }
  [[nodiscard]] double substep_s() const { return static_cast<double>(substep_ns()) * 1e-9; }
  void step();
  void make_room();
  void find_first_stiff(double dt_s);
  void find_stiff();
  [[nodiscard]] std::optional<physics::Refusal> substep();
  class Holds;
  void keep();     ///< what a fault goes back to
  void go_back();  ///< to it
  void join_trees();
  [[nodiscard]] std::vector<std::vector<std::size_t>> find_trees();  ///< of driven
  void take_trees(std::vector<std::vector<std::size_t>> of_driven);
  void join_trees_anew();
  [[nodiscard]] std::vector<seat::Seat*> seats() const;
  void tell_joints(const RobotSlot& slot) const;
  void drive();
  void observe();
  void forget_mobility();                  ///< something was moved
  void renew_held();                       ///< B of robots that are stiff and held
  void placed(std::size_t joint);          ///< somebody put it there
  void set_followers(std::size_t leader);  ///< to where it is
  /// Where a joint's loops go along once it is put there, or why they don't; nothing has changed.
  struct Along {
    std::optional<physics::LoopPosture> posture;
    std::string refused;  ///< where there is none
  };
  [[nodiscard]] Along along(std::size_t joint, physics::JointState state);
  /// Puts a joint somewhere, its loops as found by along(), and its followers with it.
  void put(std::size_t joint, physics::JointState state, const physics::LoopPosture& posture);
  void push();  ///< what users apply
  void let_go();
  void index_names();
  [[nodiscard]] std::span<const std::size_t> links_of(std::string_view model) const;  ///< until it is called again
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;
  void check(const Snapshot& s) const;  ///< throws InputError where restore() would be wrong
  void restore(const Snapshot& s);
  [[nodiscard]] StateLayout state_layout() const;
  [[nodiscard]] std::size_t state_size() const;
  void save(std::span<double> out) const;
  void restore(std::span<const double> in);
};

}  // namespace vsa::engine
