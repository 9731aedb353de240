// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The units of a tree's joints while their step is solved (device/joint_solver.hpp): tried for one displacement after another, each
// by itself or, where neighbours are of one type and their step is of the usual kind, side by side in lanes (vsa/lanes.hpp). A lane
// has the bits of the unit by itself, so which it is changes nothing but the time it takes.
//
// States: none between steps, but for joints that stay in lanes (stay()).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "vsa/lanes.hpp"

namespace vsa::device {

class Unit;
struct UnitState;
struct StepPlan;
struct LaneTable;

/// The whole torque on a shaft for a displacement Δy of its step.
template <class T>
struct ShaftTorqueOf {
  T torque = 0;                                     ///< N·m
  T slope = 0;                                      ///< −dτ/d(Δy), N·m/rad
  lanes::Truth<T> settled = lanes::truth<T>(true);  ///< the motors are found, so that this may be the answer
};
using ShaftTorque = ShaftTorqueOf<double>;  ///< of one unit

/// A joint while its step is solved; all three are the owner's.
struct JointInStep {
  Unit* unit = nullptr;        ///< of the joint's actuator
  UnitState* state = nullptr;  ///< of that unit
  StepPlan* plan = nullptr;    ///< begun by Unit::begin_step
};

/// What is known of each joint of a tree for the Δy that was tried last: as many numbers as it has joints.
struct TrialColumns {
  /// So many numbers in each column.
  explicit TrialColumns(std::size_t joints)
      : free(joints), last_torque(joints), dy(joints), torque(joints), slope(joints), carried(joints) {}
  std::vector<double> free,          ///< Δy without new torques
      last_torque;                   ///< the torques that it goes with, N·m
  std::vector<double> dy;            ///< of each unit's last attempt
  std::vector<double> torque,        ///< there, or where the solver took `carried` for it, N·m
      slope;                         ///< −dτ/d(Δy) there, N·m/rad
  std::vector<ShaftTorque> carried;  ///< what the last attempt foretells of a move from there
};

/// Tries the units of a tree's joints for one displacement after another, in lanes where they are alike, else one by one. One
/// thread.
class JointTrials {
 public:
  /// Everything that a step needs is allocated here, for so many joints that are solved together (0: all for solve_each).
  /// `instructions`: one of UnitBatch::instruction_sets(), and with it those of fewer lanes; empty: the fastest; "none": each unit by
  /// itself. InputError where this machine doesn't have them.
  explicit JointTrials(std::size_t joints, std::size_t together, std::string_view instructions = {});

  /// Begins the trials of a step: free, last_torque, and torque and slope as foreseen for free, at most `reach` away.
  void begin(std::span<const JointInStep> joints, TrialColumns& c, double reach) noexcept;
  /// Tries these displacements: torque and slope. `rough`: as Unit::attempt has it. Where `keep`, a unit whose `carried` is settled has
  /// that for its answer.
  void attempt(std::span<const JointInStep> joints, TrialColumns& c, std::span<const double> dy, bool rough, bool keep) noexcept;
  /// What the last attempts foretell of dy + move. Whether it may be the answer of all.
  bool carry(std::span<const JointInStep> joints, TrialColumns& c, std::span<const double> dy,
             std::span<const double> move) noexcept;
  /// Ends every unit's step at dy + move, with the torques that the host gets.
  void finish(std::span<const JointInStep> joints, TrialColumns& c, std::span<const double> dy, std::span<const double> move,
              std::span<const double> torques) noexcept;

  /// Instead of all that: joints that know nothing of each other, each of them solved and its step ended. How many didn't settle.
  std::size_t solve_each(std::span<const JointInStep> joints, std::span<double> torques) noexcept;

  /// From now on what these joints' units have in lanes stays there between steps, physics and the loops of their programs, as long as
  /// a step is of the usual kind and a tick does no more than hold references. Their states are out of date meanwhile: whoever looks
  /// at one calls show() before, whoever changes one leave(), whoever replaces all of them forget(). The same joints in every call,
  /// which stay where they are.
  void stay(std::span<const JointInStep> joints);
  /// After begin_step and what came over the line by then: the ticks at `at_ns` of the joints in lanes, as their plans then say
  /// (StepPlan::ticked). All others' ticks are their owner's.
  void tick(std::int64_t at_ns) noexcept;
  void show(std::size_t joint) const noexcept;  ///< its state has all of its numbers, and nothing else changes
  void show() const noexcept;                   ///< of every joint
  void leave() noexcept;                        ///< as show(), and the states are what counts
  void forget() noexcept;                       ///< the states are what counts, as they are
  /// Before a program does something about a frame: its loop is up to date in the state, which is what counts until its next tick.
  void open(std::size_t joint) noexcept;
  void observe(std::size_t joint) noexcept;  ///< the state's `reached` is what counts

  /// For who keeps what there is before a step that may fail. Keeps what is in lanes; in_kept(): the joint's numbers were there then,
  /// and its state is as at the keep() before but for what its owner changed. go_back(), once all states are those of keep(): what was
  /// in lanes then is there again. Of joints that stay; nothing is allocated.
  void keep() noexcept;
  [[nodiscard]] bool in_kept(std::size_t joint) const noexcept;  ///< as keep() says
  void go_back() noexcept;                                       ///< as keep() says

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  static constexpr std::size_t kWidest = 8;
  using Row = std::array<double, kWidest>;  // a number for each lane
  /// Joints that are tried together: one by itself, or a block.
  struct Group {
    std::size_t first = 0, count = 1;
    const LaneTable* lanes = nullptr;
    Line *block = nullptr, *plan = nullptr;
    // While it stays in lanes.
    Line* loop = nullptr;
    std::array<Row, 2> voltage{};
    unsigned opened = 0;         // lanes whose loop is in the state
    mutable unsigned shown = 0;  // lanes whose numbers are in the state as well
  };
  /// The kernel for so many lanes.
  struct Lanes {
    const LaneTable* table = nullptr;
    std::vector<Line> plan;  // of solve_each
  };
  template <class Value>
  [[nodiscard]] static Row row(const Group& group, Value&& value) noexcept;
  [[nodiscard]] static std::size_t lines(std::size_t bytes) noexcept;
  [[nodiscard]] std::size_t block_lines(const LaneTable& table) const noexcept;
  template <class Needs>
  [[nodiscard]] std::size_t room_for(std::size_t units, Needs&& needs) const;
  void group(std::span<const JointInStep> joints) noexcept;
  void find_lodgings() noexcept;
  void go_home() noexcept;
  template <class Asked>
  [[nodiscard]] bool all_in_lanes(Asked&& asked) const noexcept;
  [[nodiscard]] bool all_usual() const noexcept;
  [[nodiscard]] bool all_driven() const noexcept;
  [[nodiscard]] bool all_plain(std::int64_t at_ns) const noexcept;
  void loops_to_lanes(Group& group) noexcept;
  void run_clocks(std::int64_t at_ns) noexcept;
  void take_loop(const Group& group, std::size_t lane) const noexcept;
  static void put(const Group& group, std::span<const JointInStep> joints) noexcept;
  static void take(const Group& group, std::span<const JointInStep> joints) noexcept;
  struct Inputs;
  [[nodiscard]] Lanes& lanes_for(std::size_t units) noexcept;

  std::vector<Lanes> tables_;  // the widest first
  bool each_alone_;            // for solve_each only
  std::vector<Line> memory_;
  std::vector<Group> groups_;
  // Of joints that may stay.
  std::span<const JointInStep> joints_;
  std::vector<Line> loop_memory_;
  std::vector<std::size_t> group_of_;  // of a joint
  bool may_stay_ = false;              // some are in lanes, and nobody is by himself who could be beside others
  bool in_lanes_ = false;              // the physics of all groups that have lanes
  bool loops_in_lanes_ = false;        // and their programs' loops
  std::int64_t next_clock_ns_ = 0;     // of their watchdogs, the first
  bool states_counted_ = true;         // at some time since keep()
  /// What keep() keeps; blocks lie as in memory_.
  struct Kept {
    std::vector<Line> blocks, loops;
    std::vector<Group> groups;
    bool in_lanes = false, loops_in_lanes = false, may_stay = false;
    bool states_are_old = false;  // what they hold besides is that of the keep() before
    std::int64_t next_clock_ns = 0;
  } kept_;
};

}  // namespace vsa::device
