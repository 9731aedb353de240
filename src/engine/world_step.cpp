// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A step, or each of its substeps:
//   1  prepare()              everything that depends on q
//   2  where the seat says so   B of the driven joints of every tree
//   3  Seat::step             q, v, B → torque, for [t, t + dt)
//   4  apply, hands, advance()  v' = v + dt·a, q' = q + dt·v'
//   5  Seat::observe          q', v', for readings
// After a fault in 4 physics and robots are put back to where they were before the (whole) step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/run_length.hpp"
#include "engine/world_impl.hpp"
#include "vsa/grouped.hpp"

namespace vsa::engine {
namespace {

constexpr double kNanosecond = 1e-9;

}  // namespace

/// Once, when physics is there. A tree that several robots drive is solved as one.
void World::Impl::join_trees() {
  struct Place {
    std::size_t robot, actuator;
  };
  std::vector<std::size_t> joints;
  std::vector<Place> places;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    for (std::size_t i = 0; i < robots[r].joints.size(); ++i) {
      joints.push_back(robots[r].joints[i]);
      places.push_back({r, i});
    }
  }
  std::vector<std::vector<std::vector<std::size_t>>> own(robots.size());
  std::vector<std::vector<Place>> common;
  std::vector<int> bond(robots.size());
  std::iota(bond.begin(), bond.end(), 0);
  for (const auto& tree : physics->trees(joints)) {
    const std::size_t first = places[tree.front()].robot;
    const bool one = std::all_of(tree.begin(), tree.end(), [&](std::size_t k) { return places[k].robot == first; });
    std::vector<std::size_t> by_actuator;
    std::vector<Place> shared;
    for (const std::size_t k : tree) {
      by_actuator.push_back(places[k].actuator);
      shared.push_back(places[k]);
      const int from = bond[places[k].robot], to = bond[first];
      std::replace(bond.begin(), bond.end(), std::max(from, to), std::min(from, to));
    }
    if (one) {
      robots[first].trees.emplace_back();
      for (const std::size_t k : tree) robots[first].trees.back().push_back(joints[k]);
      own[first].push_back(std::move(by_actuator));
    } else {
      common.push_back(std::move(shared));
    }
  }
  for (const auto& together : grouped(bond)) {
    const auto at = [&](std::size_t robot) {
      return static_cast<std::size_t>(std::find(together.begin(), together.end(), robot) - together.begin());
    };
    std::vector<std::vector<host::RobotGroup::Joint>> trees;
    std::vector<std::vector<std::size_t>> of_joints;
    for (const auto& tree : common) {
      if (at(tree.front().robot) == together.size()) continue;
      trees.emplace_back();
      of_joints.emplace_back();
      for (const Place& place : tree) {
        trees.back().push_back({at(place.robot), place.actuator});
        of_joints.back().push_back(robots[place.robot].joints[place.actuator]);
      }
    }
    host::RobotGroup group(together.size(), std::move(trees));
    for (const std::size_t r : together) {
      robots[r].bonded = together.size() > 1;
      robots[r].seat->join(own[r], group.shared(at(r)));
    }
    if (together.size() > 1) bonds.push_back({together, std::move(group), std::move(of_joints), {}});
  }
  find_seats();
}

void World::Impl::find_seats() {
  for (RobotBond& bond : bonds) {
    bond.seats.clear();
    for (const std::size_t r : bond.robots) bond.seats.push_back(robots[r].seat.get());
  }
}

void World::Impl::ask_mobility(const std::vector<std::vector<std::size_t>>& trees, std::span<double> rest) {
  for (const auto& tree : trees) {
    const std::size_t size = tree.size() * tree.size();
    physics->mobility(tree, rest.first(size));
    rest = rest.subspan(size);
  }
}

void World::Impl::forget_mobility() {
  for (RobotSlot& slot : robots) slot.seat->moved();
}

void World::Impl::placed(std::size_t joint) {
  forget_mobility();
  for (RobotSlot& slot : robots) {
    for (std::size_t i = 0; i < slot.joints.size(); ++i)
      if (slot.joints[i] == joint) slot.seat->moved(i);
  }
}

void World::Impl::tell_joints(const RobotSlot& slot) const {
  for (std::size_t i = 0; i < slot.joints.size(); ++i) {
    const physics::JointState state = physics->joint(slot.joints[i]);
    slot.seat->in()[i].angle_rad = state.position;
    slot.seat->in()[i].speed_rad_per_s = state.speed;
  }
}

/// What isn't finite any more stops a seat, too; then advance() finds it and says so.
void World::Impl::drive() {
  for (const RobotSlot& slot : robots) {
    tell_joints(slot);
    if (slot.seat->wants_mobility()) ask_mobility(slot.trees, slot.seat->mobility());
    if (!slot.bonded) slot.seat->step(substep_ns());
  }
  for (RobotBond& bond : bonds) {
    ask_mobility(bond.trees, bond.group.mobility());
    seat::Seat::step_together(bond.seats, bond.group, substep_ns());
  }
  for (const RobotSlot& slot : robots) {
    for (std::size_t i = 0; i < slot.joints.size(); ++i) physics->apply(slot.joints[i], slot.seat->torques()[i]);
  }
}

void World::Impl::observe() {
  for (const RobotSlot& slot : robots) {
    tell_joints(slot);
    slot.seat->observe();
  }
}

std::optional<physics::Refusal> World::Impl::substep() {
  physics->prepare();
  drive();
  apply_hands();
  if (std::optional<physics::Refusal> fault = physics->advance()) return fault;
  observe();
  time_ns += substep_ns();
  return std::nullopt;
}

/// Physics takes back its last substep by itself.
void World::Impl::keep() {
  for (const RobotSlot& slot : robots) slot.seat->keep();
  if (substeps > 1) physics->save(before);
}

void World::Impl::go_back() {
  for (const RobotSlot& slot : robots) slot.seat->go_back();
  if (substeps > 1) physics->restore(before);
}

void World::Impl::step() {
  const std::int64_t begin_ns = time_ns;
  keep();
  for (int k = 0; k < substeps; ++k) {
    const std::optional<physics::Refusal> fault = substep();
    if (!fault) continue;
    const double at_s = static_cast<double>(time_ns) * kNanosecond;
    time_ns = begin_ns;
    go_back();
    throw SimulationError(
        fmt::format("the simulation blew up at t = {:.6f} s: {}: {} = {:.6g}", at_s, fault->where, fault->quantity, fault->value));
  }
  ++steps;
}

std::shared_ptr<const World::Snapshot> World::Impl::snapshot() const {
  auto out = std::make_shared<Snapshot>();
  out->world = world;
  out->physics.resize(physics->state_size());
  physics->save(out->physics);
  out->time_ns = time_ns;
  out->steps = steps;
  for (const RobotSlot& slot : robots) out->robots.push_back(slot.seat->snapshot());
  return out;
}

void World::Impl::restore(const Snapshot& s) {
  physics->restore(s.physics);
  time_ns = s.time_ns;
  steps = s.steps;
  for (std::size_t i = 0; i < robots.size(); ++i) robots[i].seat->restore(*s.robots[i]);
}

void World::step() { impl_->step(); }

void World::run(double duration_s) {
  const std::int64_t end = run_end_ns(impl_->time_ns, duration_s);
  while (impl_->time_ns < end) impl_->step();
}

std::shared_ptr<const World::Snapshot> World::snapshot() const { return impl_->snapshot(); }
void World::restore(const Snapshot& s) {
  impl_->check(s);
  impl_->restore(s);
}
void World::reset() {
  impl_->restore(*impl_->initial);
  impl_->let_go();
}
void World::make_initial() { impl_->initial = impl_->snapshot(); }

}  // namespace vsa::engine
