// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What pages ask for, done by the loop between two steps.
#include <algorithm>
#include <cmath>

#include "live_impl.hpp"

namespace vsa::view {
namespace {

// The hand: as strong as is useful for a model of mass m.
constexpr double kHand_per_s2 = 100;  // k/m: 1/(0.1 s)²
constexpr double kHandDamping = 0.7;  // of critical
constexpr double kHandWeights = 3;    // force_max in weights of the model

}  // namespace

void LiveView::Impl::operator()(const Command& r) {
  for (const std::size_t i : r.actuators) {
    const Actuator& ref = actuators[i];
    const auto& config = world.robot(ref.robot).config();
    if (config.buses[config.actuators[ref.index].bus].serial_port) {
      throw InputError({"", "command", ref.name, "belongs to the client on its bus's serial port", ""});
    }
  }
  for (const std::size_t i : r.actuators) {
    const Actuator& ref = actuators[i];
    world.robot(ref.robot).command(ref.index, r.equilibrium_rad, r.preset);
    if (gait_names[i].empty()) continue;
    const motion::ByHand before = gait->by_hand(gait_names[i]);
    gait->leave(gait_names[i], {before.equilibrium || r.equilibrium_rad, before.preset || r.preset});
  }
}

void LiveView::Impl::operator()(const GiveBack&) {
  for (const std::string& name : gait_names) {
    if (!name.empty()) gait->leave(name, {});
  }
}

void LiveView::Impl::operator()(const PullLink& r) {
  double mass = 0;
  for (const scene::LinkInfo& link : world.links()) {
    if (link.model == world.links()[r.link].model && !link.is_static) mass += link.mass_kg;
  }
  constexpr double kWeight = 9.81;
  const double k = std::min(1e5, kHand_per_s2 * mass);
  pulls[asking] = {r.link,
                   r.point_m,
                   r.target_m,
                   k,
                   std::min(1e4, 2 * kHandDamping * std::sqrt(k * mass)),
                   std::min(1e4, kHandWeights * kWeight * mass)};
  set_pulls();
}

void LiveView::Impl::operator()(const Release&) {
  if (pulls.erase(asking) > 0) set_pulls();
}

void LiveView::Impl::set_pulls() {
  std::vector<scene::Pull> all;
  for (const auto& [viewer, pull] : pulls) all.push_back(pull);
  world.pull(std::move(all));
}

void LiveView::Impl::operator()(const Record& r) {
  if (r.on == recordings.running()) return;
  if (r.on) {
    recordings.start(world);
  } else {
    recordings.stop(world, "");
  }
}

}  // namespace vsa::view
