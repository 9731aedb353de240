// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The smallest possible host: one joint with an inertia and a load, integrated as every engine does it, v' = v + dt·a, q' = q +
// dt·v'.
#pragma once

#include <functional>
#include <memory>

#include "vsa/device/unit.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace vsa::test {

inline device::UnitConfig maker_pro() {
  device::UnitConfig c;
  c.actuator.transmission = std::make_shared<elastic::TwoSinh>(elastic::TwoSinhParams{{0.022, 0.022}, {6.85, 6.85}});
  c.actuator.set_both(
      {.motor = {0.001, 0.01, 0.8, 1.3, 2.3, std::nullopt}, .gearbox = {1.0, {0.8, 0.03}}, .bridge = {.dead_band = 0.3}});
  c.actuator.shaft_friction = {0.01, 0.03};
  c.actuator.shaft_inertia_kgm2 = 1e-4;
  return c;
}

/// The unit with locked motors: an enormous inertia behind no friction at all.
inline device::UnitConfig without_losses() {
  device::UnitConfig c = maker_pro();
  for (auto& side : c.actuator.side) side.motor = {1e6, 0.0, 0.0, 0.0, 1.0, std::nullopt};
  for (auto& side : c.actuator.side) side.gearbox.friction = {0.0, 0.0};
  c.actuator.shaft_friction = {0.0, 0.0};
  return c;
}

struct OneJoint {
  OneJoint(device::UnitConfig config, double equilibrium, double preset, double inertia_kgm2, std::int64_t step_ns)
      : unit(std::move(config)), state(unit.initial(equilibrium, preset, equilibrium)), inertia(inertia_kgm2), dt_ns(step_ns) {
    q = equilibrium;
  }

  void step() {
    const double torque = unit.step(state, t_ns, dt_ns, {q, v, inertia > 0 ? 1.0 / inertia : 0.0});
    const double dt = static_cast<double>(dt_ns) * 1e-9;
    last_torque = torque;
    if (inertia > 0) v += dt * (torque + load(q)) / inertia;
    q += dt * v;
    t_ns += dt_ns;
  }

  /// Elastic and shaft energy in the coupling's own coordinates: y = q − dt·v/2.
  [[nodiscard]] double energy() const {
    const double y = q - 0.5e-9 * static_cast<double>(dt_ns) * v;
    return 0.5 * inertia * v * v + unit.physics().spring(state.actuator, y).energy;
  }

  device::Unit unit;
  device::UnitState state;
  double inertia;
  std::int64_t dt_ns, t_ns = 0;
  double q = 0, v = 0, last_torque = 0;
  std::function<double(double)> load = [](double) { return 0.0; };
};

}  // namespace vsa::test
