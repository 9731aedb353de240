// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "host/free_flanges.hpp"
#include "support/ledger.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/errors.hpp"

long allocation_count();  // allocations.cpp

namespace {

using vsa::host::ActuatorConfig;
using vsa::host::JointIn;
using vsa::host::Robot;
using vsa::host::RobotConfig;
using vsa::test::chain;
using Bench = vsa::test::Flanges;

constexpr double kAside_rad = 0.02;

bool tells_of_energy(Robot& robot) {
  const auto notices = robot.take_notices();
  return std::any_of(notices.begin(), notices.end(),
                     [](const vsa::host::Notice& n) { return n.text.find("out of nothing") != std::string::npos; });
}

TEST(Robot, WhatIsTheWholeRobotsIsToldOfNoActuator) {
  // The host throws its flanges to and fro without telling, each step against what was foreseen.
  Bench bench(chain(2));
  for (int n = 0; n < 256; ++n) {
    for (JointIn& joint : bench.in) joint = {n % 2 == 0 ? 0.2 : -0.2, 0, 1e3};
    bench.step();
  }
  bool told = false;
  for (const vsa::host::Notice& n : bench.robot.take_notices()) {
    if (n.text.find("out of nothing") == std::string::npos) continue;
    told = true;
    EXPECT_FALSE(n.actuator.has_value()) << n.text;
  }
  EXPECT_TRUE(told);
}

TEST(Robot, EnergyOutOfNothingIsToldThoughMotorsThatHoldBurnAHundredTimesAsMuch) {
  RobotConfig config = chain(1);
  config.actuators[0].initial_preset = 0.785;
  Bench bench(config);
  for (JointIn& joint : bench.in) joint.inverse_inertia = 3e3;
  for (int n = 0; n < 4000; ++n) {
    const bool thrown = n >= 3500 && n < 3503;  // held for long before
    const double to = !thrown ? 0.0 : n % 2 == 0 ? kAside_rad : -kAside_rad;
    for (JointIn& joint : bench.in) joint.angle_rad = to, joint.speed_rad_per_s = 0;
    bench.robot.advance(bench.t_ns, bench.dt_ns, bench.in, bench.out);
    bench.t_ns += bench.dt_ns;
  }
  const vsa::actuator::Ledger sum = bench.robot.ledger();
  ASSERT_LT(sum.coupling, -0.01);
  ASSERT_GT(sum.coupling, -0.005 * sum.moved()) << "it would be told anyway";
  EXPECT_TRUE(tells_of_energy(bench.robot)) << sum.coupling << " J of " << sum.delivered_moved << " at the shaft, " << sum.moved()
                                            << " in all";
}

TEST(Robot, UnitTwelveMovesLaterThanUnitOneByTheTimeTheFramesTake) {
  // At 115200 baud a unit's slot is 28 bytes = 2.43 ms: unit 12 is 26.7 ms behind unit 1.
  RobotConfig config = chain(12);
  config.buses[0].baud_Hz = 115200;
  Bench bench(config);
  bench.run(100);
  for (std::size_t i = 0; i < 12; ++i) ASSERT_TRUE(bench.robot.command(i, 0.5, std::nullopt));
  std::vector<int> moved(12, -1);
  for (int n = 0; n < 200; ++n) {
    bench.step();
    for (std::size_t i = 0; i < 12; ++i)
      if (moved[i] < 0 && std::abs(bench.robot.read(i).motor_speed_rad_per_s[0]) > 0.1) moved[i] = n;
  }
  for (std::size_t i = 0; i < 12; ++i) ASSERT_GE(moved[i], 0) << i;
  const auto schedule = vsa::bus::make_schedule(12, 115200, std::nullopt);
  const double expected_ms = static_cast<double>(schedule.inputs_at_ns(0, 11) - schedule.inputs_at_ns(0, 0)) * 1e-6;
  const double cycle_ms = static_cast<double>(schedule.cycle_ns) * 1e-6;
  const double behind = std::fmod(moved[11] - moved[0] + 2 * cycle_ms, cycle_ms);
  EXPECT_NEAR(behind, expected_ms, 1.01) << "within a tick";
}

TEST(Robot, ACommandActsAtTheTickAfterTheFrameAndOneTickMore) {
  Bench bench(chain(1)), idle(chain(1));
  ASSERT_TRUE(bench.robot.command(0, 0.5, std::nullopt));
  // t = 0: the frame takes 50 µs; tick 1 copies it, tick 2 drives the motor.
  for (Bench* b : {&bench, &idle}) b->run(2);
  EXPECT_EQ(bench.robot.read(0).motor_speed_rad_per_s[0], idle.robot.read(0).motor_speed_rad_per_s[0]);
  for (Bench* b : {&bench, &idle}) b->step();
  EXPECT_GT(bench.robot.read(0).motor_speed_rad_per_s[0], idle.robot.read(0).motor_speed_rad_per_s[0] + 0.5);
}

TEST(Robot, TheMasterReadsWhatTheUnitsEncodersSay) {
  Bench bench(chain(2));
  bench.run(50);
  const auto r = bench.robot.read(1);
  EXPECT_NEAR(r.measured[0].value * vsa::kPi / 16384, r.motor_rad[0], 2e-3);
  EXPECT_NEAR(r.measured[1].value * vsa::kPi / 16384, r.motor_rad[1], 2e-3);
}

TEST(Robot, RefusesWhatIsNotANumber) {
  Bench bench(chain(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(bench.robot.command(0, nan, std::nullopt));
  EXPECT_FALSE(bench.robot.command(0, 0.1, std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(bench.robot.command(7, 0.1, std::nullopt));
  EXPECT_FALSE(bench.robot.follow(0, Robot::Channel::equilibrium, {}));
  EXPECT_FALSE(bench.robot.follow(0, Robot::Channel::equilibrium, {{1.0, 0.1}, {1.0, 0.2}}));
  EXPECT_FALSE(bench.robot.follow(0, Robot::Channel::equilibrium, {{0.0, nan}}));
  EXPECT_FALSE(bench.robot.follow({{0, Robot::Channel::equilibrium, {{0.0, 0.1}}}, {0, Robot::Channel::preset, {{0.0, nan}}}}));
  EXPECT_FALSE(bench.robot.follow({{0, Robot::Channel::equilibrium, {{0.0, 0.1}}}, {7, Robot::Channel::preset, {{0.0, 0.1}}}}));
  bench.step();
  EXPECT_EQ(bench.robot.read(0).equilibrium_command_rad, 0.0);
}

TEST(Robot, SeveralCommandsActTogetherOrNotAtAll) {
  Bench bench(chain(2));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Robot::Command> good{{0, 0.1, 0.2}, {1, 0.3, std::nullopt}}, bad{{0, 0.7, 0.7}, {1, nan, 0.7}};
  EXPECT_TRUE(bench.robot.command(good));
  EXPECT_FALSE(bench.robot.command(bad));
  bench.step();
  EXPECT_EQ(bench.robot.read(0).equilibrium_command_rad, 0.1);
  EXPECT_EQ(bench.robot.read(0).preset_command, 0.2);
  EXPECT_EQ(bench.robot.read(1).equilibrium_command_rad, 0.3);
}

TEST(Robot, OutOfRangeCommandsAreClampedAndReportedOnce) {
  Bench bench(chain(1));
  for (int n = 0; n < 5; ++n) {
    bench.robot.command(0, std::nullopt, 1.5);
    bench.step();
  }
  const auto notices = bench.robot.take_notices();
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_NE(notices[0].text.find("a1"), std::string::npos);
  EXPECT_EQ(notices[0].actuator, 0u);
  bench.run(500);
  EXPECT_LT(bench.robot.read(0).preset, 0.8);
  EXPECT_TRUE(bench.robot.take_notices().empty());
}

TEST(Robot, ATrajectoryIsLinearInSimulatedTime) {
  Bench bench(chain(1));
  ASSERT_TRUE(bench.robot.follow(0, Robot::Channel::equilibrium, {{0.1, 0.2}, {0.3, 0.6}}));
  bench.run(50);
  EXPECT_NEAR(bench.robot.read(0).equilibrium_command_rad, 0.1, 1e-12);
  bench.run(150);
  EXPECT_NEAR(bench.robot.read(0).equilibrium_command_rad, 0.4, 1e-12);
  bench.run(200);
  EXPECT_NEAR(bench.robot.read(0).equilibrium_command_rad, 0.6, 1e-12);
}

TEST(Robot, TheLastCommandBeforeTheFirstStepHolds) {
  Bench bench(chain(1));
  bench.robot.command(0, 1.0, std::nullopt);
  bench.robot.command(0, -0.5, std::nullopt);
  bench.run(2000);
  EXPECT_NEAR(bench.robot.read(0).shaft_rad, -0.5, 0.1);
}

TEST(Robot, SnapshotContinuesBitForBitAndResetReturnsToTheFirstSample) {
  Bench bench(chain(3));
  auto history = [&](int steps) {
    std::vector<double> h;
    for (int n = 0; n < steps; ++n) {
      if (n == 20) bench.robot.command(1, 0.7, 0.5);
      bench.step();
      h.insert(h.end(), bench.out.begin(), bench.out.end());
    }
    return h;
  };
  const auto first = history(300);
  const auto snapshot = bench.robot.snapshot();
  const auto in = bench.in;
  const auto t = bench.t_ns;
  const auto a = history(300);
  bench.robot.restore(*snapshot);
  bench.in = in;
  bench.t_ns = t;
  EXPECT_EQ(history(300), a);
  bench.robot.reset();
  bench.in.assign(3, JointIn{0, 0, 1e3});
  bench.t_ns = 0;
  EXPECT_EQ(history(300), first);
}

TEST(Robot, AdvanceAllocatesNothing) {
  Bench bench(chain(12));
  bench.run(20);
  const long before = allocation_count();
  bench.run(1000);
  EXPECT_EQ(allocation_count(), before);
}

TEST(Robot, TakesCommandsFromManyThreadsWhileItSteps) {
  Bench bench(chain(4));
  std::atomic<bool> stop{false};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (int n = 0; n < 2000 && !stop; ++n) bench.robot.command(i, 0.001 * n, 0.2);
      bench.robot.command(i, 0.3, 0.2);
    });
  }
  bench.run(300);
  stop = true;
  for (std::thread& t : threads) t.join();
  bench.run(1500);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(bench.robot.read(i).equilibrium_command_rad, 0.3);
}

TEST(Robot, NoStepFallsBetweenThePathsOfOneCall) {
  constexpr std::size_t kUnits = 4;
  Bench bench(chain(kUnits));
  const auto send = [&bench](double value) {
    std::vector<Robot::Path> paths;
    for (std::size_t i = 0; i < kUnits; ++i) {
      paths.push_back({i, Robot::Channel::equilibrium, {{0.0, value}}});
      paths.push_back({i, Robot::Channel::preset, {{0.0, value}}});
    }
    bench.robot.follow(std::move(paths));
  };
  send(0.1);
  std::atomic<bool> stop{false};
  std::thread sender([&] {
    for (int n = 0; !stop; ++n) send(0.001 * (n % 400));
  });
  int torn = 0;
  for (int k = 0; k < 2000; ++k) {
    bench.step();
    const double first = bench.robot.read(0).equilibrium_command_rad;
    for (std::size_t i = 0; i < kUnits; ++i) {
      const auto now = bench.robot.read(i);
      torn += now.equilibrium_command_rad != first || now.preset_command != first ? 1 : 0;
    }
  }
  stop = true;
  sender.join();
  EXPECT_EQ(torn, 0);
}

TEST(Robot, LedgerOfAWholeRobotBalances) {
  Bench bench(chain(12));
  for (int n = 0; n < 3000; ++n) {
    if (n % 12 == 0)
      for (std::size_t i = 0; i < 12; ++i) bench.robot.command(i, std::sin(0.005 * n + 0.6 * static_cast<double>(i)), 0.3);
    bench.step();
  }
  const auto l = bench.robot.ledger();
  EXPECT_GT(l.moved(), 1.0);
  EXPECT_LT(std::abs(l.imbalance()), 1e-11 * l.moved());
  vsa::test::expect_small_closures(l, 0.01);
}

TEST(Robot, SaysWhatTheWholeGetsWrong) {
  RobotConfig config = chain(3);
  config.actuators[1].id = 1;
  config.actuators[2].joint = "a1";
  try {
    const Robot robot(config);
    FAIL() << "accepted duplicate ids and joints";
  } catch (const vsa::InputError& e) {
    EXPECT_EQ(e.problems().size(), 2u);
  }
}

TEST(Robot, UnitsThatAreAlikeHaveOneLawWhoeverMadeThem) {
  RobotConfig config = chain(4);
  const auto with = [](double stiffness_Nm_per_rad) {
    vsa::device::UnitConfig unit = vsa::test::maker_pro();
    unit.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(stiffness_Nm_per_rad);
    return unit;
  };
  for (ActuatorConfig& a : config.actuators) a.unit = with(2.0);
  config.actuators[2].unit = with(3.0);
  config.actuators[3].unit.actuator.supply_V += 1;
  Robot robot(config);
  const auto law = [&robot](std::size_t i) { return robot.config().actuators[i].unit.actuator.transmission.get(); };
  EXPECT_EQ(law(0), law(1));
  EXPECT_NE(law(0), law(2)) << "another spring";
  EXPECT_NE(law(0), law(3)) << "another unit";
  robot.set_parameters(2, with(2.0));
  EXPECT_EQ(law(0), law(2));
  robot.set_parameters(1, with(3.0));
  EXPECT_NE(law(0), law(1));
}

TEST(Robot, StepsOfAnyLengthSeeTheSameTicks) {
  // 0.4 ms doesn't divide the tick: the step is cut there. The same motion within the coupling's order.
  Bench fine(chain(1), 400'000), coarse(chain(1), 1'000'000), odd(chain(1), 4'000'000);
  for (Bench* b : {&fine, &coarse, &odd}) {
    b->robot.command(0, 0.5, std::nullopt);
    while (b->t_ns < 800'000'000) b->step();
  }
  EXPECT_NEAR(fine.robot.read(0).shaft_rad, coarse.robot.read(0).shaft_rad, 0.01);
  EXPECT_NEAR(odd.robot.read(0).shaft_rad, coarse.robot.read(0).shaft_rad, 0.02);
}

}  // namespace
