// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A step, or each of its substeps:
//   1  prepare()              everything that depends on q
//   2  push                   what users apply
//      foresee()              where the driven joints would go without new torques; where it is due, B of those of every tree
//   3  SeatGroup::step        q, v, B → torque, for [t, t + dt); of stiff joints with what holds them then, holds_else()
//   4  apply, advance()        v' = v + dt·a, q' = q + dt·v'
//   5  Seat::observe          q', v', for readings
// After a fault in 4 physics and robots are put back to where they were before the (whole) step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/run_length.hpp"
#include "engine/world_impl.hpp"
#include "vsa/seat/stiff_trees.hpp"

namespace vsa::engine {
namespace {

constexpr double kNanosecond = 1e-9;

}  // namespace

void World::Impl::make_room() {
  foreseen.resize(driven.size());
  stiff.reserve(driven.size());
  alone.resize(driven.size());
  begins_stiff.resize(driven.size());
}

/// Once, when physics is there.
void World::Impl::join_trees() {
  driven.clear();
  for (const RobotSlot& slot : robots) driven.insert(driven.end(), slot.joints.begin(), slot.joints.end());
  for (RobotSlot& slot : robots) slot.beside = physics->beside(slot.joints);
  make_room();
  take_trees(find_trees());
}

/// By what the file and parameters say, wherever the world is.
std::vector<std::vector<std::size_t>> World::Impl::find_trees() {
  std::vector<std::vector<std::size_t>> found = physics->trees(driven);
  physics->zero_mobility(driven, alone);
  std::size_t k = 0;
  for (const RobotSlot& slot : robots)
    for (std::size_t i = 0; i < slot.joints.size(); ++i, ++k)
      begins_stiff[k] = seat::may_be_stiff(slot.robot(), i, alone[k]) ? 1 : 0;
  if (std::count(begins_stiff.begin(), begins_stiff.end(), 1) > 1)
    seat::join_stiff_trees(found, begins_stiff, physics->neighbours(driven));
  return found;
}

void World::Impl::take_trees(std::vector<std::vector<std::size_t>> of_driven) {
  group = seat::SeatGroup(seats(), of_driven);
  trees = std::move(of_driven);
  for (auto& tree : trees)
    for (std::size_t& k : tree) k = driven[k];
}

/// Other parameters may make other trees stiff.
void World::Impl::join_trees_anew() {
  std::vector<std::vector<std::size_t>> found = find_trees();
  const auto at = [this](const std::vector<std::size_t>& tree) {
    std::vector<std::size_t> out;
    for (const std::size_t k : tree) out.push_back(driven[k]);
    return out;
  };
  if (std::equal(found.begin(), found.end(), trees.begin(), trees.end(), [&](const auto& a, const auto& b) { return at(a) == b; }))
    return;
  take_trees(std::move(found));
}

std::vector<seat::Seat*> World::Impl::seats() const {
  std::vector<seat::Seat*> out;
  for (const RobotSlot& slot : robots) out.push_back(slot.seat.get());
  return out;
}

void World::Impl::forget_mobility() {
  for (RobotSlot& slot : robots) slot.seat->moved();
}

void World::Impl::renew_held() {
  for (RobotSlot& slot : robots)
    if (!stiff.empty() && physics->is_held(slot.joints)) slot.seat->moved();
}

void World::Impl::placed(std::size_t joint) {
  forget_mobility();
  for (RobotSlot& slot : robots) {
    for (std::size_t i = 0; i < slot.joints.size(); ++i) {
      if (slot.joints[i] != joint) continue;
      tell_joints(slot);
      slot.seat->moved(i);
    }
  }
}

void World::Impl::tell_joints(const RobotSlot& slot) const {
  for (std::size_t i = 0; i < slot.joints.size(); ++i) {
    const physics::JointState state = physics->joint(slot.joints[i]);
    slot.seat->in()[i].angle_rad = state.position;
    slot.seat->in()[i].speed_rad_per_s = state.speed;
  }
}

/// What holds the trees of stiff joints, while their step is solved.
class World::Impl::Holds final : public device::Holder {
 public:
  explicit Holds(Impl& world) noexcept : world_(world) {}
  [[nodiscard]] bool holds(std::size_t tree) const noexcept override { return world_.physics->is_held(world_.trees[tree]); }
  bool holds_else(std::size_t tree, std::span<const double> torques_Nm, std::span<double> accelerations,
                  std::span<double> mobility) noexcept override {
    return world_.physics->holds_else(world_.trees[tree], torques_Nm, accelerations, mobility);
  }

 private:
  Impl& world_;
};

/// What isn't finite any more stops a seat, too; then advance() finds it and says so.
void World::Impl::drive() {
  physics->foresee(driven, foreseen);
  auto next = foreseen.begin();
  for (const RobotSlot& slot : robots) {
    tell_joints(slot);
    const bool held = !stiff.empty() && physics->is_held(slot.joints);
    if (held) physics->free_mobility(slot.joints, alone);
    for (std::size_t i = 0; i < slot.joints.size(); ++i)
      slot.seat->in()[i].inverse_inertia = held ? std::optional(alone[i]) : std::nullopt;
    slot.seat->turned(physics->turned_rad(slot.beside));
    for (host::JointIn& joint : slot.seat->in()) joint.free_acceleration_rad_per_s2 = *next++;
  }
  group.update([this](std::size_t tree, std::span<double> out) { physics->mobility(trees[tree], out); });
  Holds holds(*this);
  group.step(substep_ns(), stiff.empty() ? nullptr : &holds);
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

/// Before robots have made a step and found out, which joints are for such a step.
void World::Impl::find_first_stiff(double dt_s) {
  if (driven.empty()) return;
  physics->first_mobility(driven, alone);
  std::size_t k = 0;
  for (const RobotSlot& slot : robots)
    for (std::size_t i = 0; i < slot.joints.size(); ++i, ++k)
      begins_stiff[k] = dt_s * dt_s * alone[k] * slot.robot().read(i).stiffness_Nm_per_rad > device::kHardlyResolved ? 1 : 0;
}

void World::Impl::find_stiff() {
  stiff.clear();
  const bool begins = time_ns == 0;
  if (begins) find_first_stiff(substep_s());
  std::size_t first = 0;
  for (const RobotSlot& slot : robots) {
    const auto own = std::span(begins_stiff).subspan(first, slot.joints.size());
    first += slot.joints.size();
    if (slot.robot().is_stiff() || (begins && std::count(own.begin(), own.end(), 1) > 0))
      stiff.insert(stiff.end(), slot.joints.begin(), slot.joints.end());
  }
  physics->set_stiff(stiff);
}

std::optional<physics::Refusal> World::Impl::substep() {
  find_stiff();
  physics->prepare();
  // What holds a stiff joint is in B, in this step; what lets go of it isn't, in the next one.
  renew_held();
  push();
  drive();
  renew_held();
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
  put_here.clear();
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
  put_here.clear();
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
