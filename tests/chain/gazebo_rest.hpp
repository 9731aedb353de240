// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What both Gazebos are tried with: the chains of rest_cases.hpp that a server's own start leaves time for.
#pragma once

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "chain/rest_cases.hpp"

namespace vsa::test {

constexpr double kLeftAlone_s = 5, kMeasured_s = 0.5, kShortStep_s = 1e-4;
constexpr double kCreatedBesideDampers_J = -2e-3;

/// Of a link as a rod, about its centre.
inline double rod_kgm2(const SerialWorld& w) { return w.mass_kg * w.length_m * w.length_m / 12; }

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

/// Chains with the host's own dampers at their joints, nothing commanded. What such a damper did in the last step isn't what it
/// does in this one: a robot that went on with that shook for ever, or blew up. `implicit_damper`: as SerialWorld's.
inline void expect_gazebo_quiet_with_dampers(const GazeboRun& run, const std::string& title, const std::vector<double>& dampings,
                                             bool implicit_damper = false) {
  double rms = 0, top = 0, coupling_J = 0;
  RestCase c;
  c.chain.implicit_damper = implicit_damper;
  const auto expect_quiet = [&] {
    const Rest rest = run(c, 3);
    const std::string what = named(c) + ", damping " + std::to_string(c.chain.damping);
    EXPECT_LT(rest.rms_speed, kQuiet_rad_per_s) << what;
    EXPECT_GT(rest.coupling_J, kCreatedBesideDampers_J) << what;
    rms = std::max(rms, rest.rms_speed);
    top = std::max(top, rest.top_speed);
    coupling_J = std::min(coupling_J, rest.coupling_J);
  };
  for (c.chain.joints = 1; c.chain.joints <= 4; c.chain.joints += 3) {
    for (const double mass_kg : {0.1, 0.45}) {
      c.chain.mass_kg = mass_kg;
      c.chain.inertia_kgm2 = rod_kgm2(c.chain);
      for (const double damping : dampings) {
        c.chain.damping = damping;
        for (const double step_s : {1e-3, 2e-3, 4e-3}) {
          c.chain.step_s = step_s;
          expect_quiet();
        }
      }
    }
  }
  EXPECT_GT(top, 0.01) << title << ": nothing moved";
  std::printf("%s, dampers: at most %.1e rad/s, coupling %.1e J\n", title.c_str(), rms, coupling_J);
}

/// What RestBeside of test_chain is for the embedded engine: springs at the actuated joints, passive hinges behind and before them, a
/// heavy load that hangs on light links. A robot that went on with what these did in the last step shook. `implicit`: the engine
/// takes springs and dampers so, as strong as they like. `iterative`: it solves joints in rounds, as ODE, which can't hold 5 kg on
/// links of 10 g in steps of 2 ms.
inline std::vector<std::pair<std::string, RestCase>> rest_cases_beside(bool implicit, bool iterative) {
  std::vector<std::pair<std::string, RestCase>> out;
  const auto add = [&](std::string what, SerialWorld chain, const std::vector<double>& steps_s) {
    chain.inertia_kgm2 = rod_kgm2(chain);
    for (const double step_s : steps_s) {
      chain.step_s = step_s;
      out.emplace_back(what + ", " + std::to_string(step_s * 1e3) + " ms", RestCase{chain});
    }
  };
  const std::vector<double> some{1e-3, 2e-3}, all{1e-3, 2e-3, 4e-3}, steps_s = implicit ? all : some;
  for (const double spring : implicit ? std::vector{1.0, 10.0, 100.0} : std::vector{1.0, 10.0}) {
    SerialWorld springs;
    springs.mass_kg = 0.3;
    springs.spring = spring;
    add("springs of " + std::to_string(spring) + " N m/rad", springs, steps_s);
  }
  SerialWorld passive;
  passive.mass_kg = 0.05;
  passive.length_m = 0.1;
  for (const double damping : implicit ? std::vector{0.03, 0.3} : std::vector{0.003, 0.03}) {
    for (const double spring : {0.0, 3.0}) {
      passive.passive_damping = damping;
      passive.passive_spring = spring;
      const std::string with = std::to_string(damping) + " N m s/rad, " + std::to_string(spring) + " N m/rad";
      passive.robots = {1};
      passive.passive_first = false;
      add("a passive hinge behind with " + with, passive, implicit ? all : std::vector{1e-3});
      passive.robots = {};
      passive.passive_first = true;
      add("a passive hinge before with " + with, passive, implicit ? all : std::vector{1e-3});
    }
  }
  SerialWorld loaded;
  loaded.joints = 3;
  loaded.gravity = true;
  loaded.mass_kg = 0.01;
  loaded.length_m = 0.02;
  for (const double load_kg : {1.0, 5.0}) {
    for (const double preset : {0.2, 0.4, 0.785}) {
      loaded.last_mass_kg = load_kg;
      loaded.last_inertia_kgm2 = load_kg * 1e-3;
      loaded.preset = preset;
      add(std::to_string(load_kg) + " kg on light links, preset " + std::to_string(preset), loaded,
          iterative && load_kg > 1 ? std::vector{1e-3} : some);
    }
  }
  for (auto& [what, c] : out) c.chain.implicit_damper = implicit;
  return out;
}

/// Where the unit's own program plucks a joint at an encoder count's edge, it is as busy in steps a tenth as long.
inline void expect_gazebo_quiet_beside(const GazeboRun& run, const std::string& title, bool implicit, bool iterative = false) {
  double top = 0;
  for (const auto& [what, c] : rest_cases_beside(implicit, iterative)) {
    const Rest rest = run(c, 3);
    top = std::max(top, rest.top_speed);
    std::printf("%s, %s: %.4f rad/s, coupling %.1e J\n", title.c_str(), what.c_str(), rest.rms_speed, rest.coupling_J);
    EXPECT_GT(rest.coupling_J, kCreatedBesideDampers_J) << title << ", " << what;
    if (rest.rms_speed < kQuiet_rad_per_s) continue;
    RestCase fine = c;
    fine.chain.step_s = kShortStep_s;
    EXPECT_LT(rest.rms_speed, 2 * run(fine, 3).rms_speed) << title << ", " << what;
  }
  EXPECT_GT(top, 0.01) << title << ": nothing moved";
}

/// What is left of a speed of 1 rad/s after a step of a host alone, of one link with a damper: whether the damper is of the speed at
/// the step's end, or of that at its start, of which a strong one makes a speed the other way. B has to be of the same mind.
inline void expect_left_by_damper(const std::function<double(const SerialWorld&)>& speed_after_a_step, bool implicit,
                                  SerialWorld w = {}) {
  w.joints = 1;
  w.mass_kg = 0.1;
  w.inertia_kgm2 = rod_kgm2(w);
  for (const double damping : {0.03, 0.1, 1.0}) {
    w.damping = damping;
    const double part = w.step_s * damping / (w.inertia_kgm2 + w.mass_kg * w.length_m * w.length_m / 4);
    EXPECT_NEAR(speed_after_a_step(w), implicit ? 1 / (1 + part) : 1 - part, 1e-3 * (1 + part)) << damping;
  }
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
