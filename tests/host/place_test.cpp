// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robot::place, set_parameters, clone, and whose snapshots a robot takes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/free_flanges.hpp"
#include "support/ledger.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/errors.hpp"

long allocation_count();  // allocations.cpp

namespace {

using vsa::InputError;
using vsa::host::Placement;
using vsa::host::Robot;
using vsa::host::RobotConfig;
using vsa::test::chain;
using Bench = vsa::test::Flanges;

constexpr double kResolution_rad = 2 * vsa::kPi / 4096;  // of the encoders: what the program can't see

/// Units that may go far: four turns in 16 bits, without limits.
RobotConfig far_reaching(std::size_t count) {
  RobotConfig config = chain(count);
  for (auto& a : config.actuators) {
    a.unit.memory.resolution = {3, 3, 3};
    a.unit.memory.limits_on = 0;
  }
  return config;
}

/// The host's part: where the joint is.
void put(Bench& bench, std::size_t i, const Placement& at) {
  bench.robot.place(i, at, static_cast<double>(bench.dt_ns) * 1e-9);
  bench.in[i].angle_rad = at.angle_rad;
  bench.in[i].speed_rad_per_s = at.speed_rad_per_s;
}

TEST(Place, AJointThatIsPlacedStaysThere) {
  for (const double q : {-1.0, 0.4, 1.0, 2.1}) {
    Bench bench(chain(2));
    bench.run(37);
    ASSERT_NO_THROW(put(bench, 0, {q, 0.6})) << q;
    double furthest = 0, fastest = 0;
    for (int n = 0; n < 300; ++n) {
      bench.step();
      furthest = std::max(furthest, std::abs(bench.in[0].angle_rad - q));
      fastest = std::max(fastest, std::abs(bench.in[0].speed_rad_per_s));
    }
    EXPECT_LT(furthest, kResolution_rad) << q;
    EXPECT_LT(fastest, 0.05) << q;
    const auto now = bench.robot.read(0);
    EXPECT_EQ(now.equilibrium_command_rad, q);
    EXPECT_EQ(now.preset_command, 0.6);
    EXPECT_NEAR(now.preset, 0.6, 0.03) << "the position loop gives way to the springs that pull on both pulleys, as it does anyway";
    EXPECT_NEAR(now.measured[2].value * vsa::kPi / 16384, q, 2e-3);
    EXPECT_LT(std::abs(bench.robot.ledger(0).imbalance()), 1e-9);
    vsa::test::expect_small_closures(bench.robot.ledger(0), 0.01);
  }
}

TEST(Place, BeyondATurnTooWhereTheProgramCanHoldIt) {
  for (const double q : {7.5, -9.9, 3.2, 20.0}) {
    Bench bench(far_reaching(1));
    bench.run(5);
    put(bench, 0, {q, 0.5});
    bench.run(200);
    EXPECT_NEAR(bench.in[0].angle_rad, q, 2 * kResolution_rad);
    for (int i = 0; i < 3; ++i) {
      const double read = bench.robot.read(0).measured[static_cast<std::size_t>(i)].value * 8 * 2 * vsa::kPi / 65536;
      EXPECT_NEAR(read, i == 2 ? q : i == 0 ? q + 0.5 : q - 0.5, i == 2 ? 4e-3 : 0.02) << "encoder " << i << " at " << q;
    }
  }
}

TEST(Place, WhatTheProgramCannotHoldIsRefusedAndNothingChanged) {
  Bench bench(chain(1));
  bench.run(10);
  const auto before = bench.robot.read(0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(bench.robot.place(0, {4.0, 0.2}), InputError) << "limits ±30000 raw";
  EXPECT_THROW(bench.robot.place(0, {0.0, 0.8}), InputError) << "preset_max";
  EXPECT_THROW(bench.robot.place(0, {nan, 0.2}), InputError);
  EXPECT_THROW(bench.robot.place(0, {0.0, nan}), InputError);
  EXPECT_THROW(bench.robot.place(0, {0.0, 0.2, nan}), InputError);
  EXPECT_THROW(bench.robot.place(0, {0.0, 0.2, 0.0, nan}), InputError);
  EXPECT_THROW(bench.robot.place(0, {0.0, 0.2}, 0.1), InputError);
  EXPECT_THROW(bench.robot.place(1, {0.0, 0.2}), InputError);
  EXPECT_EQ(bench.robot.read(0).motor_rad, before.motor_rad);
  EXPECT_EQ(bench.robot.read(0).equilibrium_command_rad, before.equilibrium_command_rad);
}

TEST(Place, AMovingJointTakesItsPulleysAlong) {
  for (const std::int64_t dt_ns : {500'000, 1'000'000, 4'000'000}) {
    Bench bench(chain(1), dt_ns);
    const double speed = 8;
    put(bench, 0, {0.3, 0.6, speed});
    bench.step();
    // Nothing has bent yet, so that the spring gives next to nothing: at 74 N·m/rad half a step of a pulley left behind would be
    // seen.
    EXPECT_LT(std::abs(bench.robot.read(0).torque_Nm), 0.1 + 3.0 * static_cast<double>(dt_ns) * 1e-6) << dt_ns;
    EXPECT_NEAR(bench.in[0].speed_rad_per_s, speed, 0.4 * static_cast<double>(dt_ns) * 1e-6 * speed) << dt_ns;
  }
}

TEST(Place, ACommandOfItsOwnBendsTheSpring) {
  // Held by a weight: the equilibrium lies above the shaft by what the spring gives for it.
  Bench bench(chain(1));
  put(bench, 0, {0.2, 0.4, 0.0, 0.35});
  bench.step();
  const auto now = bench.robot.read(0);
  EXPECT_EQ(now.equilibrium_command_rad, 0.35);
  const double expected = 2 * 0.022 * std::cosh(6.85 * 0.4) * std::sinh(6.85 * 0.15);
  EXPECT_NEAR(now.torque_Nm, expected, 0.15 * expected);
}

TEST(Place, ForgetsCommandsThatWait) {
  Bench bench(chain(2));
  ASSERT_TRUE(bench.robot.command(0, 1.2, 0.1));
  ASSERT_TRUE(bench.robot.command(1, 0.7, 0.1));
  put(bench, 0, {0.5, 0.3});
  bench.step();
  EXPECT_EQ(bench.robot.read(0).equilibrium_command_rad, 0.5);
  EXPECT_EQ(bench.robot.read(1).equilibrium_command_rad, 0.7);
}

TEST(Parameters, ActFromTheNextStepAndSurviveAReset) {
  Bench bench(chain(2));
  bench.run(20);
  auto unit = bench.robot.config().actuators[0].unit;
  unit.actuator.transmission = std::make_shared<vsa::elastic::TwoSinh>(vsa::elastic::TwoSinhParams{{0.044, 0.044}, {6.85, 6.85}});
  const double before = bench.robot.read(0).stiffness_Nm_per_rad, other = bench.robot.read(1).stiffness_Nm_per_rad;
  bench.robot.set_parameters(0, unit);
  bench.step();
  EXPECT_NEAR(bench.robot.read(0).stiffness_Nm_per_rad, 2 * before, 0.05 * before);
  EXPECT_NEAR(bench.robot.read(1).stiffness_Nm_per_rad, other, 0.02 * other) << "the other one shared its parameters";
  bench.run(100);
  EXPECT_LT(std::abs(bench.robot.ledger(0).imbalance()), 1e-9);
  vsa::test::expect_small_closures(bench.robot.ledger(0), 0.01);
  bench.robot.reset();
  bench.t_ns = 0;
  for (auto& joint : bench.in) joint = {0, 0, 1e3};
  bench.step();
  EXPECT_NEAR(bench.robot.read(0).stiffness_Nm_per_rad, 2 * before, 0.05 * before);
}

TEST(Parameters, ARobotThatGotThemIsTheOneBuiltWithThemAfterAReset) {
  RobotConfig config = chain(1);
  Bench changed(config);
  changed.run(50);
  for (auto& side : config.actuators[0].unit.actuator.side) side.motor.resistance_Ohm = 4.0;
  config.actuators[0].unit.actuator.supply_V = 18;
  config.actuators[0].unit.memory.position.p /= 2;
  changed.robot.set_parameters(0, config.actuators[0].unit);
  changed.robot.reset();
  changed.t_ns = 0;
  changed.in[0] = {0, 0, 1e3};
  Bench built(config);
  for (Bench* b : {&changed, &built}) {
    b->robot.command(0, 0.8, 0.4);
    b->run(150);
  }
  EXPECT_EQ(changed.in[0].angle_rad, built.in[0].angle_rad);
  EXPECT_NE(changed.in[0].angle_rad, 0.0);
}

TEST(Parameters, GainsActAtOnce) {
  Bench soft(chain(1)), plain(chain(1));
  for (Bench* b : {&soft, &plain}) b->run(30);
  auto unit = soft.robot.config().actuators[0].unit;
  unit.memory.position.p /= 10;
  soft.robot.set_parameters(0, unit);
  for (Bench* b : {&soft, &plain}) {
    b->robot.command(0, 0.2, std::nullopt);
    b->run(60);
  }
  EXPECT_LT(soft.robot.read(0).motor_rad[0], plain.robot.read(0).motor_rad[0] - 0.02);
}

TEST(Parameters, ThatAreAsTheyWereChangeNoBit) {
  Bench set(chain(2)), plain(chain(2));
  for (Bench* b : {&set, &plain}) {
    b->robot.command(0, 0.8, 0.4);
    b->run(50);
  }
  auto unit = set.robot.config().actuators[0].unit;
  const auto& law = dynamic_cast<const vsa::elastic::TwoSinh&>(*unit.actuator.transmission);
  unit.actuator.transmission = std::make_shared<vsa::elastic::TwoSinh>(law.params());  // equal, but another
  set.robot.set_parameters(0, unit);
  EXPECT_EQ(set.robot.state_hash(), plain.robot.state_hash());
}

TEST(Parameters, MotionGoesOnThroughAnother) {
  // A stiff spring at speed: one that began again would foresee nothing of what it did so far.
  Bench bench(chain(1));
  bench.robot.command(0, 0.8, 0.7);
  bench.run(60);
  auto unit = bench.robot.config().actuators[0].unit;
  unit.memory.position.p += 1;
  ASSERT_GT(std::abs(bench.in[0].speed_rad_per_s), 0.1);
  bench.robot.set_parameters(0, unit);
  bench.run(3);
  const vsa::actuator::Ledger sum = bench.robot.ledger(0);
  EXPECT_LT(std::abs(sum.imbalance()), 1e-12);
  EXPECT_GE(sum.coupling, -1e-3 * sum.moved()) << sum.moved();
}

TEST(Parameters, ThatNoUnitCouldHaveAreRefused) {
  Bench bench(chain(1));
  const auto good = bench.robot.config().actuators[0].unit;
  const auto refused = [&](auto&& spoil) {
    auto unit = good;
    spoil(unit);
    EXPECT_THROW(bench.robot.set_parameters(0, unit), InputError);
    RobotConfig config = chain(1);
    config.actuators[0].unit = unit;
    return config;
  };
  const auto never = [&](auto&& spoil) { EXPECT_THROW(Robot{refused(spoil)}, InputError); };
  never([](auto& u) { u.actuator.transmission = nullptr; });
  never([](auto& u) {
    for (auto& side : u.actuator.side) side.motor.inertia_kgm2 = 0;
  });
  never([](auto& u) {
    for (auto& side : u.actuator.side) side.motor.resistance_Ohm = std::nan("");
  });
  never([](auto& u) {
    for (auto& side : u.actuator.side) side.gearbox.ratio = -1;
  });
  never([](auto& u) {
    for (auto& side : u.actuator.side) side.encoder.bits = 40;
  });
  never([](auto& u) { u.memory.resolution[1] = 40; });
  never([](auto& u) { u.substep_max_s = 0; });
  never([](auto& u) { u.actuator.side[0].polarity = 0; });
  never([](auto& u) { u.preset_max = std::nan(""); });
  // Fine for another robot, but not for one that is under way.
  (void)refused([](auto& u) { u.program.model = vsa::firmware::Model::advanced; });
  (void)refused([](auto& u) { u.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(5.0); });
  EXPECT_THROW(bench.robot.set_parameters(1, good), InputError);
}

TEST(Snapshots, CrossBetweenRobotsOfTheSameKindBitForBit) {
  Bench a(chain(3)), b(chain(3));
  a.robot.command(0, 0.6, 0.5);
  a.run(40);
  b.robot.restore(*a.robot.snapshot());
  b.in = a.in;
  b.t_ns = a.t_ns;
  for (Bench* x : {&a, &b}) x->run(60);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.in[i].angle_rad, b.in[i].angle_rad);
  Robot clone = a.robot.clone();
  EXPECT_EQ(clone.read(0).motor_rad, a.robot.read(0).motor_rad);
}

TEST(Snapshots, OfAnotherRobotAreRefusedAndNothingChanged) {
  Bench bench(chain(2));
  bench.run(10);
  const auto before = bench.robot.read(1);
  const auto refused = [&](RobotConfig config) {
    const Robot other(std::move(config));
    EXPECT_THROW(bench.robot.restore(*other.snapshot()), InputError);
    EXPECT_THROW(bench.robot.check(*other.snapshot()), InputError);
  };
  refused(chain(3));
  refused(chain(1));
  RobotConfig other = chain(2);
  other.actuators[1].joint = "elsewhere";
  refused(other);
  other = chain(2);
  other.actuators[1].id = 7;
  refused(other);
  other = chain(2);
  other.buses.push_back({"second", 2e6, std::nullopt});
  refused(other);
  other = chain(2);
  other.buses[0].serial_port = "port";
  refused(other);
  EXPECT_EQ(bench.robot.read(1).motor_rad, before.motor_rad);
}

TEST(Snapshots, WithOtherParametersGoOnWithTheRobotsOwn) {
  Bench bench(chain(1));
  bench.robot.command(0, 0.5, 0.5);
  bench.run(100);
  const auto then = bench.robot.snapshot();
  auto unit = bench.robot.config().actuators[0].unit;
  unit.actuator.transmission = std::make_shared<vsa::elastic::TwoSinh>(vsa::elastic::TwoSinhParams{{0.01, 0.01}, {5.0, 5.0}});
  bench.robot.set_parameters(0, unit);
  bench.robot.restore(*then);
  bench.run(100);
  EXPECT_LT(std::abs(bench.robot.ledger(0).imbalance()), 1e-9);
  EXPECT_LT(std::abs(bench.robot.ledger(0).integrator), 1e-3) << "the springs' place was kept in the old law's numbers";
  const auto now = bench.robot.read(0);
  EXPECT_NEAR(now.stiffness_Nm_per_rad, 2 * 5.0 * 0.01 * std::cosh(5.0 * now.preset) * std::cosh(5.0 * now.deflection_rad), 1e-9);
}

TEST(Commands, OfConstantsAllocateNothingOnceThereIsRoom) {
  Bench bench(chain(4));
  const auto round = [&] {
    for (std::size_t i = 0; i < 4; ++i) ASSERT_TRUE(bench.robot.command(i, 0.1, 0.2));
    bench.step();
  };
  for (int n = 0; n < 3; ++n) round();
  const long before = allocation_count();
  for (int n = 0; n < 20; ++n) round();
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
