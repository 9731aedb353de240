// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scenario/player.hpp"

#include "vsa/errors.hpp"

namespace vsa::scenario {
namespace {

bool same(const engine::ActuatorRef& a, const engine::ActuatorRef& b) { return a.robot == b.robot && a.index == b.index; }

std::string in_waves(const engine::World& world, const motion::Gait* gait, const engine::ActuatorRef& actuator) {
  if (gait == nullptr) return "";
  for (const motion::GaitGroup& group : gait->params().groups) {
    for (const std::string& name : group.actuators)
      if (same(world.actuator(name), actuator)) return name;
  }
  return "";
}

bool in_keyframes(const engine::World& world, const motion::Gait* gait, const engine::ActuatorRef& actuator, const Command& c) {
  if (gait == nullptr || !gait->params().motion) return false;
  for (const motion::MotionTrack& track : gait->params().motion->tracks) {
    if (!same(world.actuator(track.actuator), actuator)) continue;
    if ((c.equilibrium_rad && !track.equilibrium.empty()) || (c.preset_rad && !track.preset.empty())) return true;
  }
  return false;
}

}  // namespace

Player::Player(const Scenario& scenario, const engine::World& world) : gait_(load_motion(scenario)) {
  if (gait_) gait_->bind(world);
  Problems problems;
  validate(scenario, "", problems);
  for (const Command& c : scenario.commands) {
    try {
      const engine::ActuatorRef& actuator = world.actuator(c.actuator);
      if (in_keyframes(world, gait(), actuator, c))
        problems.add({scenario.scenario, "command.actuator", c.actuator, "the motion's keyframes command it", "another actuator"});
      orders_.push_back({c, actuator, in_waves(world, gait(), actuator)});
    } catch (const InputError& error) {
      for (const Problem& p : error.problems())
        problems.add({scenario.scenario, "command.actuator", c.actuator, p.message, p.allowed});
    }
  }
  problems.throw_if_any();
}

void Player::apply(engine::World& world) {
  if (gait_) gait_->apply(world);
  for (; next_ < orders_.size() && world.time_s() >= orders_[next_].command.time_s; ++next_) {
    const auto& [c, actuator, name] = orders_[next_];
    world.robot(actuator.robot).command(actuator.index, c.equilibrium_rad, c.preset_rad);
    if (name.empty()) continue;
    const motion::ByHand before = gait_->by_hand(name);
    gait_->leave(name, {before.equilibrium || c.equilibrium_rad, before.preset || c.preset_rad});
  }
}

void Player::reset() {
  for (std::size_t i = 0; i < next_; ++i) {
    if (!orders_[i].in_gait.empty()) gait_->leave(orders_[i].in_gait, {});
  }
  next_ = 0;
  if (gait_) gait_->reset();
}

}  // namespace vsa::scenario
