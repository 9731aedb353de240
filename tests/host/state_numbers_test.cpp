// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot as numbers: in whatever situation, another robot of the same kind goes on from them as the first one does.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "host/free_flanges.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/errors.hpp"
#include "vsa/state_io.hpp"

long allocation_count();  // allocation_count.cpp

namespace {

using vsa::InputError;
using vsa::host::Robot;
using vsa::host::RobotConfig;
using Bench = vsa::test::Flanges;
using Numbers = std::vector<double>;

Numbers numbers_of(const Robot& robot) {
  Numbers out(robot.state_size());
  robot.save(out);
  return out;
}

/// Without the room that nothing takes.
Numbers tight_of(const Robot& robot) {
  vsa::state::Rewriter out(0, robot.state_size());
  robot.save_tight(out);
  return {out.numbers().begin(), out.numbers().end()};
}

RobotConfig some_robot(std::mt19937& random) {
  RobotConfig config = vsa::test::chain(1 + random() % 4);
  config.buses.push_back({"second", 460800, random() % 2 == 0 ? std::optional(0.013) : std::nullopt});
  for (auto& a : config.actuators) {
    a.bus = random() % 3 == 0 ? 1 : 0;
    if (random() % 3 == 0) a.unit.program.model = vsa::firmware::Model::advanced;
    a.unit.memory = vsa::firmware::initial_memory(a.unit.program.model);
    if (random() % 4 == 0) a.unit.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(2.0);
    if (random() % 4 == 0)
      for (auto& side : a.unit.actuator.side) side.motor.inductance_H = 1e-3;
    if (random() % 4 == 0 && a.unit.actuator.transmission->spring_count() > 0) a.unit.actuator.tendon = {0.1, 1e-3, 0.0};
  }
  return config;
}

std::vector<Robot::Knot> some_path(std::mt19937& random) {
  std::vector<Robot::Knot> knots;
  for (std::size_t k = 0; k < 1 + random() % Robot::kMostKnots; ++k)
    knots.push_back({0.004 * static_cast<double>(k + 1), 1e-3 * static_cast<double>(random() % 800)});
  return knots;
}

/// Things that happen to both alike: `events` repeats.
void happen(Bench& bench, unsigned seed) {
  std::mt19937 random(seed);
  const std::size_t i = random() % bench.robot.size();
  switch (random() % 5) {
    case 0:
      bench.robot.command(i, 0.6, 0.3);
      break;
    case 1:
      bench.robot.follow(i, Robot::Channel::equilibrium, some_path(random));
      break;
    case 2: {
      vsa::device::Faults f;
      f.seed = random();
      f.lost_byte = random() % 2 == 0 ? 0.1 : 0;
      f.late_s = random() % 2 == 0 ? 0.0007 : 0;
      f.encoder[0].noise_rad = 0.01;
      f.powered = random() % 3 != 0;
      bench.robot.set_faults(i, f);
      break;
    }
    case 3:
      bench.robot.set_supply(random() % 2 == 0);
      break;
    default:
      bench.robot.follow(i, Robot::Channel::preset, some_path(random));
  }
}

TEST(RobotAsNumbers, GoesOnBitForBitInAnyOfManySituations) {
  std::mt19937 random(3);
  int busy = 0;
  for (unsigned n = 0; n < 60; ++n) {
    const RobotConfig config = some_robot(random);
    const std::int64_t dt_ns = std::array{300'000, 700'000, 1'300'000, 2'500'000}[random() % 4];
    Bench one(config, dt_ns), other(config, dt_ns);
    for (unsigned k = 0; k < 4; ++k) {
      happen(one, 17 * n + k);
      one.run(static_cast<int>(1 + random() % 60));
    }
    other.run(3);
    const Numbers at = numbers_of(one.robot), tight = tight_of(one.robot);
    EXPECT_LT(tight.size(), at.size()) << n;
    busy += at[one.robot.state_layout().find("bus spine/chain.speech.count")->offset] > 0 ? 1 : 0;
    if (n % 2 == 0) {
      ASSERT_NO_THROW(other.robot.restore(at)) << n;
    } else {
      ASSERT_EQ(other.robot.restore_tight(tight), tight.size()) << n;
    }
    EXPECT_EQ(vsa::first_difference(numbers_of(other.robot), at), std::nullopt) << n;
    other.in = one.in, other.t_ns = one.t_ns;
    for (Bench* bench : {&one, &other}) happen(*bench, n);
    for (int k = 0; k < 100; ++k) {
      one.step();
      other.step();
      ASSERT_EQ(vsa::first_difference(one.out, other.out), std::nullopt) << n << ", step " << k;
    }
    EXPECT_EQ(one.robot.state_hash(), other.robot.state_hash()) << n;
  }
  EXPECT_GT(busy, 2) << "bytes on the line";
}

TEST(RobotAsNumbers, IsTheSameAsASnapshot) {
  Bench bench(vsa::test::chain(3));
  happen(bench, 1);
  bench.run(55);
  const auto snapshot = bench.robot.snapshot();
  const Numbers at = numbers_of(bench.robot);
  bench.run(40);
  bench.robot.restore(*snapshot);
  EXPECT_EQ(vsa::first_difference(numbers_of(bench.robot), at), std::nullopt);
  EXPECT_EQ(vsa::first_difference(numbers_of(bench.robot.clone()), at), std::nullopt);
  bench.robot.reset();
  EXPECT_EQ(vsa::first_difference(numbers_of(bench.robot), numbers_of(Robot(vsa::test::chain(3)))), std::nullopt);
}

TEST(RobotAsNumbers, NamesEachNumber) {
  const Robot robot(vsa::test::chain(2));
  const vsa::StateLayout layout = robot.state_layout();
  EXPECT_EQ(layout.size(), robot.state_size());
  const vsa::StateEntry* angle = layout.find("a2/unit.physics.motor[1].angle");
  ASSERT_NE(angle, nullptr);
  EXPECT_EQ(angle->unit, "rad");
  EXPECT_EQ(numbers_of(robot)[angle->offset], robot.read(1).motor_rad[1]);
  ASSERT_NE(layout.find("bus spine/master.cycle_start"), nullptr);
  EXPECT_EQ(layout.find("a1/equilibrium.knot[63].time")->unit, "s");
  EXPECT_EQ(layout.hash(), Robot(vsa::test::chain(2)).state_layout().hash());
  EXPECT_NE(layout.hash(), Robot(vsa::test::chain(3)).state_layout().hash());
}

TEST(RobotAsNumbers, ALongTrajectoryRunsAsEverAndCantBeSavedBeforeItsEnd) {
  std::vector<Robot::Knot> path;
  for (std::size_t k = 0; k <= Robot::kMostKnots; ++k)
    path.push_back({0.001 * static_cast<double>(k), 1e-3 * static_cast<double>(k)});
  Bench bench(vsa::test::chain(2));
  ASSERT_TRUE(bench.robot.follow(1, Robot::Channel::equilibrium, path));
  bench.run(30);
  EXPECT_NEAR(bench.robot.read(1).equilibrium_command_rad, 0.030, 1e-12);
  Numbers out(bench.robot.state_size());
  try {
    bench.robot.save(out);
    FAIL() << "65 knots have no room";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("a2/equilibrium.knot.count = 65"), std::string::npos) << text;
    EXPECT_NE(text.find("0 … 64"), std::string::npos) << text;
  }
  const auto snapshot = bench.robot.snapshot();
  bench.run(256);
  EXPECT_NO_THROW(bench.robot.save(out)) << "it has ended and is a constant";
  EXPECT_EQ(bench.robot.read(1).equilibrium_command_rad, path.back().value);
  bench.robot.restore(*snapshot);
  EXPECT_NEAR(bench.robot.read(1).equilibrium_command_rad, 0.030, 1e-12);
}

TEST(RobotAsNumbers, WaitingCommandsAreDroppedAsByASnapshot) {
  Bench bench(vsa::test::chain(1));
  bench.run(10);
  const Numbers at = numbers_of(bench.robot);
  bench.robot.command(0, 1.0, 0.1);
  bench.robot.restore(at);
  bench.step();
  EXPECT_EQ(bench.robot.read(0).equilibrium_command_rad, 0.0);
}

TEST(RobotAsNumbers, SavingAndRestoringTakeNothingFromTheHeap) {
  Bench bench(vsa::test::chain(3)), other(vsa::test::chain(3));
  std::mt19937 random(4);
  bench.robot.follow(0, Robot::Channel::equilibrium, some_path(random));
  vsa::device::Faults f;
  f.lost_byte = 0.2;
  bench.robot.set_faults(1, f);
  bench.run(20);
  Numbers out(bench.robot.state_size());
  const long before = allocation_count();
  for (int n = 0; n < 50; ++n) {
    bench.robot.save(out);
    other.robot.restore(out);
    other.robot.check(out);
    bench.step();
  }
  EXPECT_EQ(allocation_count(), before);
}

TEST(RobotAsNumbers, OfAUnitOnASerialPortComeBackInTheMiddleOfAStore) {
  RobotConfig config = vsa::test::chain(1);
  config.buses[0].serial_port = "nobody";
  Bench one(config), other(config);
  std::vector<std::uint8_t> answer;
  const auto say = [&](const auto& request) {
    one.robot.serial_line(0)->exchange(vsa::bus::encode_request({}, 1, vsa::bus::Request{request}).view(), answer);
  };
  one.run(3);
  say(vsa::bus::Calibrate{});
  one.run(150);
  say(vsa::bus::StoreParameters{});
  one.run(2);
  say(vsa::bus::GetParameterList{});
  one.step();
  const Numbers at = numbers_of(one.robot);
  other.robot.restore(at);
  EXPECT_EQ(vsa::first_difference(numbers_of(other.robot), at), std::nullopt);
  other.in = one.in, other.t_ns = one.t_ns;
  other.run(20);
}

/// After which the robot must at least go on without breaking a promise.
void step_a_little(const RobotConfig& config, const Numbers& numbers, int& taken, bool tight = false) {
  Bench bench(config);
  const Numbers before = numbers_of(bench.robot);
  std::size_t count = numbers.size();
  try {
    if (tight) {
      count = bench.robot.restore_tight(numbers);
    } else {
      bench.robot.restore(numbers);
    }
  } catch (const InputError&) {
    EXPECT_EQ(vsa::first_difference(numbers_of(bench.robot), before), std::nullopt) << "nothing has changed";
    return;
  }
  ++taken;
  EXPECT_EQ(vsa::first_difference(tight ? tight_of(bench.robot) : numbers_of(bench.robot), std::span(numbers).first(count)),
            std::nullopt)
      << "what is taken is given back";
  bench.t_ns = 20'000'000;
  bench.run(5);
}

TEST(RobotAsNumbers, AnyWrongNumberIsRefusedOrDoesNoHarm) {
  const RobotConfig config = vsa::test::chain(1);
  Bench bench(config);
  happen(bench, 2);
  bench.run(20);
  const Numbers all = numbers_of(bench.robot), few = tight_of(bench.robot);
  const double huge = 1e300, infinite = std::numeric_limits<double>::infinity();
  int taken = 0, tried = 0;
  std::mt19937 random(5);
  const std::vector<double> strange{0,    -0.0,  1,        -1,          0.5, 7, 255, 65535, -2147483648.0, 2147483647.0,
                                    huge, -huge, infinite, std::nan("")};
  for (const Numbers* good : {&all, &few}) {
    for (std::size_t i = 0; i < good->size(); ++i) {
      for (std::size_t k = i % 3; k < strange.size(); k += 3) {
        Numbers bad = *good;
        bad[i] = strange[k];
        ++tried;
        SCOPED_TRACE(testing::Message() << "number " << i << " = " << bad[i] << " instead of " << (*good)[i]);
        step_a_little(config, bad, taken, good == &few);
      }
    }
  }
  EXPECT_GT(taken, tried / 20);
  EXPECT_LT(taken, tried * 19 / 20);
}

TEST(RobotAsNumbers, WithoutRoomAreRefusedWhereTheyEndTooEarly) {
  Bench bench(vsa::test::chain(2));
  happen(bench, 1);
  bench.run(30);
  const Numbers good = tight_of(bench.robot);
  const Numbers before = numbers_of(bench.robot);
  for (std::size_t n = 0; n < good.size(); ++n) {
    EXPECT_THROW(bench.robot.restore_tight(std::span(good).first(n)), InputError) << n;
    ASSERT_EQ(vsa::first_difference(numbers_of(bench.robot), before), std::nullopt) << n;
  }
  EXPECT_EQ(bench.robot.restore_tight(good), good.size());
}

TEST(RobotAsNumbers, RandomNumbersAreRefused) {
  const RobotConfig config = vsa::test::chain(2);
  std::mt19937_64 random(6);
  Bench bench(config);
  Numbers noise(bench.robot.state_size());
  int taken = 0;
  for (int n = 0; n < 200; ++n) {
    for (double& v : noise) {
      const std::uint64_t bits = random();
      v = n % 2 == 0 ? std::bit_cast<double>(bits) : static_cast<double>(bits % 5);
    }
    step_a_little(config, noise, taken);
    step_a_little(config, noise, taken, true);
  }
  EXPECT_EQ(taken, 0);
  EXPECT_THROW(bench.robot.restore(std::span<const double>(noise).first(noise.size() - 1)), InputError);
}

}  // namespace
