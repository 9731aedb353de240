// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/master.hpp"

#include <gtest/gtest.h>

namespace {

using namespace vsa::bus;

TEST(BusSchedule, AByteIsFiveMicrosecondsAtTwoMegabaud) {
  const Schedule s = make_schedule(12, 2e6, std::nullopt);
  EXPECT_EQ(s.inputs_at_ns(0, 0), 50'000);
  EXPECT_EQ(s.request_at_ns(0, 0), 80'000);
  EXPECT_EQ(s.reply_at_ns(0, 0), 140'000);
}

TEST(BusSchedule, UnitTwelveHearsElevenSlotsAfterUnitOne) {
  const Schedule s = make_schedule(12, 2e6, std::nullopt);
  EXPECT_EQ(s.inputs_at_ns(0, 11) - s.inputs_at_ns(0, 0), 11 * 140'000);
}

TEST(BusSchedule, AutomaticCycleIsAMillisecondAUnitOrTheWireTime) {
  EXPECT_EQ(make_schedule(12, 2e6, std::nullopt).cycle_ns, 12'000'000);
  EXPECT_EQ(make_schedule(12, 115200, std::nullopt).cycle_ns, wire_time_ns(12, 115200));
  EXPECT_GT(wire_time_ns(12, 115200), 12'000'000);
  EXPECT_EQ(make_schedule(12, 2e6, 0.005).cycle_ns, 5'000'000);
}

}  // namespace
