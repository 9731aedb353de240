// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the unit's program is given to read: each motor's own current, and the shaft where it is at each tick.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/one_joint.hpp"

namespace {

using vsa::Ticks;
using vsa::test::maker_pro;
using vsa::test::OneJoint;

TEST(Sensing, TheProgramReadsEachMotorsOwnCurrent) {
  // One motor is sent where its spring doesn't let it go and stalls; the other leans against its gear's friction at its reference.
  for (const int stalled : {0, 1}) {
    OneJoint joint(maker_pro(), 0.0, 0.0, 0.0, 1'000'000);
    joint.unit.set_inputs(joint.state, {Ticks{static_cast<std::int16_t>(stalled == 0 ? 16000 : 0)},
                                        Ticks{static_cast<std::int16_t>(stalled == 1 ? 16000 : 0)}});
    for (int n = 0; n < 4000; ++n) joint.step();
    const auto& s = joint.state;
    for (const int i : {0, 1}) {
      const double truth_A = joint.unit.physics().motor_current(s.actuator, i, s.held.voltage[i], s.held.terminal[i]);
      EXPECT_NEAR(s.program.loop.current[i].value, 1000 * truth_A, 0.01 * std::abs(1000 * truth_A) + 5)
          << stalled << ", motor " << i;
    }
    EXPECT_GT(s.program.loop.current[stalled].value, 1000);
    EXPECT_LT(std::abs(s.program.loop.current[1 - stalled].value), 500);
  }
}

TEST(Sensing, ADutyIsLimitedByTheSupplyThatTheTickBeforeRead) {
  OneJoint joint(maker_pro(), 0.0, 0.0, 0.0, 1'000'000);
  const auto supply = [&](double volts) {
    vsa::device::Faults faults;
    faults.supply_V = volts;
    vsa::device::Unit::set_faults(joint.state, faults);
  };
  const auto full_V = [](double volts, int read_mV) { return vsa::firmware::supply_limit_pct({read_mV}) / 101.0 * volts; };
  supply(9.0);
  joint.unit.set_inputs(joint.state, {Ticks{16000}, Ticks{-16000}});
  for (int n = 0; n < 50; ++n) joint.step();
  EXPECT_NEAR(joint.state.held.voltage[0], full_V(9, 9000), 1e-12);
  supply(20.0);
  joint.step();
  EXPECT_NEAR(joint.state.held.voltage[0], full_V(20, 9000), 1e-12) << "for one tick more than the program means to give";
  joint.step();
  EXPECT_NEAR(joint.state.held.voltage[0], full_V(20, 20000), 1e-12);
  EXPECT_NEAR(joint.state.held.voltage[1], -full_V(20, 20000), 1e-12);
}

/// The shaft's encoder at every tick while a host turns it evenly.
std::vector<std::int32_t> shaft_samples(std::int64_t dt_ns, double speed) {
  vsa::device::Unit unit(maker_pro());
  vsa::device::UnitState s = unit.initial(0, 0.2, 0);
  vsa::device::StepPlan plan;
  vsa::firmware::Output unheard;
  std::vector<std::int32_t> out;
  for (std::int64_t t = 0; t < 160'000'000; t += dt_ns) {
    unit.begin_step(s, plan, t, dt_ns, {speed * static_cast<double>(t) * 1e-9, speed, 0.0});
    for (std::int64_t at = unit.first_tick_ns(t); at < t + dt_ns; at += vsa::firmware::kTickNs) {
      const vsa::firmware::TickInputs in = unit.sample(s, plan, at);
      out.push_back(in.encoder[2]);
      unheard.clear();
      unit.program().tick(s.program, in, at, unheard);
      unit.hold(s, plan);
    }
    static_cast<void>(unit.end_step(s, plan));
  }
  return out;
}

TEST(Sensing, TicksInsideALongStepSeeTheShaftWhereItIsThen) {
  // 3.1 rad/s: two counts of 12 bits a tick, so an encoder that waits for the step's end is told at once.
  const double speed = 3.1;
  const auto each_tick = shaft_samples(1'000'000, speed);
  ASSERT_EQ(each_tick.size(), 160u);
  EXPECT_GT(each_tick.back(), 4900) << "0.159 s · 3.1 rad/s, 65536 per turn";
  for (const std::int64_t dt_ns : {2'000'000, 4'000'000, 8'000'000, 16'000'000})
    EXPECT_EQ(shaft_samples(dt_ns, speed), each_tick) << dt_ns;
}

}  // namespace
