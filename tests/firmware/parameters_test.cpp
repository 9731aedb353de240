// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Setting and storing: what acts at once, what after a store, and how long a store takes.
#include "unit_bench.hpp"

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;
using vsa::Ticks;
namespace bus = vsa::bus;

TEST(Parameters, ASetIsNotAnsweredUnlessRepaired) {
  UnitBench u;
  bus::SetParameter r;
  r.index = 13;
  r.value_bytes = 2;
  EXPECT_TRUE(u.request(r).empty());
  UnitBench repaired(with({.acknowledge_set_parameter = true}));
  EXPECT_EQ(repaired.ask(r), bus::Acknowledgement{true});
  r.index = 14;
  EXPECT_TRUE(repaired.request(r).empty()) << "no such parameter";
}

TEST(Parameters, GainsAndModesActOnlyAfterAStore) {
  UnitBench u;
  u.set(2, {0x3F, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  u.set(6, {4});
  EXPECT_EQ(u.state.memory.stored.position, (Gains{65536, 0, 0}));
  EXPECT_EQ(u.state.memory.current.position, (Gains{6553, 0, 52428}));
  EXPECT_EQ(u.state.memory.current.control_mode, 0);
  ASSERT_TRUE(u.stores());
  EXPECT_EQ(u.state.memory.current.position, (Gains{65536, 0, 0}));
  EXPECT_EQ(u.state.memory.current.control_mode, 4);
}

TEST(Parameters, ResolutionsAndOffsetsActAtOnce) {
  UnitBench u;
  u.in.encoder = {1600, 0, 0};
  u.tick();
  EXPECT_EQ(u.ask(bus::GetMeasurements{})->positions[0], Ticks{800});
  u.set(7, {4, 1, 1});
  EXPECT_EQ(u.ask(bus::GetMeasurements{})->positions[0], Ticks{100});
  u.set(8, {0, 10, 0, 0, 0, 0});  // 10 << 4
  u.tick();
  EXPECT_EQ(u.ask(bus::GetMeasurements{})->positions[0], Ticks{110});
}

TEST(Parameters, SetZerosIsAcknowledgedMovesTheOriginAndForgetsTheTurns) {
  UnitBench u;
  u.in.encoder = {32000, 0, 0};
  u.tick();
  u.in.encoder = {-32000, 0, 0};
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], 33536);
  EXPECT_EQ(u.ask(bus::SetZeros{{{Ticks{16000}, Ticks{0}, Ticks{0}}}}), bus::Acknowledgement{true});
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], 0);
  EXPECT_EQ(u.state.memory.user.offset[0], 0) << "lost at power-down unless stored";
}

TEST(Parameters, AZeroedUnitFarFromItsNewOriginHoldsItsPositionForNineTicks) {
  UnitBench u;
  u.tick();
  u.ask(bus::SetZeros{{{Ticks{10000}, Ticks{0}, Ticks{0}}}});
  u.tick(9);
  EXPECT_EQ(u.state.loop.meas[0], 0);
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], 20000);
}

TEST(Parameters, TheModeInUseDecidesWhichGainsAreSet) {
  UnitBench u;
  const Bytes ones{0x3F, 0x80, 0, 0, 0x3F, 0x80, 0, 0, 0x3F, 0x80, 0, 0};
  u.set(6, {3});
  u.set(2, ones);
  EXPECT_EQ(u.state.memory.stored.position.i, 65536) << "mode 3 isn't current yet";
  ASSERT_TRUE(u.stores());
  u.wait_for_store();
  u.set(3, ones);
  EXPECT_EQ(u.state.memory.stored.double_current.i, 65536);
  EXPECT_EQ(u.state.memory.stored.current.i, 0);
}

TEST(Parameters, LimitsAreShiftedByTheStoredResolutionAndMaxStepsOfTheWrongSignAreLeftOut) {
  UnitBench u;
  u.set(11, {0xFF, 0xFF, 0xFF, 0x9C, 0, 0, 0, 100, 0xFF, 0xFF, 0xFF, 0x38, 0, 0, 0, 200});
  EXPECT_EQ(u.state.memory.stored.limit_low, (std::array{-200, -400}));
  EXPECT_EQ(u.state.memory.stored.limit_high, (std::array{200, 400}));
  u.set(12, {0, 0, 0, 5, 0, 0, 0, 6});
  EXPECT_EQ(u.state.memory.stored.max_step_negative, 0);
  EXPECT_EQ(u.state.memory.stored.max_step_positive, 6);
}

TEST(Parameters, BetweenSetAndStoreAUnitListensToItsOldIdAndAnswersWithTheNew) {
  UnitBench u;
  u.set(1, {5});
  EXPECT_TRUE(u.request(bus::Ping{}, 5).empty());
  ASSERT_TRUE(u.ask(bus::Ping{}, 1));
  EXPECT_EQ(u.last_id, 5);
  ASSERT_TRUE(u.stores());
  EXPECT_EQ(u.last_id, 1) << "the store's acknowledgement has the old one";
  u.wait_for_store();
  EXPECT_TRUE(u.request(bus::Ping{}, 1).empty());
  ASSERT_TRUE(u.ask(bus::Ping{}, 5));
  EXPECT_EQ(u.last_id, 5);
}

TEST(Parameters, RestoreAndInitAnswerWithTheIdThatTheyBrought) {
  UnitBench u;
  u.set(1, {5});
  ASSERT_TRUE(u.stores());
  u.wait_for_store();
  EXPECT_EQ(u.ask(bus::RestoreDefaults{}), bus::Acknowledgement{true});
  EXPECT_EQ(u.last_id, 1);
  EXPECT_EQ(u.state.memory.current.id, 1);
}

TEST(Parameters, AStoreTakesItsRowsTimeWithoutPwmAndWithoutTicks) {
  UnitBench u;
  u.request(bus::SetInputs{{Ticks{5000}, Ticks{5000}}});
  u.tick(4);
  ASSERT_EQ(u.state.loop.duty[0], 61);
  ASSERT_TRUE(u.stores());
  EXPECT_EQ(u.last_delay_ns, kMemoryRows * 10'000'000);
  EXPECT_EQ(u.state.loop.duty, (std::array{0, 0}));
  u.in.encoder = {16, 0, 0};
  u.tick(60);
  EXPECT_EQ(u.state.loop.meas[0], 0);
  EXPECT_EQ(u.state.loop.duty[0], 0);
  u.tick(12);
  EXPECT_EQ(u.state.loop.meas[0], 16);
  EXPECT_EQ(u.state.loop.duty[0], 61);
  u.now_ns = u.state.busy_until_ns;
  EXPECT_EQ(u.ask(bus::InitMemory{}), bus::Acknowledgement{true});
  EXPECT_EQ(u.last_delay_ns, 2 * kMemoryRows * 10'000'000);
}

TEST(Parameters, AStoreMovesTheReferencesWithChangedOffsetsAndMultipliers) {
  UnitBench u;
  u.request(bus::SetInputs{{Ticks{1000}, Ticks{1000}}});
  u.set(8, {0, 50, 0, 0, 0, 0});
  u.set(9, {0x3F, 0x80, 0, 0, 0x40, 0, 0, 0, 0x3F, 0x80, 0, 0});  // 1, 2, 1
  ASSERT_TRUE(u.stores());
  EXPECT_EQ(u.state.loop.ref_new, (std::array{2100, 4000}));
}

TEST(Parameters, MultipliersScaleThePositionAfterAStore) {
  UnitBench u;
  u.in.encoder = {1600, 0, 0};
  u.set(9, {0xBF, 0, 0, 0, 0x3F, 0x80, 0, 0, 0x3F, 0x80, 0, 0});  // −0.5
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], 1600);
  ASSERT_TRUE(u.stores());
  u.wait_for_store();
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], -800);
}

TEST(Parameters, PowerBringsBackWhatWasStored) {
  UnitBench u;
  u.set(13, {0, 77});
  u.set(4, {3});
  ASSERT_TRUE(u.stores());
  u.set(13, {0, 88});
  u.program.power_up(u.state, u.now_ns);
  EXPECT_EQ(u.state.memory.current.current_limit_mA, 77);
  EXPECT_EQ(u.state.enable, 3) << "start-up activation";
}

TEST(Parameters, SetPositionAndStiffnessUsesTheCurrentMaxStiffnessAndClampsThePosition) {
  UnitBench u;
  u.request(bus::SetPositionStiffness{Ticks{1000}, 16384});
  EXPECT_EQ(u.state.loop.ref_new, (std::array{2000 + 3000, 2000 - 3000}));
  u.request(bus::SetPositionStiffness{Ticks{32767}, -32768});
  EXPECT_EQ(u.state.loop.ref_new, (std::array{24000 - 6000, 24000 + 6000}));
  u.state.memory.current.limits_on = 0;
  u.request(bus::SetPositionStiffness{Ticks{-32768}, 0});
  EXPECT_EQ(u.state.loop.ref_new[0], -24000) << "whatever the flag";
}

}  // namespace
