// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What both Gazebos are tried with: the chains of rest_cases.hpp that a server's own start leaves time for.
#pragma once

#include <algorithm>
#include <functional>
#include <string>

#include "chain/rest_cases.hpp"

namespace vsa::test {

constexpr double kLeftAlone_s = 5, kMeasured_s = 0.5, kShortStep_s = 1e-4;

/// One world of the case, run for so many seconds: its last half second.
using GazeboRun = std::function<Rest(const RestCase&, double seconds)>;

/// Every chain, or those few that no quick run leaves out: modules on parallel axes at the largest preset, which shook as long as
/// each joint was solved alone.
inline void expect_gazebo_quiet(const GazeboRun& run, bool every, const std::string& title) {
  RestTable table([&](const RestCase& c) { return run(c, every ? kLeftAlone_s : 2); },
                  [&](const RestCase& c, int attempt) -> std::optional<Rest> {
                    auto fine = nearby(c, attempt);
                    if (!fine) return std::nullopt;
                    fine->chain.step_s = kShortStep_s;
                    return run(*fine, 2);
                  });
  for (const int joints : {1, 2, 4, 12}) {
    SerialWorld chain;
    chain.joints = joints;
    if (!every) {
      for (const double step_s : {1e-3, 4e-3}) {
        chain.step_s = step_s;
        table.expect_quiet({chain});
      }
      continue;
    }
    for (const char* type : {"qbmove_maker_pro_6_1", "qbmove_advanced"}) {
      chain.type = type;
      for_every_rest_case(chain, {0.575, 0.785}, {1e-3, 4e-3}, [&](const RestCase& c) { table.expect_quiet(c); });
    }
  }
  table.print(title);
}

/// Tells a robot what the case asks for, before its first step.
inline void prepare_rest(host::Robot& robot, const RestCase& c) {
  if (!c.supply) robot.set_supply(false);
  for (std::size_t i = 0; c.held_rad != 0 && i < robot.size(); ++i) EXPECT_TRUE(robot.command(i, c.held_rad, std::nullopt));
}

/// One joint after a step, its speed as the engine shows it.
inline void sample_rest(RestMeter& meter, const host::Robot& robot, std::size_t joint, double speed_rad_per_s, bool count) {
  host::ActuatorReading r = robot.read(joint);
  r.shaft_speed_rad_per_s = speed_rad_per_s;
  meter.sample(joint, r, count);
}

inline Rest rest_of(const RestMeter& meter, const host::Robot& robot) {
  actuator::Ledger sum;
  for (std::size_t i = 0; i < robot.size(); ++i) sum += robot.ledger(i);
  return meter.rest(sum);
}

}  // namespace vsa::test
