// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Links without actuators and dampers that swing and turn over: what energy they have stays theirs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "arm.hpp"
#include "four_bar.hpp"
#include "vsa/physics/mujoco.hpp"

namespace vsa::engine::testing {
namespace {

/// Hinged rods of various masses and lengths, which lie level at the start. `tied`: the second follows the first.
std::string rods(int count, bool alternating, unsigned seed, bool tied = false) {
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / 4294967295.0;
  };
  std::string links, joints;
  double x = 0;
  for (int k = 0; k < count; ++k) {
    const double mass = between(0.1, 0.5), length = between(0.1, 0.3);
    const std::string name = "l" + std::to_string(k), before = k == 0 ? "world" : "l" + std::to_string(k - 1);
    links += "<link name='" + name + "'><pose>" + std::to_string(x) + " 0 1 0 0 0</pose>" +
             inertial(mass, 0.1 * mass * length * length, std::to_string(length / 2) + " 0 0 0 0 0") + "</link>";
    joints +=
        "<joint name='j" + std::to_string(k) + "' type='revolute'><parent>" + before + "</parent><child>" + name +
        "</child><axis><xyz>" + (alternating && k % 2 != 0 ? "0 0 1" : "0 1 0") + "</xyz>" +
        (tied && k == 1 ? "<mimic joint='j0'><multiplier>0.5</multiplier><offset>0</offset><reference>0</reference></mimic>" : "") +
        "</axis></joint>";
    x += length;
  }
  return world("<model name='m'>" + links + joints + "</model>");
}

struct Drift {
  double gain = 0, loss = 0;  ///< over the largest kinetic energy
};
Drift drift(const std::string& sdf, double step_s, double seconds = 5, physics::Coriolis coriolis = physics::Coriolis::of_now) {
  WorldOptions options;
  options.step_s = step_s;
  options.physics = physics::mujoco(coriolis);
  World w = World::load_string(sdf, options);
  w.step();
  const auto total = [&] { return w.energy().kinetic + w.energy().gravitational; };
  const double begun = total();
  double most = 0, least = 0, fastest = 0;
  while (w.time_s() < seconds) {
    w.run(0.02);
    most = std::max(most, total() - begun);
    least = std::min(least, total() - begun);
    fastest = std::max(fastest, w.energy().kinetic);
  }
  return {most / fastest, -least / fastest};
}

/// Prints the table of docs/explanation/8-engine.md.
TEST(Passive, ChainsKeepTheirEnergy) {
  for (const int count : {2, 3, 4, 6}) {
    for (const bool alternating : {false, true}) {
      Drift worst, by_itself;
      const auto take = [](Drift& into, const Drift& d) { into = {std::max(into.gain, d.gain), std::max(into.loss, d.loss)}; };
      for (unsigned seed = 1; seed < 6; ++seed) {
        const std::string sdf = rods(count, alternating, seed);
        take(worst, drift(sdf, 1e-3));
        take(by_itself, drift(sdf, 1e-3, 5, physics::Coriolis::as_in_mj_step));
      }
      const char* axes = alternating ? "alternating" : "parallel";
      std::printf("%d rods, %s: gain %.2f %%, loss %.2f %%; as in mj_step %.1f %%, %.1f %%\n", count, axes, 100 * worst.gain,
                  100 * worst.loss, 100 * by_itself.gain, 100 * by_itself.loss);
      EXPECT_LT(worst.gain, count > 4 ? 0.02 : 0.01) << count << " rods, " << axes;
      EXPECT_LT(worst.loss, count > 4 ? 0.06 : 0.02) << count << " rods, " << axes;
    }
  }
}

TEST(Passive, WhatTheyLoseOrGainIsOfTheSecondOrder) {
  const auto off = [](double step_s) {
    const Drift d = drift(rods(2, false, 1), step_s, 1.5);
    return std::max(d.gain, d.loss);
  };
  const double coarse = off(2e-3), fine = off(5e-4);
  EXPECT_LT(fine, coarse / 8) << "4 × finer: 16 × less, or 4 × in the first order";
  EXPECT_GT(fine, 0);
}

TEST(Passive, LongChainsAtLongStepsStayFinite) {
  for (const int count : {8, 12}) {
    for (unsigned seed = 1; seed < 25; ++seed) {
      const Drift d = drift(rods(count, false, seed), 4e-3);
      EXPECT_TRUE(std::isfinite(d.gain)) << count << " rods, seed " << seed;
    }
  }
  for (unsigned seed = 1; seed < 9; ++seed) EXPECT_TRUE(std::isfinite(drift(rods(8, false, seed, true), 4e-3).gain)) << seed;
}

/// Turns about its middle axis, and so turns over (Euler's equations); nothing pulls.
TEST(Passive, ABodyThatTumblesKeepsItsEnergyAndItsMomentum) {
  const std::string body =
      "<model name='m'><link name='l'><inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.025</izz></inertia>"
      "</inertial></link></model>";
  for (const double step_s : {1e-3, 4e-3}) {
    WorldOptions options;
    options.step_s = step_s;
    World w = World::load_string(world(body, "0 0 0"), options);
    // A torque for a moment, about an axis between the principal ones.
    Wrench spin;
    spin.torque_Nm = {0.001 / step_s, 0.2 / step_s, 0.001 / step_s};
    w.apply_wrench(w.link("m::l"), spin);
    w.step();
    w.apply_wrench(w.link("m::l"), {});
    w.step();
    const double begun = w.energy().kinetic;
    ASSERT_NEAR(begun, 0.5 * 0.2 * 0.2 / 0.02, 0.05);
    double off = 0, turned_over = 1;
    while (w.time_s() < 10) {
      w.step();
      off = std::max(off, std::abs(w.energy().kinetic / begun - 1));
      turned_over = std::min(turned_over, turned(pose_of(w, "m::l"), {0, 1, 0})[1]);
    }
    EXPECT_LT(turned_over, 0.9) << step_s;
    EXPECT_LT(off, step_s > 2e-3 ? 0.02 : 0.002) << step_s;
  }
}

}  // namespace
}  // namespace vsa::engine::testing
