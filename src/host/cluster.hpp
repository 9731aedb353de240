// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Buses and kinematic trees that hang together: a tree's joints are solved after the ticks of all buses that its units are on. A
// robot is stepped cluster by cluster, so that a unit's state is fetched once a step where a robot has a thousand.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "host/bus_line.hpp"
#include "vsa/device/joint_solver.hpp"

namespace vsa::host {

struct ActuatorSlot;
struct JointIn;

/// Joints that are solved together.
struct Tree {
  explicit Tree(std::size_t size) : solver(size) {}
  device::JointSolver solver;
  std::vector<device::JointInStep> joints;
  std::vector<std::size_t> actuators;
  std::size_t mobility_at = 0;  ///< where its matrix begins among the host's
  std::size_t index = 0;        ///< among those that the host joined
  bool joined = false;          ///< by the host: it may have a matrix
  std::vector<double> scratch;  ///< the diagonal where the host gives no matrix
  std::vector<double> torques;
};

/// A joint on a tree that other robots drive, too: whoever knows them all solves it (RobotGroup).
struct SharedJoint {
  device::JointInStep joint;
  std::size_t actuator = 0;
};

class Cluster {
 public:
  Cluster(std::vector<BusLine*> buses, std::vector<Tree> trees, std::vector<SharedJoint> shared);

  /// Where its units may write during a step; as many as it has, and clusters may share them. It stays where it is from now on.
  void use(std::span<device::StepPlan> plans) noexcept;

  /// Its joints have these units from now on, by actuator; none of their numbers is in lanes (leave()).
  void exchange(std::span<const std::shared_ptr<device::Unit>> units) noexcept;

  /// One host step of its units; how many of them the solver left unsettled.
  std::size_t advance(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<double> torques_out,
                      std::span<const double> mobility, device::Holder* holder) noexcept;
  /// The same in three; shared() are begun before run() and solved before end() by who knows them all.
  void begin(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<const double> mobility,
             const device::Holder* holder) noexcept;
  void run(std::int64_t t_ns, std::int64_t dt_ns) noexcept;
  std::size_t end(std::int64_t end_ns, std::span<double> torques_out, device::Holder* holder) noexcept;

  [[nodiscard]] std::span<const SharedJoint> shared() const noexcept { return shared_; }

  // Its units' numbers, as device::JointTrials has it.
  void leave() noexcept;
  void forget() noexcept;
  void keep() noexcept;
  void go_back() noexcept;

 private:
  /// Where a joint alone has its numbers.
  struct LoneFrom {
    std::size_t actuator = 0;
    std::optional<std::size_t> mobility_at;  ///< if the host joined it, with nothing
  };
  static void begin_tree(Tree& tree, std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in,
                         std::span<const double> mobility) noexcept;

  void find_whole() noexcept;
  [[nodiscard]] bool is_held(const device::Holder* holder) const noexcept;
  /// All of its ticks at that time.
  void tick(std::int64_t at_ns) noexcept;
  void settle_in(device::JointTrials& trials, std::span<const device::JointInStep> joints);
  template <class Does>
  void for_each_trials(Does&& does) noexcept;

  void begin_lone(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<const double> mobility) noexcept;

  std::vector<BusLine*> buses_;
  std::vector<Tree> trees_;  ///< those of one joint come last
  std::size_t lone_at_;      ///< the first of those
  std::vector<device::JointInStep> lone_;
  std::vector<LoneFrom> lone_from_;
  std::vector<double> lone_torques_;
  device::JointTrials lone_trials_;
  std::vector<SharedJoint> shared_;
  std::int64_t whole_ns_ = 0;  ///< a longer step is cut in some unit, which has to have its numbers at home
};

/// Whether a tick falls into the step other than at its start: what its sensors see must be foreseen.
[[nodiscard]] bool has_ticks_inside(std::int64_t t_ns, std::int64_t dt_ns) noexcept;
/// 1/(kg·m²): what is lighter than 1e-12 has no numbers left where its torque is worked out.
inline constexpr double kMostMobility = 1e12;
inline constexpr double kMostAcceleration = 1e12;  ///< rad/s², likewise
/// Whether a host's matrix can be used at all: bodies without mass have none.
[[nodiscard]] bool is_usable(std::span<const double> matrix, std::size_t n) noexcept;
/// Where the host has no matrix for a joint.
[[nodiscard]] double own_mobility(const device::Unit& unit, const JointIn& joint) noexcept;
/// Of one joint, with the entry of B that is its own.
void begin_step(const device::JointInStep& j, const JointIn& in, double inverse_inertia, std::int64_t t_ns,
                std::int64_t dt_ns) noexcept;

/// What they are made of. Every actuator that isn't shared gets a tree, if not by `trees` one of its own; every bus is in one cluster,
/// those of all that are shared in the same one.
struct ClusterParts {
  std::vector<BusLine*> buses;
  std::vector<std::size_t> bus_of;          ///< of an actuator
  std::vector<device::JointInStep> joints;  ///< by actuator; their plans come with Cluster::use
  std::vector<std::vector<std::size_t>> trees;
  std::vector<std::size_t> shared;
};
[[nodiscard]] std::vector<Cluster> make_clusters(const ClusterParts& parts);

}  // namespace vsa::host
