// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whether a robot that is left alone comes to rest.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "vsa/engine/world.hpp"

namespace vsa::test {

struct Rest {
  double rms_speed = 0;        ///< of the actuated joints over the last half second, rad/s
  double scatter = 0;          ///< the largest standard deviation of a torque over it, per the largest torque of that joint
  double coupling_part = 0;    ///< the summed `coupling` over what moved
  double integrator_part = 0;  ///< likewise `integrator`
  double torque_sd_Nm = 0;     ///< that deviation itself
};

/// `seconds` of a world as it is; the last half second is measured.
inline Rest rest_of(engine::World& world, double seconds) {
  struct Sums {
    double t = 0, tt = 0, largest = 0;
  };
  std::vector<Sums> sums(world.actuators().size());
  double vv = 0;
  std::size_t samples = 0;
  const double from = world.time_s() + seconds - 0.5, until = world.time_s() + seconds;
  while (world.time_s() < until) {
    world.step();
    const bool count = world.time_s() > from;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const auto r = world.read(world.actuators()[i]);
      sums[i].largest = std::max(sums[i].largest, std::abs(r.mean_torque_Nm));
      if (!count) continue;
      sums[i].t += r.mean_torque_Nm;
      sums[i].tt += r.mean_torque_Nm * r.mean_torque_Nm;
      vv += r.shaft_speed_rad_per_s * r.shaft_speed_rad_per_s;
      ++samples;
    }
  }
  Rest rest;
  const double n = static_cast<double>(samples) / static_cast<double>(sums.size());
  rest.rms_speed = std::sqrt(vv / static_cast<double>(samples));
  for (const Sums& s : sums) {
    const double sd = std::sqrt(std::max(0.0, s.tt / n - (s.t / n) * (s.t / n)));
    rest.torque_sd_Nm = std::max(rest.torque_sd_Nm, sd);
    if (s.largest > 0) rest.scatter = std::max(rest.scatter, sd / s.largest);
  }
  const auto ledger = world.ledger();
  if (ledger.moved() > 0) {
    rest.coupling_part = ledger.coupling / ledger.moved();
    rest.integrator_part = ledger.integrator / ledger.moved();
  }
  return rest;
}

}  // namespace vsa::test
