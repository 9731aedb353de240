// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A step:
//   1  prepare()              everything that depends on q
//   2  every 16th step        (M⁻¹)_jj of every driven joint, which only serves the robots' prediction
//   3  Robot::advance         q, v → torque, for [t, t + dt)
//   4  apply, hands, advance()  v' = v + dt·a, q' = q + dt·v'
// After a fault in 4 physics and robots are put back to where they were before 1.
#include <fmt/format.h>

#include <cmath>

#include "world_impl.hpp"

namespace vsa::engine {
namespace {

constexpr std::int64_t kRefreshSteps = 16;
constexpr double kNanosecond = 1e-9;
constexpr double kLongestRun_s = 1e9;

}  // namespace

void World::Impl::drive() {
  const bool ask = refresh || steps % kRefreshSteps == 0;
  for (RobotSlot& slot : robots) {
    for (std::size_t i = 0; i < slot.joints.size(); ++i) {
      const JointState state = physics->joint(slot.joints[i]);
      if (ask) slot.inverse_inertia[i] = physics->inverse_inertia(slot.joints[i]);
      slot.in[i] = {state.position, state.speed, slot.inverse_inertia[i]};
    }
    slot.robot.advance(time_ns, dt_ns, slot.in, slot.torques);
    for (std::size_t i = 0; i < slot.joints.size(); ++i) physics->apply(slot.joints[i], slot.torques[i]);
  }
  refresh = false;
}

void World::Impl::step() {
  std::vector<std::shared_ptr<const host::Robot::Snapshot>> before;
  before.reserve(robots.size());
  for (const RobotSlot& slot : robots) before.push_back(slot.robot.snapshot());
  physics->prepare();
  drive();
  apply_hands();
  if (const std::optional<Fault> fault = physics->advance()) {
    for (std::size_t i = 0; i < robots.size(); ++i) robots[i].robot.restore(*before[i]);
    refresh = true;
    throw SimulationError(fmt::format("the simulation blew up at t = {:.6f} s: {}: {} = {:.6g}",
                                      static_cast<double>(time_ns) * kNanosecond, fault->where, fault->quantity, fault->value));
  }
  time_ns += dt_ns;
  ++steps;
}

std::shared_ptr<const World::Snapshot> World::Impl::snapshot() const {
  auto out = std::make_shared<Snapshot>();
  out->world = world;
  out->physics = physics->save();
  out->time_ns = time_ns;
  out->steps = steps;
  out->refresh = refresh;
  for (const RobotSlot& slot : robots) {
    out->robots.push_back(slot.robot.snapshot());
    out->inverse_inertia.push_back(slot.inverse_inertia);
  }
  return out;
}

void World::Impl::restore(const Snapshot& s) {
  physics->restore(s.physics);
  time_ns = s.time_ns;
  steps = s.steps;
  refresh = s.refresh;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i].robot.restore(*s.robots[i]);
    robots[i].inverse_inertia = s.inverse_inertia[i];
  }
}

void World::step() { impl_->step(); }

void World::run(double duration_s) {
  if (!(duration_s >= 0 && duration_s <= kLongestRun_s)) {
    throw InputError(
        Problem{"", "duration_s", fmt::format("{}", duration_s), "out of range", fmt::format("0 … {} s", kLongestRun_s)});
  }
  const std::int64_t end = impl_->time_ns + std::llround(duration_s / kNanosecond);
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
