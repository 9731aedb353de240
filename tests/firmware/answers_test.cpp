// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the GETs answer, and when.
#include "unit_bench.hpp"
#include "vsa/bus/parameters.hpp"
#include "vsa/firmware/exchange.hpp"

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;
using vsa::Ticks;
namespace bus = vsa::bus;

TEST(Answers, MeasurementsAreTheLastCompletedTicksAndBigEndian) {
  UnitBench u;
  u.in.encoder = {-32, 512, 32};
  u.tick(2);
  EXPECT_EQ(u.request(bus::GetMeasurements{}), (Bytes{':', ':', 1, 8, 132, 0xFF, 0xF0, 1, 0, 0, 16, 132 ^ 0xFF ^ 0xF0 ^ 1 ^ 16}));
}

TEST(Answers, InTheMiddleOfATickTheyAreTheTickBefore) {
  UnitBench u;
  u.in.encoder = {160, 0, 0};
  u.tick();
  u.in.encoder = {320, 0, 0};
  u.out.clear();
  u.program.begin_tick(u.state, u.in, u.now_ns += kTickNs, u.out);
  EXPECT_EQ(u.state.loop.meas[0], 320);
  EXPECT_EQ(positions(Model::maker_pro, u.state.memory.stored, u.state.loop)[0], Ticks{80});
  u.program.end_tick(u.state, u.in, u.now_ns, u.out);
  EXPECT_EQ(positions(Model::maker_pro, u.state.memory.stored, u.state.loop)[0], Ticks{160});
}

TEST(Answers, PositionsBeyondSixteenBitsWrap) {
  UnitBench u;
  u.state.loop.meas_old = {40000 << 1, 0, -(40000 << 1)};
  const auto r = u.ask(bus::GetMeasurements{});
  ASSERT_TRUE(r);
  EXPECT_EQ(r->positions[0], Ticks{static_cast<std::int16_t>(40000 - 65536)});
  EXPECT_EQ(r->positions[2], Ticks{static_cast<std::int16_t>(65536 - 40000)});
}

TEST(Answers, InputsAreTheReferencesOfTheTickBefore) {
  UnitBench u;
  u.tick();
  EXPECT_TRUE(u.request(bus::SetInputs{{Ticks{500}, Ticks{-500}}}).empty()) << "not acknowledged";
  EXPECT_EQ(u.ask(bus::GetInputs{})->inputs[0], Ticks{0});
  u.tick();  // copies it
  EXPECT_EQ(u.ask(bus::GetInputs{})->inputs[0], Ticks{0});
  u.tick();  // acts
  EXPECT_EQ(u.ask(bus::GetInputs{})->inputs, (std::array{Ticks{500}, Ticks{-500}}));
}

TEST(Answers, CurrentsAndPositionsHaveTheLayoutOfTheDefectUnlessRepaired) {
  const auto body = [](Repairs repairs) {
    UnitBench u(with(repairs));
    u.state.loop.meas_old = {2 << 1, 4 << 1, 6 << 1};
    u.state.loop.current_old = {vsa::MilliAmp{1}, vsa::MilliAmp{-1}};
    return u.request(bus::GetCurrentsAndMeasurements{});
  };
  const Bytes broken = body({}), whole = body({.layout_134 = true});
  EXPECT_EQ(Bytes(broken.begin() + 4, broken.end() - 1), (Bytes{134, 0, 1, 0xFF, 0xFF, 0, 2, 0, 0, 0, 4}));
  EXPECT_EQ(Bytes(whole.begin() + 4, whole.end() - 1), (Bytes{134, 0, 1, 0xFF, 0xFF, 0, 2, 0, 4, 0, 6}));
}

TEST(Answers, VelocitiesAreNeverComputed) {
  UnitBench u;
  u.in.encoder = {16, 0, 0};
  u.tick(3);
  EXPECT_EQ(u.request(bus::GetVelocities{}), (Bytes{':', ':', 1, 8, 137, 0, 0, 0, 0, 0, 0, 137}));
}

TEST(Answers, TheParameterListHas1205BytesAndALengthThatIsCutToEightBits) {
  UnitBench u;
  const Bytes list = u.request(bus::GetParameterList{});
  ASSERT_EQ(list.size(), 1205U);
  EXPECT_EQ(list[3], 1201 % 256);
  EXPECT_EQ(list[4], 12);
  EXPECT_EQ(list[5], 13);
  const auto v = bus::decode_parameter_list(u.program.wire(), list);
  ASSERT_TRUE(v);
  EXPECT_FLOAT_EQ(v->position_pid[0], 6553.0F / 65536.0F);
  EXPECT_EQ(v->limits, (std::array{-15000, 15000, -15000, 15000})) << "in ticks";
  EXPECT_EQ(v->current_limit, 1500);
}

TEST(Answers, TheListShowsTheCurrentSetAndInTheDoubleModesItsGains) {
  UnitBench u;
  u.set(13, {0, 100});
  EXPECT_EQ(bus::decode_parameter_list(u.program.wire(), u.request(bus::GetParameterList{}))->current_limit, 1500);
  u.state.memory.stored.control_mode = 3;
  u.state.memory.stored.double_position.p = 2 << 16;
  ASSERT_TRUE(u.stores());
  u.wait_for_store();
  const auto v = bus::decode_parameter_list(u.program.wire(), u.request(bus::GetParameterList{}));
  EXPECT_EQ(v->current_limit, 100);
  EXPECT_EQ(v->position_pid[0], 2.0F);
}

TEST(Answers, TheAdvancedUnitsListHasAFourteenthSlotBeforeTheMenus) {
  UnitBench u(advanced_unit());
  const Bytes list = u.request(bus::GetParameterList{});
  ASSERT_EQ(list.size(), 1205U);
  EXPECT_EQ(list[5], 14);
  const auto text = [&](std::size_t at, std::size_t n) { return std::string(list.begin() + 4 + at, list.begin() + 4 + at + n); };
  EXPECT_EQ(text(655, 18), "14 - Max PWM rate:");
  EXPECT_EQ(text(702, 8), "0 -> Usb");
  EXPECT_EQ(text(1002, 10), "0 -> Deact");
}

TEST(Answers, InModeFiveTheNextParametersTextIsOverrunUnlessRepaired) {
  for (const bool repaired : {false, true}) {
    UnitBench u(with({.list_mode_5 = repaired}));
    u.state.memory.current.control_mode = 5;
    const Bytes list = u.request(bus::GetParameterList{});
    ASSERT_TRUE(bus::decode_parameter_list(u.program.wire(), list)) << "the checksum is right";
    EXPECT_EQ(bus::read_slot(list, 6)->text, "6 - Control mode: Deflection and current");
    EXPECT_EQ(bus::read_slot(list, 7)->text, repaired ? "7 - Resolutions:" : "t");
  }
}

TEST(Answers, TheListsChecksumCovers176BytesUnlessRepaired) {
  for (const bool repaired : {false, true}) {
    UnitBench u(with({.list_checksum = repaired}));
    u.state.memory.current.current_limit_mA = 0x1234;
    const Bytes list = u.request(bus::GetParameterList{});
    EXPECT_EQ(list.back(), bus::checksum(std::span{list}.subspan(4, repaired ? 1200 : 176)));
  }
}

TEST(Answers, LongAnswersKeepTheProgramBusyAndTicksAreLost) {
  UnitBench u;
  u.tick();
  u.in.encoder = {16, 0, 0};
  const std::int64_t asked_ns = u.now_ns + 10 * kTickNs;
  u.request(bus::GetParameterList{});
  EXPECT_NEAR(static_cast<double>(u.state.busy_until_ns - asked_ns), 6.025e6 + 0.04e6, 1e3) << "1205 bytes after 8 of the request";
  u.tick(5);
  EXPECT_EQ(u.state.loop.meas[0], 0) << "five ticks are over";
  u.tick();
  EXPECT_EQ(u.state.loop.meas[0], 16) << "the late one";
}

}  // namespace
