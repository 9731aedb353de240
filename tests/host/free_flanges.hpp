// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot of units on one bus, each with a flange that turns freely.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "support/one_joint.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::test {

inline host::RobotConfig chain(std::size_t count) {
  host::RobotConfig config;
  config.buses.push_back({"spine", 2e6, std::nullopt});
  for (std::size_t i = 0; i < count; ++i) {
    host::ActuatorConfig a;
    a.name = "a" + std::to_string(i + 1);
    a.joint = a.name;
    a.unit = maker_pro();
    a.id = static_cast<int>(i) + 1;
    a.initial_preset = 0.3;
    config.actuators.push_back(a);
  }
  return config;
}

/// Free flanges of 1e-3 kg·m².
struct Flanges {
  explicit Flanges(host::RobotConfig config, std::int64_t step_ns = 1'000'000)
      : robot(std::move(config)), in(robot.size(), host::JointIn{0, 0, 1e3}), out(robot.size()), dt_ns(step_ns) {}
  void step() {
    robot.advance(t_ns, dt_ns, in, out);
    const double dt = static_cast<double>(dt_ns) * 1e-9;
    for (std::size_t i = 0; i < in.size(); ++i) {
      in[i].speed_rad_per_s += dt * out[i] * 1e3;
      in[i].angle_rad += dt * in[i].speed_rad_per_s;
    }
    t_ns += dt_ns;
  }
  void run(int steps) {
    for (int n = 0; n < steps; ++n) step();
  }
  host::Robot robot;
  std::vector<host::JointIn> in;
  std::vector<double> out;
  std::int64_t dt_ns, t_ns = 0;
};

}  // namespace vsa::test
