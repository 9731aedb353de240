// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot keeps its units' numbers in lanes from step to step where it can. Nobody may see that: beside it goes one that has to begin
// from the units' states in every step, one that somebody looks at all the time, and one that goes astray and back now and then;
// whatever happens to them, they are the same.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "support/one_joint.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::test {
namespace {

using host::JointIn;
using host::Robot;
using host::RobotConfig;

/// Units beside each other share one law.
device::UnitConfig of_type(char type) {
  static const device::UnitConfig shared = maker_pro();
  device::UnitConfig c = shared;
  if (type == 'b') c.actuator.tendon = {0.06, 2e-3, 3e-3};
  if (type == 'm') c.actuator.side[0].motor.inductance_H = c.actuator.side[1].motor.inductance_H = 1e-3;  // without lanes
  if (type == 's') c.substep_max_s = 0.25e-3;      // longer steps are cut without a tick inside
  if (type == 'w') c.memory.watchdog_period = 50;  // ticks that are never plain
  return c;
}

/// A letter for each actuator's type; a '|' ends a tree of coupled joints, a '/' a bus.
RobotConfig robot_of(const std::string& types, std::vector<std::vector<std::size_t>>& trees) {
  RobotConfig config;
  config.buses.emplace_back();
  int id = 0;
  std::vector<std::size_t> tree;
  for (const char type : types) {
    if (type == '/') {
      config.buses.emplace_back();
      config.buses.back().name = "bus" + std::to_string(config.buses.size());
      id = 0;
    } else if (type == '|') {
      trees.push_back(tree);
      tree.clear();
    } else {
      host::ActuatorConfig a;
      a.name = "a" + std::to_string(config.actuators.size());
      a.joint = a.name;
      a.unit = of_type(type);
      a.bus = config.buses.size() - 1;
      a.id = ++id;
      a.initial_preset = 0.3;
      tree.push_back(config.actuators.size());
      config.actuators.push_back(a);
    }
  }
  return config;  // what is left in `tree` moves each for itself
}

/// A robot with inertias behind its joints; those of a tree are coupled.
struct Bench {
  explicit Bench(const std::string& types) : robot(robot_of(types, trees)), in(robot.size()), torque(robot.size()) {
    robot.join(trees);
    for (const auto& tree : trees) {
      for (std::size_t i = 0; i < tree.size(); ++i)
        for (std::size_t k = 0; k < tree.size(); ++k) mobility.push_back(i == k ? 120.0 : 40.0 / static_cast<double>(1 + i + k));
    }
  }
  void step(std::int64_t dt_ns) {
    for (JointIn& j : in) j.inverse_inertia = 80.0;
    robot.advance(t_ns, dt_ns, in, torque, mobility);
    const double dt = 1e-9 * static_cast<double>(dt_ns);
    for (std::size_t i = 0; i < in.size(); ++i) {
      in[i].placed = false;
      in[i].speed_rad_per_s += dt * 80.0 * (torque[i] - 0.4 * std::sin(in[i].angle_rad) - 0.05 * in[i].speed_rad_per_s);
      in[i].angle_rad += dt * in[i].speed_rad_per_s;
    }
    t_ns += dt_ns;
  }
  std::vector<std::vector<std::size_t>> trees;
  Robot robot;
  std::vector<JointIn> in;
  std::vector<double> torque, mobility;
  std::int64_t t_ns = 0;
};

void look_at_everything(const Robot& robot) {
  for (std::size_t i = 0; i < robot.size(); ++i) {
    static_cast<void>(robot.read(i, device::Torques::told));
    static_cast<void>(robot.ledger(i));
    static_cast<void>(robot.received_inputs(i));
  }
}

/// What may happen to a robot between two steps, the same for every bench.
void something_happens(std::mt19937& random, std::span<Bench* const> benches) {
  const std::size_t who = random() % benches[0]->robot.size();
  const double x = 1e-3 * static_cast<double>(random() % 1000);
  const auto each = [&](const std::function<void(Bench&)>& does) {
    for (Bench* b : benches) does(*b);
  };
  const auto faults = [&](const std::function<void(device::Faults&)>& what) {
    device::Faults f;
    f.seed = 7;
    what(f);
    each([&](Bench& b) { b.robot.set_faults(who, f); });
  };
  switch (random() % 16) {
    case 0:
    case 1:
    case 2:
    case 3:
      return each([&](Bench& b) { ASSERT_TRUE(b.robot.command(who, x - 0.5, 0.6 * x)); });
    case 4:
      return each([&](Bench& b) { ASSERT_TRUE(b.robot.follow(who, Robot::Channel::equilibrium, {{0.01, x}, {0.05, -x}})); });
    case 5:
      return faults([&](device::Faults& f) { f.encoder[random() % 3].noise_rad = 0.01; });
    case 6:
      return faults([&](device::Faults& f) { f.encoder[random() % 3].stuck = true; });
    case 7:
      return faults([&](device::Faults& f) { f.motor_unplugged[random() % 2] = true; });
    case 8:
      return faults([&](device::Faults& f) { f.powered = false; });
    case 9:
      return faults([&](device::Faults& f) { f.lost_byte = f.flipped_byte = 0.02; });
    case 10:
      return faults([&](device::Faults& f) { f.supply_V = 11.0; });
    case 11:
    case 12:  // all is well again, for a while
      return each([](Bench& b) {
        for (std::size_t i = 0; i < b.robot.size(); ++i) b.robot.set_faults(i, {});
        b.robot.set_supply(true);
      });
    case 13:
      return each([&, whole = random() % 2 == 0](Bench& b) {
        b.in[who] = {x, 0.1, 80.0, true};
        if (whole) b.robot.place(who, {x, 0.2, 0.1});
      });
    case 14: {
      const bool on = random() % 4 != 0;
      return each([&](Bench& b) { b.robot.set_supply(on); });
    }
    default: {
      const std::int64_t by_ns = 1'000'000 * static_cast<std::int64_t>(random() % 20);
      return each([&](Bench& b) { b.t_ns += by_ns; });
    }
  }
}

/// Some steps from which it goes back to where it was.
void go_astray(std::mt19937& random, Bench& bench) {
  const std::vector<JointIn> in = bench.in;
  const std::int64_t t_ns = bench.t_ns;
  for (std::size_t steps = 1 + random() % 3; steps > 0; --steps) {
    if (random() % 2 == 0) something_happens(random, std::array{&bench});
    for (JointIn& joint : bench.in) joint.speed_rad_per_s += 1e-3 * static_cast<double>(random() % 100);
    bench.step(random() % 4 == 0 ? 2'500'000 : 1'000'000);
    bench.robot.observe(bench.in);
  }
  bench.robot.go_back();
  bench.in = in;
  bench.t_ns = t_ns;
}

void compare(const std::string& types, unsigned seed) {
  std::mt19937 random(seed);
  Bench quiet(types), fresh(types), watched(types), back(types);
  const std::array<Bench*, 4> all{&quiet, &fresh, &watched, &back};
  std::int64_t dt_ns = 1'000'000;
  for (int step = 0; step < 700; ++step) {
    fresh.robot.restore(*fresh.robot.snapshot());  // which drops what it hasn't been told yet
    back.robot.keep();
    if (random() % 4 == 0) go_astray(random, back);
    if (random() % 25 == 0) something_happens(random, all);
    // Most of the time at a millisecond, on the ticks; else steps without a tick, with one inside, with several.
    if (random() % 40 == 0) dt_ns = std::array{1'000'000, 1'000'000, 1'000'000, 250'000, 500'000, 700'000, 2'000'000}[random() % 7];
    if (dt_ns == 1'000'000 && random() % 8 == 0)
      for (Bench* b : all) b->t_ns = (b->t_ns + 999'999) / 1'000'000 * 1'000'000;
    for (Bench* b : all) b->step(dt_ns);
    if (step % 3 == 0)
      for (Bench* b : all) b->robot.observe(b->in);
    look_at_everything(watched.robot);
    ASSERT_EQ(quiet.torque, fresh.torque) << types << ", seed " << seed << ", step " << step;
    ASSERT_EQ(quiet.torque, watched.torque) << types << ", seed " << seed << ", step " << step;
    ASSERT_EQ(quiet.torque, back.torque) << types << ", seed " << seed << ", step " << step;
    const std::size_t one = random() % quiet.in.size();
    for (const Bench* b : {&quiet, &fresh, &watched}) {
      const double told = step % 3 == 0 ? b->in[one].speed_rad_per_s : b->robot.read(one).shaft_speed_rad_per_s;
      ASSERT_EQ(b->robot.read(one).shaft_speed_rad_per_s, told) << types << ", seed " << seed << ", step " << step;
    }
    if (random() % 30 != 0) continue;
    ASSERT_EQ(quiet.robot.state_hash(), fresh.robot.state_hash()) << types << ", seed " << seed << ", step " << step;
    ASSERT_EQ(quiet.robot.state_hash(), watched.robot.state_hash()) << types << ", seed " << seed << ", step " << step;
    ASSERT_EQ(quiet.robot.state_hash(), back.robot.state_hash()) << types << ", seed " << seed << ", step " << step;
  }
}

TEST(InLanes, NobodyCanTell) {
  for (const char* types : {"aaaaaaaaaaaa|", "aaaaaaaaaaaa", "aaaaaaaaaaaa/aaaaaaaaaaaa/aaa", "aaa|bbbb|aab/aaaaa|bb|aab",
                            "aamaa|bb", "aawaa|aaa", "ab|a", "a", "mmm|aa", "sss", "aaa|ssss|sa"})
    for (unsigned seed = 1; seed < 5; ++seed) compare(types, seed);
}

/// From steps that are whole, which leave the units in lanes, to one that the type's substep_max_s cuts although no tick lies inside.
TEST(InLanes, AStepThatIsCutSetsOutFromWhatTheyHold) {
  for (const char* types : {"sss", "ssss|", "aasss"}) {
    Bench quiet(types), fresh(types);
    for (Bench* b : {&quiet, &fresh}) {
      ASSERT_TRUE(b->robot.command(1, 0.6, 0.5));
      b->step(1'000'000);  // takes the command, which a restore would drop
    }
    for (int round = 0; round < 20; ++round) {
      for (const std::int64_t dt_ns : {250'000, 250'000, 500'000, 250'000, 250'000, 250'000, 250'000, 1'000'000}) {
        fresh.robot.restore(*fresh.robot.snapshot());
        for (Bench* b : {&quiet, &fresh}) b->step(dt_ns);
        ASSERT_EQ(quiet.torque, fresh.torque) << types << ", round " << round << ", a step of " << dt_ns << " ns";
      }
    }
    EXPECT_EQ(quiet.robot.state_hash(), fresh.robot.state_hash()) << types;
  }
}

/// What a robot went back to, and what it was given, is what counts, not what its lanes still hold.
TEST(InLanes, WhatIsGoneIsGone) {
  Bench one("aaaaaaaaaaaa|aaaaaaaa"), other("aaaaaaaaaaaa|aaaaaaaa");
  for (int step = 0; step < 50; ++step)
    for (Bench* b : {&one, &other}) b->step(1'000'000);
  for (const bool looked : {false, true}) {
    one.robot.keep();
    const auto then = one.in;
    const std::int64_t then_ns = one.t_ns;
    for (int step = 0; step < 21; ++step) one.step(1'000'000);
    EXPECT_TRUE(!looked || one.robot.state_hash() != other.robot.state_hash());
    one.robot.go_back();
    one.in = then;
    one.t_ns = then_ns;
    for (int step = 0; step < 20; ++step) {
      for (Bench* b : {&one, &other}) b->step(1'000'000);
      ASSERT_EQ(one.torque, other.torque) << "step " << step;
    }
    EXPECT_EQ(one.robot.state_hash(), other.robot.state_hash());
  }
  Robot copy = one.robot.clone();
  EXPECT_EQ(copy.state_hash(), one.robot.state_hash());
  // Other parameters, and those that were: of a joint of a tree and of one alone, beside a robot that is made of them.
  device::UnitConfig harder = of_type('a');
  harder.actuator.side[0].gearbox.friction.coulomb_Nm *= 2;
  for (const std::size_t who : {3, 15}) {
    for (const device::UnitConfig& unit : {harder, of_type('a')}) {
      one.robot.set_parameters(who, unit);
      other.robot = one.robot.clone();
      for (int step = 0; step < 20; ++step) {
        other.robot.restore(*other.robot.snapshot());
        for (Bench* b : {&one, &other}) b->step(1'000'000);
        ASSERT_EQ(one.torque, other.torque) << "step " << step;
      }
    }
  }
  EXPECT_EQ(one.robot.state_hash(), other.robot.state_hash());
  // What was kept before other parameters came goes on with them, and what was kept before other trees.
  one.robot.keep();
  const auto then = other.robot.snapshot();
  for (Bench* b : {&one, &other}) b->robot.set_parameters(3, harder);
  one.robot.go_back();
  other.robot.restore(*then);
  EXPECT_EQ(one.robot.state_hash(), other.robot.state_hash());
  for (int step = 0; step < 20; ++step)
    for (Bench* b : {&one, &other}) b->step(1'000'000);
  one.robot.keep();
  for (Bench* b : {&one, &other}) b->robot.join({});
  one.robot.go_back();
  EXPECT_EQ(one.robot.state_hash(), other.robot.state_hash());
}

}  // namespace
}  // namespace vsa::test
