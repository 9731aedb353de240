// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// On, off, and who says so: activation, watchdog, calibration.
#include <algorithm>
#include <cstdlib>

#include "unit_bench.hpp"

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;
namespace bus = vsa::bus;

std::uint8_t reported(UnitBench& u) { return u.ask(bus::GetActivate{})->flags; }

TEST(Activation, EnablesAtOnceAndTheReferencesFollowAtTheEndOfTheNextTick) {
  UnitBench u;
  u.in.encoder = {3200, -3200, 0};
  u.tick();
  EXPECT_TRUE(u.request(bus::Activate{3}).empty()) << "not acknowledged";
  EXPECT_EQ(u.state.enable, 3);
  EXPECT_EQ(reported(u), 0);
  u.tick();
  EXPECT_EQ(u.state.loop.duty[0], -61) << "the old reference, 0, drives once more";
  EXPECT_EQ(reported(u), 3);
  u.tick();
  EXPECT_EQ(u.state.loop.duty[0], 0);
  EXPECT_EQ(u.state.loop.ref, (std::array{3200, -3200}));
}

TEST(Activation, RepairedItWaitsForTheReferences) {
  UnitBench u(with({.activation_with_references = true}));
  u.in.encoder = {3200, -3200, 0};
  u.tick();
  u.request(bus::Activate{3});
  EXPECT_EQ(u.state.enable, 0);
  u.tick();
  EXPECT_EQ(u.state.enable, 3);
  u.request(bus::Activate{0});
  EXPECT_EQ(u.state.enable, 0) << "off is at once";
}

TEST(Activation, InModesOneAndTwoTheReferencesStay) {
  for (const std::uint8_t mode : {std::uint8_t{1}, std::uint8_t{2}}) {
    UnitBench u;
    u.state.memory.stored.control_mode = mode;
    u.in.encoder = {3200, 3200, 0};
    u.tick();
    u.request(bus::Activate{3});
    EXPECT_EQ(u.state.loop.ref_new[0], 0) << int{mode};
  }
}

TEST(Activation, AUnitThatLostItsTurnsRefuses) {
  for (int sensor = 0; sensor < 3; ++sensor) {
    UnitBench u;
    u.in.encoder[sensor] = sensor == 1 ? -26016 : 26016;
    u.tick();
    u.request(bus::Activate{3});
    u.tick();
    EXPECT_EQ(u.state.enable, 0) << sensor;
    EXPECT_EQ(reported(u), 0);
    u.in.encoder[sensor] = sensor == 1 ? -26000 : 26000;
    u.tick(10);
    u.request(bus::Activate{3});
    EXPECT_EQ(u.state.enable, 3) << "exactly 26000 is accepted";
  }
}

TEST(Activation, EachFlagEnablesItsOwnMotor) {
  UnitBench u;
  u.tick();
  u.request(bus::Activate{1});
  EXPECT_TRUE(u.program.drive(u.state).enabled[0]);
  EXPECT_FALSE(u.program.drive(u.state).enabled[1]);
}

TEST(Activation, WithStartUpActivationTheMotorsAreOnButTheFlagIsSoonZero) {
  for (const bool repaired : {false, true}) {
    UnitBench u(with({.startup_activation_reported = repaired}));
    u.state.memory.user.startup_activation = 3;
    u.program.power_up(u.state, u.now_ns);
    EXPECT_EQ(reported(u), 3);
    u.tick();
    EXPECT_EQ(reported(u), repaired ? 3 : 0);
    EXPECT_EQ(u.state.enable, 3);
  }
}

TEST(Activation, AtPowerUpTurnsAreLostAndTheFirstTickHasNoOutput) {
  UnitBench u;
  u.in.encoder = {32000, 0, 0};
  u.tick();
  u.in.encoder = {-32000, 0, 0};
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], 33536);
  u.state.memory.user.startup_activation = 3;
  u.program.power_up(u.state, u.now_ns);
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], -32000);
  EXPECT_EQ(u.state.loop.pwm[0], 100);
  EXPECT_EQ(u.state.loop.duty[0], 0) << "no supply was read yet";
  u.tick();
  EXPECT_EQ(u.state.loop.duty[0], 61);
}

/// Milliseconds from a byte to the moment when the watchdog clears the flag.
int watchdog_ms(UnitBench& u, std::uint8_t setting) {
  u.tick();
  u.request(bus::Activate{3});
  u.request(bus::SetWatchdog{setting});
  for (int ms = 0; ms < 20'000; ++ms) {
    u.tick();
    if (u.state.watchdog.expired) return ms;
  }
  return -1;
}

TEST(Watchdog, ExpiresAfterTwentyMillisecondsAUnitInStepsOf41) {
  for (const int setting : {3, 50, 250, 255}) {
    UnitBench u;
    const int clocks = ((std::min(setting, 250) * 500) >> 10) + 1;
    EXPECT_NEAR(watchdog_ms(u, static_cast<std::uint8_t>(setting)), (clocks + 0.5) * 40.96, 42.0) << setting;
  }
  UnitBench off;
  EXPECT_EQ(watchdog_ms(off, 0), -1);
}

TEST(Watchdog, ClearsTheReportedFlagOnlyUnlessRepaired) {
  for (const bool repaired : {false, true}) {
    UnitBench u(with({.watchdog_stops_motors = repaired}));
    ASSERT_GT(watchdog_ms(u, 10), 0);
    u.tick(2);
    EXPECT_EQ(u.state.loop.orders.onoff, 0);
    EXPECT_EQ(u.state.enable, repaired ? 0 : 3);
  }
}

TEST(Watchdog, AnyByteOnTheBusKeepsItQuiet) {
  UnitBench u;
  u.tick();
  u.request(bus::Activate{3});
  u.request(bus::SetWatchdog{10});
  for (int n = 0; n < 50; ++n) {
    u.tick(100);
    u.send({0});
  }
  EXPECT_EQ(u.state.loop.orders.onoff, 3);
}

TEST(Watchdog, PeriodsOneAndTwoBecomeZeroUnlessRepaired) {
  EXPECT_EQ(watchdog_period(1), 0);
  EXPECT_EQ(watchdog_period(2), 0);
  EXPECT_EQ(watchdog_period(3), 1);
  EXPECT_EQ(watchdog_period(250), 122);
  EXPECT_EQ(watchdog_period(255), 122);
  UnitBench u(with({.watchdog_short_periods = true}));
  u.request(bus::SetWatchdog{2});
  EXPECT_EQ(u.state.watchdog.period, 1);
}

TEST(Watchdog, AStoredPeriodEnablesItAtPowerUpWithTheCountersOwnPeriod) {
  UnitBench u;
  u.state.memory.user.watchdog_period = 5;
  u.program.power_up(u.state, u.now_ns);
  EXPECT_TRUE(u.state.watchdog.enabled);
  EXPECT_EQ(u.state.watchdog.period, 127);
}

/// Runs until the calibration is over; the motors follow their references and press against a stop at `stop_raw`.
int calibrate(UnitBench& u, std::int32_t stop_raw, int motor) {
  u.tick();
  EXPECT_EQ(u.ask(bus::Calibrate{}), bus::Acknowledgement{true});
  int ticks = 0;
  for (; u.state.calibration.stage != Calibration::Stage::stop && ticks < 60'000; ++ticks) {
    u.tick();
    const bool pressed = std::abs(u.state.loop.ref[motor]) > stop_raw;
    for (int i = 0; i < 2; ++i) {
      u.in.encoder[i] =
          pressed && i == motor ? std::clamp(u.state.loop.ref[i], -stop_raw, stop_raw) / 16 * 16 : u.state.loop.ref[i] / 16 * 16;
      u.in.current_adc[i] = 1638 + (pressed && i == motor ? 600 : 0);
    }
  }
  return ticks;
}

TEST(Calibration, SpreadsTheMotorsUntilTheFirstOnesCurrentAndStoresItsReference) {
  UnitBench u;
  calibrate(u, 4550, 0);
  // 4550 = 50 steps of 91; the filtered current needs some more.
  const int max = u.state.memory.user.max_stiffness;
  EXPECT_GT(max, 4550);
  EXPECT_EQ(max % 91, 0);
  EXPECT_EQ(u.state.memory.factory.max_stiffness, max);
  EXPECT_EQ(u.state.memory.current.max_stiffness, max);
  EXPECT_EQ(u.state.memory.current.position, (Gains{6553, 0, 52428})) << "the gains are back";
  EXPECT_EQ(u.state.enable, 0) << "as before";
}

TEST(Calibration, ItsOwnGainsAndSilenceLastFromTheFirstStepToTheEnd) {
  UnitBench u;
  u.tick();
  u.ask(bus::Calibrate{});
  EXPECT_TRUE(u.ask(bus::Ping{})) << "up to 100 ms it still hears";
  u.tick(110);
  EXPECT_TRUE(u.request(bus::Ping{}).empty());
  EXPECT_EQ(u.state.enable, 3);
  u.tick(1000);
  EXPECT_EQ(u.state.memory.current.position, (Gains{6553, 0, 19660}));
  u.tick(300);
  EXPECT_EQ(u.state.loop.ref_new, (std::array{3 * 91, -3 * 91}));
}

TEST(Calibration, DoesNotSeeTheSecondMotorsNegativeCurrentUnlessRepaired) {
  UnitBench u;
  u.state.memory.stored.limits_on = u.state.memory.current.limits_on = 0;
  EXPECT_EQ(calibrate(u, 4550, 1), 60'000) << "goes on for ever";
  UnitBench repaired(with({.calibration_both_motors = true}));
  EXPECT_LT(calibrate(repaired, 4550, 1), 12'000);
}

}  // namespace
