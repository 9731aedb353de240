// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/position_loop.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace {

using namespace vsa::firmware;
using vsa::MilliVolt;
using vsa::Ticks;

constexpr int kTwelveVolts = 1638 + 787;  // 787·1952 >> 7 = 12001 mV

TickInputs at(std::int32_t m0, std::int32_t m1 = 0) { return {{m0, m1, 0}, {1638, 1638}, kTwelveVolts}; }

TEST(PositionLoop, FullOutputAtFiveAndAHalfDegrees) {
  LoopParams p;
  LoopState s;
  s.ref = s.ref_new = {1001, 0};
  tick(p, s, at(0));
  EXPECT_EQ(s.pwm[0], 100);
  s.ref = s.ref_new = {999, 0};
  tick(p, s, at(0));
  EXPECT_EQ(s.pwm[0], 99);
}

TEST(PositionLoop, ShiftsAreFloors) {
  LoopParams p;
  LoopState s;
  s.ref = s.ref_new = {-1, 1};
  tick(p, s, at(0));
  EXPECT_EQ(s.pwm[0], -1) << "−0.1 % floors to −1";
  EXPECT_EQ(s.pwm[1], 0);
}

TEST(PositionLoop, OneEncoderCountMovesTheDerivativeByThirteenPercent) {
  LoopParams p;
  p.kp = 0;
  LoopState s;
  tick(p, s, at(0));
  tick(p, s, at(16));
  EXPECT_EQ(s.pwm[0], -13) << "floor of −12.8";
}

TEST(PositionLoop, ReferenceActsOneToTwoTicksAfterItArrives) {
  LoopParams p;
  LoopState s;
  tick(p, s, at(0));
  set_inputs(p, s, {Ticks{2000}, Ticks{0}});
  tick(p, s, at(0));
  EXPECT_EQ(s.pwm[0], 0) << "copied at the end of this tick";
  tick(p, s, at(0));
  EXPECT_EQ(s.pwm[0], 100);
}

TEST(PositionLoop, LimitsClampTheReferenceAndCanBeOff) {
  LoopParams p;
  LoopState s;
  set_inputs(p, s, {Ticks{32767}, Ticks{-32768}});
  EXPECT_EQ(s.ref_new[0], 30000);
  EXPECT_EQ(s.ref_new[1], -30000);
  p.limits_on = false;
  set_inputs(p, s, {Ticks{32767}, Ticks{-32768}});
  EXPECT_EQ(s.ref_new[0], 65534);
}

TEST(PositionLoop, MeasurementsAreThePreviousTicks) {
  LoopParams p;
  LoopState s;
  tick(p, s, at(160));
  EXPECT_EQ(measurements(p, s)[0].value, 80);
}

TEST(Encoder, CountsTurnsAndBelievesAJumpAtTheTenthTick) {
  LoopParams p;
  LoopState s;
  tick(p, s, at(32000));
  tick(p, s, at(-32000));
  EXPECT_EQ(s.meas[0], -32000 + 65536);
  tick(p, s, at(32000));
  EXPECT_EQ(s.meas[0], 32000);
  for (int n = 0; n < 9; ++n) {
    tick(p, s, at(10000));
    EXPECT_EQ(s.meas[0], 32000) << "discarded " << n;
  }
  tick(p, s, at(10000));
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
  LoopParams p;
  LoopState s;
  s.ref = s.ref_new = {-20000, 20000};
  TickInputs in = at(0);
  in.current_adc = {1638 + 318, 1638 + 318};  // 1000 mA
  for (int n = 0; n < 341; ++n) tick(p, s, in);
  EXPECT_NEAR(s.current[0].value, -632, 25);
  EXPECT_NEAR(s.current[1].value, 632, 25);
}

/// An independent statement of the loop in 64-bit floor division.
std::int32_t independent(const LoopParams& p, std::int64_t error, std::int64_t back) {
  auto floor_shift = [](std::int64_t v, int n) { return v >= 0 ? v / (1LL << n) : -((-v + (1LL << n) - 1) / (1LL << n)); };
  std::int64_t pwm = std::abs(error) > 131072 ? floor_shift(p.kp * floor_shift(error, 8), 8) : floor_shift(p.kp * error, 16);
  pwm += floor_shift(p.kd * back, 16);
  return static_cast<std::int32_t>(std::min<std::int64_t>(std::max<std::int64_t>(pwm, -100), 100));
}

TEST(PositionLoop, AgreesWithAnIndependentModelOnRandomTicks) {
  LoopParams p;
  std::mt19937 rng(11);
  std::uniform_int_distribution<std::int32_t> ref(-30000, 30000), step(-300, 300);
  LoopState s;
  std::int32_t x = 0;
  for (int n = 0; n < 100000; ++n) {
    if (n % 50 == 0) s.ref_new = {ref(rng), 0};
    const std::int32_t before = s.meas[0];
    const std::int32_t r = s.ref[0];
    x = std::max(-32768, std::min(32767, x + step(rng)));
    const bool first = s.first_tick;
    tick(p, s, at(x));
    ASSERT_EQ(s.pwm[0], independent(p, std::int64_t{r} - x, first ? 0 : std::int64_t{before} - x)) << n;
  }
}

}  // namespace
