// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "vsa/firmware/exchange.hpp"

namespace {

using namespace vsa::firmware;
namespace firmware = vsa::firmware;
using vsa::MilliVolt;
using vsa::Ticks;

constexpr int kTwelveVolts = 1638 + 787;  // 787·1952 >> 7 = 12001 mV

/// The maker pro's controller in mode 0, on for long: no derivative kick at the first tick, the supply limit there.
struct Loop {
  Memory memory = initial_memory(Model::maker_pro);
  ControllerState state = [] {
    ControllerState s;
    s.limit_pct = 100;
    return s;
  }();

  void tick(const TickInputs& in) {
    const LoopMemory m{memory, memory};
    const Controller controller;
    const bool first = state.first_tick;
    for (int i = 0; i < 3; ++i) controller.read_encoder(m, state, in, i);
    if (first) state.meas_old = state.meas;
    for (int i = 0; i < 2; ++i) controller.drive_motor(m, state, i);
    controller.read_analog(state, in);
    Controller::end_tick(state);
  }
  void set_inputs(std::array<Ticks, 2> inputs) { firmware::set_inputs(Model::maker_pro, {memory, memory}, state, inputs); }
};

TickInputs at(std::int32_t m0, std::int32_t m1 = 0) { return {{m0, m1, 0}, {1638, 1638}, kTwelveVolts}; }

TEST(PositionLoop, FullOutputAtFiveAndAHalfDegrees) {
  Loop loop;
  ControllerState& s = loop.state;
  s.ref = s.ref_new = {1001, 0};
  loop.tick(at(0));
  EXPECT_EQ(s.pwm[0], 100);
  s.ref = s.ref_new = {999, 0};
  loop.tick(at(0));
  EXPECT_EQ(s.pwm[0], 99);
}

TEST(PositionLoop, ShiftsAreFloors) {
  Loop loop;
  ControllerState& s = loop.state;
  s.ref = s.ref_new = {-1, 1};
  loop.tick(at(0));
  EXPECT_EQ(s.pwm[0], -1) << "−0.1 % floors to −1";
  EXPECT_EQ(s.pwm[1], 0);
}

TEST(PositionLoop, OneEncoderCountMovesTheDerivativeByThirteenPercent) {
  Loop loop;
  ControllerState& s = loop.state;
  loop.memory.position.p = 0;
  loop.tick(at(0));
  loop.tick(at(16));
  EXPECT_EQ(s.pwm[0], -13) << "floor of −12.8";
}

TEST(PositionLoop, ReferenceActsOneToTwoTicksAfterItArrives) {
  Loop loop;
  ControllerState& s = loop.state;
  loop.tick(at(0));
  loop.set_inputs({Ticks{2000}, Ticks{0}});
  loop.tick(at(0));
  EXPECT_EQ(s.pwm[0], 0) << "copied at the end of this tick";
  loop.tick(at(0));
  EXPECT_EQ(s.pwm[0], 100);
}

TEST(PositionLoop, LimitsClampTheReferenceAndCanBeOff) {
  Loop loop;
  ControllerState& s = loop.state;
  loop.set_inputs({Ticks{32767}, Ticks{-32768}});
  EXPECT_EQ(s.ref_new[0], 30000);
  EXPECT_EQ(s.ref_new[1], -30000);
  loop.memory.limits_on = 0;
  loop.set_inputs({Ticks{32767}, Ticks{-32768}});
  EXPECT_EQ(s.ref_new[0], 65534);
}

TEST(PositionLoop, MeasurementsAreThePreviousTicks) {
  Loop loop;
  ControllerState& s = loop.state;
  loop.tick(at(160));
  EXPECT_EQ(positions(Model::maker_pro, loop.memory, s)[0].value, 80);
}

TEST(Encoder, CountsTurnsAndBelievesAJumpAtTheTenthTick) {
  Loop loop;
  ControllerState& s = loop.state;
  loop.tick(at(32000));
  loop.tick(at(-32000));
  EXPECT_EQ(s.meas[0], -32000 + 65536);
  loop.tick(at(32000));
  EXPECT_EQ(s.meas[0], 32000);
  for (int n = 0; n < 9; ++n) {
    loop.tick(at(10000));
    EXPECT_EQ(s.meas[0], 32000) << "discarded " << n;
  }
  loop.tick(at(10000));
  EXPECT_EQ(s.meas[0], 10000);
}

TEST(Supply, LimitTableKeepsAboutEightVolts) {
  EXPECT_EQ(supply_limit_pct(MilliVolt{7999}), 100);
  EXPECT_EQ(supply_limit_pct(MilliVolt{12000}), 61);
  EXPECT_EQ(supply_limit_pct(MilliVolt{24000}), 43);
  EXPECT_EQ(supply_limit_pct(MilliVolt{25500}), 42);
  EXPECT_EQ(supply_limit_pct(MilliVolt{25501}), 0);
}

TEST(Current, IsSignedByTheDutyAndFilteredWithAThirdOfASecond) {
  Loop loop;
  ControllerState& s = loop.state;
  s.ref = s.ref_new = {-20000, 20000};
  TickInputs in = at(0);
  in.current_adc = {1638 + 318, 1638 + 318};  // 1000 mA
  for (int n = 0; n < 341; ++n) loop.tick(in);
  EXPECT_NEAR(s.current[0].value, -632, 25);
  EXPECT_NEAR(s.current[1].value, 632, 25);
}

/// An independent statement of the loop in 64-bit floor division.
std::int32_t independent(const Gains& p, std::int64_t error, std::int64_t back) {
  auto floor_shift = [](std::int64_t v, int n) { return v >= 0 ? v / (1LL << n) : -((-v + (1LL << n) - 1) / (1LL << n)); };
  std::int64_t pwm = std::abs(error) > 131072 ? floor_shift(p.p * floor_shift(error, 8), 8) : floor_shift(p.p * error, 16);
  pwm += floor_shift(p.d * back, 16);
  return static_cast<std::int32_t>(std::min<std::int64_t>(std::max<std::int64_t>(pwm, -100), 100));
}

TEST(PositionLoop, AgreesWithAnIndependentModelOnRandomTicks) {
  std::mt19937 rng(11);
  std::uniform_int_distribution<std::int32_t> ref(-30000, 30000), step(-300, 300);
  Loop loop;
  ControllerState& s = loop.state;
  std::int32_t x = 0;
  for (int n = 0; n < 100000; ++n) {
    if (n % 50 == 0) s.ref_new = {ref(rng), 0};
    const std::int32_t before = s.meas[0];
    const std::int32_t r = s.ref[0];
    x = std::max(-32768, std::min(32767, x + step(rng)));
    const bool first = s.first_tick;
    loop.tick(at(x));
    ASSERT_EQ(s.pwm[0], independent(loop.memory.position, std::int64_t{r} - x, first ? 0 : std::int64_t{before} - x)) << n;
  }
}

}  // namespace
