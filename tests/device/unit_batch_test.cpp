// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Units side by side in lanes, beside each alone: the same bits, for every instruction set that this machine has.
#include "vsa/device/unit_batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "support/one_joint.hpp"
#include "vsa/device/lever_batch.hpp"
#include "vsa/errors.hpp"

namespace vsa::test {
namespace {

using device::Unit;
using device::UnitBatch;
using device::UnitConfig;
using device::UnitState;

std::vector<double> numbers(const UnitState& s) {
  std::vector<double> out(Unit::state_size());
  Unit::save(s, out);
  return out;
}

/// A lever on each shaft, every one another: inertia, weight, a push.
struct Levers {
  explicit Levers(std::size_t n, unsigned seed) : rng(seed), angle(n), speed(n), inverse_inertia(n), weight(n), torque(n) {
    for (std::size_t i = 0; i < n; ++i) {
      angle[i] = draw(-0.4, 0.4);
      speed[i] = draw(-2, 2);
      inverse_inertia[i] = i % 11 == 10 ? 0.0 : std::pow(10.0, draw(0, 4.3));  // a heavy arm … a bare finger; some are led
      weight[i] = draw(-0.8, 0.8);
    }
  }
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(rng); }
  void move(double dt) {
    for (std::size_t i = 0; i < angle.size(); ++i) {
      const double push = torque[i] - weight[i] * std::sin(angle[i]) - 0.01 * speed[i];
      if (inverse_inertia[i] > 0) speed[i] += dt * inverse_inertia[i] * push;
      angle[i] += dt * speed[i];
      if (std::abs(angle[i]) > 3) speed[i] = -speed[i];
    }
  }
  std::mt19937 rng;
  std::vector<double> angle, speed, inverse_inertia, weight, torque;
};

struct Case {
  std::size_t units;
  std::int64_t dt_ns;
  unsigned seed;
};

void compare(const UnitConfig& config, const Case& c, std::string_view instructions) {
  UnitBatch batch(config, c.units, instructions);
  Unit alone(config);
  std::vector<UnitState> states(c.units, alone.initial(0, 0, 0));
  Levers levers(c.units, c.seed);
  std::vector<double> torque(c.units);
  std::int64_t now = 0;
  for (int step = 0; step < 700; ++step) {
    if (step % 23 == 0)
      for (std::size_t i = step % 2; i < c.units; i += 2) {
        const double q = levers.draw(-1, 1), p = levers.draw(0, config.preset_max);
        batch.command(i, q, p);
        alone.set_inputs(states[i], alone.inputs_for(q, p));
      }
    for (std::size_t i = 0; i < c.units; ++i)
      torque[i] = alone.step(states[i], now, c.dt_ns, {levers.angle[i], levers.speed[i], levers.inverse_inertia[i]});
    batch.step(c.dt_ns, levers.angle, levers.speed, levers.inverse_inertia, levers.torque);
    ASSERT_EQ(levers.torque, torque) << instructions << ", step " << step;
    now += c.dt_ns;
    if (step == 300) {  // somebody is thrown about, and a motor loses its plug for a while
      states[0].faults.motor_unplugged[1] = true;
      UnitState s = batch.state(0);
      s.faults.motor_unplugged[1] = true;
      batch.set(0, s);
      levers.speed[c.units - 1] += 40;
    }
    if (step == 400) {
      UnitState s = batch.state(0);
      s.faults.motor_unplugged[1] = states[0].faults.motor_unplugged[1] = false;
      batch.set(0, s);
    }
    // A blow that Newton needs many rounds for, in one lane of many.
    if (step % 29 == 28) levers.speed[static_cast<std::size_t>(step) % c.units] += levers.draw(-150, 150);
    levers.move(1e-9 * static_cast<double>(c.dt_ns));
  }
  for (std::size_t i = 0; i < c.units; ++i)
    ASSERT_EQ(numbers(batch.state(i)), numbers(states[i])) << instructions << ", unit " << i;
}

TEST(UnitBatch, EachUnitGoesBitForBitAsItWouldAlone) {
  for (const std::string_view set : UnitBatch::instruction_sets())
    for (const Case& c : {Case{1, 1'000'000, 1}, Case{8, 1'000'000, 2}, Case{13, 500'000, 3}, Case{21, 250'000, 4},
                          Case{5, 2'000'000, 5}, Case{11, 700'000, 6}})
      compare(maker_pro(), c, set);
}

TEST(UnitBatch, SoDoUnitsWithOtherFrictionsAndLaws) {
  std::vector<UnitConfig> configs(5, maker_pro());
  configs[0].actuator.tendon = {0.06, 2e-3, 3e-3};
  configs[1].actuator.tendon = {0.06, 2e-3, 0};
  for (auto& side : configs[1].actuator.side) side.gearbox.load_loss = 0.2;
  for (auto& side : configs[1].actuator.side) side.gearbox.back_loss = 0.1;
  for (auto& side : configs[2].actuator.side) side.gearbox.friction = {0, 0};
  configs[2].actuator.shaft_friction = {0, 0};
  for (auto& side : configs[3].actuator.side) side.gearbox.friction.presliding_rad = 0;  // no lanes
  for (auto& side : configs[4].actuator.side) side.motor.inductance_H = 1e-3;            // no lanes
  for (std::size_t i = 0; i < configs.size(); ++i) {
    EXPECT_EQ(UnitBatch(configs[i], 1).width() > 1, i < 3) << i;
    for (const std::string_view set : UnitBatch::instruction_sets()) compare(configs[i], {9, 1'000'000, 7}, set);
  }
}

TEST(UnitBatch, SoDoUnitsWithTwoUnlikeSides) {
  UnitConfig config = maker_pro();
  config.actuator.tendon = {0.06, 2e-3, 3e-3};
  actuator::SideParams& second = config.actuator.side[1];
  second.motor = {0.003, 0.02, 0.6, 0.9, 3.1, std::nullopt};
  second.gearbox = {1.5, {0.2, 0.01}, 0.1, 0.3};
  second.bridge.dead_band = 0.1;
  second.bridge.switch_Ohm = 0.4;
  second.encoder = {14, 0.2};
  config.actuator.shaft_encoder = {10, -0.1};
  EXPECT_GT(UnitBatch(config, 1).width(), 1U);
  for (const std::string_view set : UnitBatch::instruction_sets()) compare(config, {9, 1'000'000, 8}, set);
  second.motor.inductance_H = 1e-3;
  EXPECT_EQ(UnitBatch(config, 1).width(), 1U) << "one side without lanes is enough";
}

TEST(UnitBatch, RefusesWhatIsNoStepAndThenNothingHasMoved) {
  UnitBatch batch(maker_pro(), 3);
  const auto before = numbers(batch.state(2));
  std::vector<double> three(3, 0.0), two(2, 0.0), torque(3), bad{0, std::numeric_limits<double>::quiet_NaN(), 0},
      negative{0, 0, -1};
  EXPECT_THROW(batch.step(0, three, three, three, torque), InputError);
  EXPECT_THROW(batch.step(16'000'001, three, three, three, torque), InputError);
  EXPECT_THROW(batch.step(1'000'000, two, three, three, torque), InputError);
  EXPECT_THROW(batch.step(1'000'000, three, three, three, two), InputError);
  EXPECT_THROW(batch.step(1'000'000, bad, three, three, torque), InputError);
  EXPECT_THROW(batch.step(1'000'000, three, three, negative, torque), InputError);
  EXPECT_THROW(batch.command(3, 0, 0), InputError);
  EXPECT_THROW(batch.command(0, std::numeric_limits<double>::infinity(), 0), InputError);
  EXPECT_THROW((void)batch.state(3), InputError);
  EXPECT_THROW(UnitBatch(maker_pro(), 0), InputError);
  EXPECT_THROW(UnitBatch(maker_pro(), 1, "abacus"), InputError);
  EXPECT_EQ(batch.time_ns(), 0);
  EXPECT_EQ(numbers(batch.state(2)), before);
}

TEST(LeverBatch, SwingsAsAUnitAloneUnderTheSameLever) {
  const device::Lever lever{2e-3, 0.01, 0.3};
  device::LeverBatch levers(maker_pro(), 11, lever);
  for (std::size_t i = 0; i < 11; ++i) {
    levers.equilibrium()[i] = 0.1 * static_cast<double>(i);
    levers.preset()[i] = 0.4;
  }
  levers.push()[3] = 0.5;
  levers.step(200);
  levers.equilibrium()[3] = levers.preset()[3] = std::nan("");
  levers.reset(3, -0.2, 0.1, 0.05, 1.0);  // in the middle of the run, the others go on
  levers.step(300);
  Unit unit(maker_pro());
  const auto follow = [&](UnitState s, double q, double v, double push, int steps) {
    for (int n = 0; n < steps; ++n) {
      const double torque = unit.step(s, n * 1'000'000, 1'000'000, {q, v, 1 / lever.inertia_kgm2});
      v = (v + 1e-3 / lever.inertia_kgm2 * (torque - 0.3 * std::sin(q) + push)) / (1 + 1e-3 / lever.inertia_kgm2 * 0.01);
      q += 1e-3 * v;
    }
    return std::pair{q, v};
  };
  UnitState five = unit.initial(0, 0, 0);
  unit.set_inputs(five, unit.inputs_for(0.5, 0.4));
  const auto alone = follow(five, 0, 0, 0, 500);
  EXPECT_NEAR(levers.shaft_rad()[5], alone.first, 1e-12);
  EXPECT_NEAR(levers.shaft_speed_rad_per_s()[5], alone.second, 1e-10);
  const auto again = follow(unit.initial(-0.2, 0.1, 0.05), 0.05, 1.0, 0.5, 300);
  EXPECT_NEAR(levers.shaft_rad()[3], again.first, 1e-12) << "and whoever was reset begins anew, pushed as before";
}

TEST(LeverBatch, ARestoredUnitGoesOnAsItDid) {
  device::LeverBatch levers(maker_pro(), 9, {2e-3, 0.01, 0.3});
  for (std::size_t i = 0; i < 9; ++i) levers.equilibrium()[i] = 0.1 * static_cast<double>(i) - 0.4;
  levers.step(60);
  const UnitState before = levers.state(7);
  const std::int64_t at = levers.units().time_ns();
  EXPECT_EQ(before.reached.angle, levers.shaft_rad()[7]);
  EXPECT_GT(std::abs(before.reached.speed), 0.1) << "in full swing";
  levers.step(40);
  const double angle = levers.shaft_rad()[7], speed = levers.shaft_speed_rad_per_s()[7], other = levers.shaft_rad()[3];
  levers.restore(7, before, at);
  EXPECT_EQ(levers.shaft_rad()[7], before.reached.angle);
  EXPECT_EQ(levers.shaft_rad()[3], other);
  levers.step(40);
  EXPECT_EQ(levers.shaft_rad()[7], angle);
  EXPECT_EQ(levers.shaft_speed_rad_per_s()[7], speed);
}

TEST(LeverBatch, RefusesStatesThatAreNone) {
  device::LeverBatch levers(maker_pro(), 2, {});
  UnitState state = levers.state(1);
  EXPECT_THROW(levers.restore(2, state, 0), InputError);
  EXPECT_THROW((void)levers.state(2), InputError);
  EXPECT_THROW(levers.restore(1, state, std::numeric_limits<std::int64_t>::min()), InputError);
  state.reached.speed = std::nan("");
  EXPECT_THROW(levers.restore(1, state, 0), InputError);
  state = levers.state(1);
  state.program.busy_until_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_THROW(levers.restore(1, state, 0), InputError);
}

TEST(LeverBatch, RefusesLeversAndCommandsThatAreNone) {
  EXPECT_THROW(device::LeverBatch(maker_pro(), 2, {0, 0, 0}), InputError);
  EXPECT_THROW(device::LeverBatch(maker_pro(), 2, {1e-3, -1, 0}), InputError);
  device::LeverBatch levers(maker_pro(), 2, {});
  EXPECT_THROW(levers.set_lever(2, {}), InputError);
  EXPECT_THROW(levers.step(0), InputError);
  EXPECT_THROW(levers.step(1, 17'000'000), InputError);
  levers.push()[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(levers.step(1), InputError);
  levers.push()[1] = 0;
  levers.preset()[0] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(levers.step(1), InputError);
  EXPECT_THROW(levers.reset(0, std::nan(""), 0, 0), InputError);
  EXPECT_THROW(levers.check_reset(0, 0, 0, 1e7), InputError);
  EXPECT_THROW(levers.check_reset(2, 0, 0, 0), InputError);
  EXPECT_NO_THROW(levers.check_reset(1, 0.1, 0.2, 0.3, -1));
  EXPECT_EQ(levers.shaft_rad()[1], 0) << "it only looks";
  EXPECT_EQ(levers.time_s(), 0);
}

}  // namespace
}  // namespace vsa::test
