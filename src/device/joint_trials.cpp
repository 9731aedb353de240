// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/joint_trials.hpp"

#include <algorithm>
#include <array>

#include "device/lanes/table.hpp"
#include "device/numbers.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::device {
namespace {

constexpr std::size_t kLine = 64;

}  // namespace

std::size_t JointTrials::lines(std::size_t bytes) noexcept { return (bytes + kLine - 1) / kLine; }

/// The trials of joints that are solved each alone take no more than a step.
std::size_t JointTrials::block_lines(const LaneTable& t) const noexcept {
  return lines(each_alone_ ? t.block_bytes : t.trials_bytes);
}

/// Lines for blocks of so many units: a block's lanes are at most twice its units, whichever table serves it.
template <class Needs>
std::size_t JointTrials::room_for(std::size_t units, Needs&& needs) const {
  std::size_t a_lane = 0;
  for (const auto& [table, plan] : tables_) a_lane = std::max(a_lane, needs(*table) / static_cast<std::size_t>(table->width) + 1);
  return 2 * units * a_lane;
}

void JointTrials::stay(std::span<const JointInStep> joints) {
  if (joints.size() < 2 || tables_.empty()) return;
  joints_ = joints;
  group_of_.resize(joints.size());
  memory_.resize(room_for(joints.size(), [this](const LaneTable& t) { return block_lines(t); }));
  loop_memory_.resize(room_for(joints.size(), [](const LaneTable& t) { return lines(t.loop_bytes); }));
  kept_.blocks.resize(memory_.size());
  kept_.loops.resize(loop_memory_.size());
  kept_.groups.reserve(joints.size());
}

JointTrials::JointTrials(std::size_t joints, std::size_t together, std::string_view instructions) : each_alone_(together == 0) {
  if (instructions != "none") {
    const LaneTable& first = lane_table(instructions);
    for (const LaneTable& table : lane_tables())
      if (table.width <= first.width && joints > 1) {  // one alone has nobody beside it
        tables_.push_back({&table, std::vector<Line>(lines(table.plan_bytes))});
        table.begin_plan(tables_.back().plan.data());
      }
  }
  const std::size_t at_once = std::max(together, std::min(joints, kWidest));
  if (joints > 1) memory_.resize(room_for(at_once, [this](const LaneTable& t) { return block_lines(t); }));
  groups_.reserve(joints);
}

/// The fewest lanes that hold so many units, or the most that there are.
JointTrials::Lanes& JointTrials::lanes_for(std::size_t units) noexcept {
  Lanes* best = &tables_.front();
  for (Lanes& lanes : tables_)
    if (static_cast<std::size_t>(lanes.table->width) >= units) best = &lanes;
  return *best;
}

void JointTrials::group(std::span<const JointInStep> joints) noexcept {
  if (in_lanes_ && all_usual() && (loops_in_lanes_ || all_driven())) return;
  go_home();
  groups_.clear();
  std::size_t used = 0;
  const auto beside = [&](std::size_t i) {
    return joints[i].unit->physics().has_lanes() && joints[i].unit->may_go_beside(*joints[i].state, *joints[i].plan);
  };
  for (std::size_t first = 0; first < joints.size();) {
    std::size_t end = first + 1;
    if (!tables_.empty() && beside(first))
      while (end < joints.size() && joints[end].unit == joints[first].unit && beside(end)) ++end;
    if (end - first == 1) {
      groups_.push_back({first++, 1});
      continue;
    }
    while (first < end) {
      auto& [table, plan] = lanes_for(end - first);
      const std::size_t count = std::min(end - first, static_cast<std::size_t>(table->width));
      const std::size_t needs = block_lines(*table);
      if (used + needs > memory_.size()) used = 0;  // of solve_each: one block after the other
      groups_.push_back({.first = first, .count = count, .lanes = table, .block = &memory_[used], .plan = plan.data()});
      if (!each_alone_) table->begin_trials_plan(&memory_[used]);
      used += needs;
      first += count;
    }
  }
  if (!joints_.empty()) find_lodgings();
}

/// A number of each joint of a group; lanes that nobody needs have the first one's, so that they ask for nothing else.
template <class Value>
JointTrials::Row JointTrials::row(const Group& g, Value&& value) noexcept {
  const std::size_t width = g.lanes == nullptr ? 1 : static_cast<std::size_t>(g.lanes->width);
  Row r{};
  for (std::size_t l = 0; l < width; ++l) r[l] = value(g.first + (l < g.count ? l : 0));
  return r;
}

/// What a block's step begins with.
struct JointTrials::Inputs {
  Inputs(const Group& g, std::span<const JointInStep> joints, bool loops_in_lanes) noexcept
      : dt_s(seconds(joints[g.first].plan->dt_ns)),
        angle(row(g, [&](std::size_t i) { return joints[i].plan->in.angle; })),
        speed(row(g, [&](std::size_t i) { return joints[i].plan->in.speed; })),
        inverse_inertia(row(g, [&](std::size_t i) { return joints[i].plan->in.inverse_inertia; })),
        free_acceleration(row(g, [&](std::size_t i) { return joints[i].plan->in.free_acceleration; })),
        voltage(loops_in_lanes ? g.voltage : std::array{held(g, joints, 0), held(g, joints, 1)}) {}
  static Row held(const Group& g, std::span<const JointInStep> joints, std::size_t motor) noexcept {
    return row(g, [&](std::size_t i) { return joints[i].plan->held[0].voltage[motor]; });
  }
  double dt_s;
  Row angle, speed, inverse_inertia, free_acceleration;
  std::array<Row, 2> voltage;
};

void JointTrials::put(const Group& g, std::span<const JointInStep> joints) noexcept {
  for (int l = 0; l < g.lanes->width; ++l) {
    const auto lane = static_cast<std::size_t>(l);
    g.lanes->put(g.block, l, *joints[g.first + (lane < g.count ? lane : 0)].state);
  }
}
void JointTrials::take(const Group& g, std::span<const JointInStep> joints) noexcept {
  for (std::size_t l = 0; l < g.count; ++l) g.lanes->take(g.block, static_cast<int>(l), *joints[g.first + l].state);
}

void JointTrials::begin(std::span<const JointInStep> joints, TrialColumns& c, double reach) noexcept {
  group(joints);
  for (const Group& g : groups_) {
    const JointInStep& first = joints[g.first];
    if (g.lanes == nullptr) {
      first.unit->begin_trials(*first.state, *first.plan);
      const double free = c.free[g.first] = first.plan->free;
      const ShaftTorque t = first.unit->foresee(*first.state, *first.plan, std::clamp(free, -reach, reach));
      c.last_torque[g.first] = first.plan->last_torque;
      c.torque[g.first] = t.torque;
      c.slope[g.first] = t.slope;
      continue;
    }
    if (!in_lanes_) put(g, joints);
    const Inputs in(g, joints, loops_in_lanes_);
    Row free, last_torque, torque, slope;
    g.lanes->begin_trials(*first.unit, g.block,
                          {in.dt_s,
                           reach,
                           in.angle.data(),
                           in.speed.data(),
                           in.inverse_inertia.data(),
                           in.free_acceleration.data(),
                           {in.voltage[0].data(), in.voltage[1].data()},
                           free.data(),
                           last_torque.data(),
                           torque.data(),
                           slope.data()});
    std::copy_n(free.data(), g.count, &c.free[g.first]);
    std::copy_n(last_torque.data(), g.count, &c.last_torque[g.first]);
    std::copy_n(torque.data(), g.count, &c.torque[g.first]);
    std::copy_n(slope.data(), g.count, &c.slope[g.first]);
  }
}

void JointTrials::attempt(std::span<const JointInStep> joints, TrialColumns& c, std::span<const double> dy, bool rough,
                          bool keep) noexcept {
  for (const Group& g : groups_) {
    unsigned which = 0;
    const Row at = row(g, [&](std::size_t i) { return dy[i]; });
    const Row tries = row(g, [&](std::size_t i) { return keep && c.carried[i].settled ? 0.0 : 1.0; });
    for (std::size_t l = 0; l < kWidest; ++l) which |= tries[l] > 0 ? 1U << l : 0U;
    Row torque{}, slope{};
    if (const JointInStep& first = joints[g.first]; which == 0) {
    } else if (g.lanes == nullptr) {
      const ShaftTorque t = first.unit->attempt(*first.state, *first.plan, at[0], rough);
      torque[0] = t.torque;
      slope[0] = t.slope;
    } else {
      g.lanes->attempt(*first.unit, g.block, at.data(), rough, which, torque.data(), slope.data());
    }
    for (std::size_t l = 0; l < g.count; ++l) {
      const std::size_t i = g.first + l;
      const bool tried = tries[l] > 0;
      if (tried) c.dy[i] = at[l];
      c.torque[i] = tried ? torque[l] : c.carried[i].torque;
      c.slope[i] = tried ? slope[l] : c.carried[i].slope;
    }
  }
}

bool JointTrials::carry(std::span<const JointInStep> joints, TrialColumns& c, std::span<const double> dy,
                        std::span<const double> move) noexcept {
  bool all = true;
  for (const Group& g : groups_) {
    const JointInStep& first = joints[g.first];
    const Row beyond = row(g, [&](std::size_t i) { return dy[i] - c.dy[i] + move[i]; });
    if (g.lanes == nullptr) {
      c.carried[g.first] = first.unit->carried(*first.state, *first.plan, beyond[0]);
      all = all && c.carried[g.first].settled;
      continue;
    }
    Row torque, slope;
    const unsigned settled =
        g.lanes->carry(*first.unit, g.block, beyond.data(), seconds(first.plan->dt_ns), torque.data(), slope.data());
    for (std::size_t l = 0; l < g.count; ++l) {
      c.carried[g.first + l] = {torque[l], slope[l], (settled >> l & 1U) != 0};
      all = all && c.carried[g.first + l].settled;
    }
  }
  return all;
}

void JointTrials::finish(std::span<const JointInStep> joints, TrialColumns& c, std::span<const double> dy,
                         std::span<const double> move, std::span<const double> torques) noexcept {
  in_lanes_ = may_stay_;
  for (const Group& g : groups_) {
    const JointInStep& first = joints[g.first];
    const Row beyond = row(g, [&](std::size_t i) { return dy[i] - c.dy[i] + move[i]; });
    if (g.lanes == nullptr) {
      first.unit->finish(*first.state, *first.plan, beyond[0], torques[g.first]);
      continue;
    }
    const Row torque = row(g, [&](std::size_t i) { return torques[i]; });
    g.lanes->finish(*first.unit, g.block, beyond.data(), torque.data(), seconds(first.plan->dt_ns));
    g.shown = 0;
    if (!in_lanes_) take(g, joints);
  }
}

std::size_t JointTrials::solve_each(std::span<const JointInStep> joints, std::span<double> torques) noexcept {
  std::size_t unsettled = 0;
  group(joints);
  for (const Group& g : groups_) {
    const JointInStep& first = joints[g.first];
    if (g.lanes == nullptr) {
      torques[g.first] = first.unit->end_step(*first.state, *first.plan);
      unsettled += first.unit->settled() ? 0 : 1;
      continue;
    }
    if (!in_lanes_) put(g, joints);
    const Inputs in(g, joints, loops_in_lanes_);
    Row torque;
    std::array<Row, 2> motor_angle, motor_speed;
    const unsigned open = g.lanes->step(*first.unit, g.block, g.plan,
                                        {in.dt_s,
                                         in.angle.data(),
                                         in.speed.data(),
                                         in.inverse_inertia.data(),
                                         in.free_acceleration.data(),
                                         {in.voltage[0].data(), in.voltage[1].data()},
                                         torque.data(),
                                         {motor_angle[0].data(), motor_angle[1].data()},
                                         {motor_speed[0].data(), motor_speed[1].data()}});
    g.shown = 0;
    if (!may_stay_) take(g, joints);
    for (std::size_t l = 0; l < g.count; ++l) {
      torques[g.first + l] = torque[l];
      unsettled += open >> l & 1U;
    }
  }
  in_lanes_ = may_stay_;
  return unsettled;
}

}  // namespace vsa::device
