// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/command_player.hpp"

#include "vsa/errors.hpp"

namespace vsa::app {
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

bool in_keyframes(const engine::World& world, const motion::Gait* gait, const engine::ActuatorRef& actuator,
                  const RunOptions::Command& c) {
  if (gait == nullptr || !gait->params().motion) return false;
  for (const motion::MotionTrack& track : gait->params().motion->tracks) {
    if (!same(world.actuator(track.actuator), actuator)) continue;
    if ((c.equilibrium_rad && !track.equilibrium.empty()) || (c.preset_rad && !track.preset.empty())) return true;
  }
  return false;
}

}  // namespace

CommandPlayer::CommandPlayer(const RunOptions& options, const engine::World& world, motion::Gait* gait) {
  if (gait != nullptr) gait->bind(world);
  Problems problems;
  for (const RunOptions::Command& c : options.commands) {
    try {
      const engine::ActuatorRef& actuator = world.actuator(c.actuator);
      if (in_keyframes(world, gait, actuator, c))
        problems.add({options.scenario, "command.actuator", c.actuator, "the motion's keyframes command it", "another actuator"});
      orders_.push_back({c, actuator, in_waves(world, gait, actuator)});
    } catch (const InputError& error) {
      for (const Problem& p : error.problems())
        problems.add({options.scenario, "command.actuator", c.actuator, p.message, p.allowed});
    }
  }
  problems.throw_if_any();
}

void CommandPlayer::apply(engine::World& world, motion::Gait* gait) {
  for (; next_ < orders_.size() && world.time_s() >= orders_[next_].command.time_s; ++next_) {
    const auto& [c, actuator, name] = orders_[next_];
    world.robot(actuator.robot).command(actuator.index, c.equilibrium_rad, c.preset_rad);
    if (name.empty()) continue;
    const motion::ByHand before = gait->by_hand(name);
    gait->leave(name, {before.equilibrium || c.equilibrium_rad, before.preset || c.preset_rad});
  }
}

void CommandPlayer::reset(motion::Gait* gait) {
  for (std::size_t i = 0; i < next_; ++i) {
    if (!orders_[i].in_gait.empty()) gait->leave(orders_[i].in_gait, {});
  }
  next_ = 0;
}

}  // namespace vsa::app
