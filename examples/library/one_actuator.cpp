// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One unit on a pendulum of your own: any integrator can be the host.
#include <cmath>
#include <cstdio>
#include <memory>

#include "vsa/device/unit.hpp"
#include "vsa/elastic/two_sinh.hpp"

int main() {
  constexpr double inertia = 0.005, dt = 1e-3;  // kg·m², s
  vsa::device::UnitConfig config;
  config.actuator.transmission = std::make_shared<vsa::elastic::TwoSinh>(vsa::elastic::TwoSinhParams{{0.022, 0.022}, {6.85, 6.85}});
  config.actuator.set_both({.motor = {0.001, 0.01, 0.8, 1.3, 2.3, std::nullopt}, .gearbox = {1.0, {0.8, 0.03}}});
  config.actuator.shaft_friction = {0.01, 0.03};
  config.actuator.shaft_inertia_kgm2 = inertia;
  vsa::device::Unit unit(config);
  auto state = unit.initial(0.0, 0.4, 0.0);  // equilibrium, preset, shaft: rad
  unit.command(state, 0.8, 0.4);

  double q = 0, v = 0;
  for (int n = 0; n < 2000; ++n) {
    const double torque = unit.step(state, n * 1'000'000LL, 1'000'000, {q, v, 1 / inertia});
    v += dt * (torque - 0.3 * std::sin(q)) / inertia;
    q += dt * v;
  }
  const auto& l = state.actuator.ledger;
  std::printf("shaft %.3f rad; from the supply %.2f J, heat in the windings %.2f J, balance off by %.1e J\n", q, l.supply, l.copper,
              l.imbalance());
  return std::abs(l.imbalance()) < 1e-9 ? 0 : 1;
}
