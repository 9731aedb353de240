// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Dialect seven, the advanced unit, the controller's repairs, and what a snapshot is.
#include <cstdlib>
#include <span>
#include <type_traits>
#include <vector>

#include "unit_bench.hpp"
#include "vsa/bus/parameters.hpp"

long allocation_count();  // allocation_count.cpp

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;
using vsa::Ticks;
namespace bus = vsa::bus;

static_assert(std::is_trivially_copyable_v<ProgramState>, "a snapshot is a copy");
static_assert(std::is_trivially_copyable_v<ControllerState> && std::is_trivially_copyable_v<MemoryState>);

TEST(DialectSeven, PingsWithItsSerialNumberAndAcknowledgesWithTheCommand) {
  UnitBench u(dialect_seven());
  u.set(15, {0x00, 0x98, 0x00, 0x07});
  EXPECT_EQ(u.ask(bus::Ping{}), bus::PingReply{0x980007});
  EXPECT_EQ(u.request(bus::StoreParameters{}), (Bytes{':', ':', 1, 3, 3, 1, 3 ^ 1}));
}

TEST(DialectSeven, AcknowledgesInputsAndParameters) {
  UnitBench u(dialect_seven());
  EXPECT_EQ(u.ask(bus::SetInputsAcknowledged{{Ticks{100}, Ticks{-100}}}), bus::Acknowledgement{true});
  EXPECT_EQ(u.state.loop.ref_new, (std::array{200, -200}));
  bus::SetParameter r;
  r.index = 13;
  r.value = {0, 99};
  r.value_bytes = 2;
  EXPECT_EQ(u.ask(r), bus::Acknowledgement{true});
  EXPECT_EQ(u.state.memory.current.current_limit_mA, 99) << "at once";
  EXPECT_EQ(u.ask(bus::GetCycleTime{})->cycle_time, 1000);
}

TEST(DialectSeven, SetZerosTakesWhereTheUnitIs) {
  UnitBench u(dialect_seven());
  u.in.encoder = {1600, -3200, 160};
  u.tick();
  EXPECT_EQ(u.ask(bus::SetZeros{std::nullopt}), bus::Acknowledgement{true});
  u.tick();
  EXPECT_EQ(u.state.loop.meas, (std::array{0, 0, 0}));
}

TEST(DialectSeven, ANewIdAnswersItsOwnAcknowledgement) {
  UnitBench u(dialect_seven());
  u.set(1, {9});
  EXPECT_EQ(u.state.memory.current.id, 9);
  ASSERT_TRUE(u.ask(bus::Ping{}, 9));
}

TEST(DialectSeven, HasWholeLayoutsAndFramedLongAnswers) {
  UnitBench u(dialect_seven());
  u.state.loop.meas_old = {2, 4, 6};
  EXPECT_EQ(u.ask(bus::GetCurrentsAndMeasurements{})->positions, (std::array{Ticks{1}, Ticks{2}, Ticks{3}}));
  const Bytes list = u.request(bus::GetParameterList{});
  EXPECT_TRUE(bus::decode_parameter_list(u.program.wire(), list));
  const Bytes text = u.request(bus::GetInfo{0});
  ASSERT_GT(text.size(), 500U);
  EXPECT_EQ(text[0], ':');
  EXPECT_EQ((text.size() - 4) % 32, 0U);
}

TEST(DialectSix, DoesNotKnowTheNewCommands) {
  UnitBench u;
  EXPECT_TRUE(u.send({':', ':', 1, 6, 147, 0, 0, 0, 0, 147}).empty());
  EXPECT_TRUE(u.send({':', ':', 1, 2, 150, 150}).empty());
}

TEST(AdvancedUnit, SpeaksWithTheSignsOfPositionsInverted) {
  UnitBench u(advanced_unit());
  u.in.encoder = {160, 0, 160};
  u.tick();
  EXPECT_EQ(u.state.loop.meas, (std::array{-160, 0, 160}));
  EXPECT_EQ(u.ask(bus::GetMeasurements{})->positions, (std::array{Ticks{80}, Ticks{0}, Ticks{-80}}));
  u.request(bus::SetInputs{{Ticks{100}, Ticks{0}}});
  EXPECT_EQ(u.state.loop.ref_new[0], -200);
  u.tick(2);
  EXPECT_EQ(u.ask(bus::GetInputs{})->inputs[0], Ticks{-100}) << "not inverted";
}

TEST(AdvancedUnit, HasReferencesOfItsOwnForCurrentAndPwm) {
  UnitBench u(advanced_unit());
  u.state.memory.stored.control_mode = u.state.memory.current.control_mode = 1;
  u.tick();
  u.request(bus::SetInputs{{Ticks{40}, Ticks{-40}}});
  u.tick(2);
  EXPECT_EQ(u.state.loop.duty, (std::array{40, -40}));
  u.state.memory.stored.control_mode = u.state.memory.current.control_mode = 2;
  u.request(bus::SetInputs{{Ticks{20}, Ticks{-20}}});
  u.tick(2);
  EXPECT_EQ(u.state.loop.duty, (std::array{0, 0})) << "off: no current control";
  u.request(bus::Activate{3});
  u.tick(2);
  EXPECT_EQ(u.state.loop.pwm, (std::array{60, -60})) << "3 % a mA";
}

TEST(AdvancedUnit, ItsRateLimitIsSharedByTheMotorsUnlessRepaired) {
  for (const bool repaired : {false, true}) {
    UnitBench u(advanced_unit({.pwm_rate_per_motor = repaired}));
    u.state.memory.stored.control_mode = u.state.memory.current.control_mode = 1;
    u.state.memory.current.max_pwm_rate = 10;
    u.tick();
    u.request(bus::SetInputs{{Ticks{100}, Ticks{100}}});
    u.tick(2);
    EXPECT_EQ(u.state.loop.duty, repaired ? (std::array{10, 10}) : (std::array{10, 20}));
    u.request(bus::SetInputs{{Ticks{-100}, Ticks{-100}}});
    u.tick(2);
    EXPECT_EQ(u.state.loop.duty[0] > 0, repaired) << "the limited duty is still positive, the pin says backward";
  }
}

TEST(AdvancedUnit, CountsItsCommands) {
  UnitBench u(advanced_unit());
  u.request(bus::Ping{});
  u.request(bus::Ping{});
  u.request(bus::GetInfo{0});
  u.now_ns = u.state.busy_until_ns;
  const Bytes reply = u.send({':', ':', 1, 2, 138, 138});
  ASSERT_EQ(reply.size(), 4U + 42U);
  EXPECT_EQ(reply[4 + 1 + 2 * Counters::ping + 1], 2);
  EXPECT_EQ(reply[4 + 1 + 2 * Counters::info + 1], 1);
}

TEST(AdvancedUnit, SetZerosDoesNotReachItsSamplesUnlessRepaired) {
  for (const bool repaired : {false, true}) {
    UnitBench u(advanced_unit({.zeros_reset_samples = repaired}));
    u.in.encoder = {32000, 0, 0};
    u.tick();
    u.ask(bus::SetZeros{{{Ticks{-16000}, Ticks{0}, Ticks{0}}}});
    u.tick();
    EXPECT_EQ(u.state.loop.meas[0], repaired ? 0 : -32000) << "a jump of 32000 is held back, one from 0 isn't";
  }
}

TEST(ControllerRepairs, TheDoubleLoopsCurrentDerivativeIsZeroUnlessRepaired) {
  for (const bool repaired : {false, true}) {
    UnitBench u(with({.double_loop_current_derivative = repaired}));
    Memory& m = u.state.memory.current;
    m.control_mode = 3;
    m.double_current.d = 1 << 16;
    u.in.current_adc = {4000, 1638};
    bool moved = false;
    for (int n = 0; n < 50; ++n) {
      u.tick();
      moved = moved || u.state.loop.pwm[0] != 0;
    }
    EXPECT_EQ(moved, repaired);
  }
}

TEST(ControllerRepairs, JumpsOfAHalfAndThreeQuartersOfATurnPassUnlessRepaired) {
  for (const std::int32_t jump : {32768, 49152}) {
    for (const bool repaired : {false, true}) {
      UnitBench u(with({.jump_check_in_16_bits = repaired}));
      u.in.encoder = {-32768, 0, 0};
      u.tick();
      u.in.encoder = {-32768 + jump, 0, 0};
      u.tick();
      EXPECT_EQ(u.state.loop.meas[0], repaired ? -32768 : -32768 + jump) << jump;
    }
  }
}

TEST(Encoder, AWordWithOddParityIsAsIfNothingHadCome) {
  UnitBench u;
  u.in.encoder = {160, 160, 160};
  u.tick();
  u.in.encoder = {320, 320, 320};
  u.in.encoder_ok = {true, false, true};
  u.tick();
  EXPECT_EQ(u.state.loop.meas, (std::array{320, 160, 320}));
}

TEST(Modes, TheThirdEncoderCanBeTheReferenceOfBothMotors) {
  UnitBench u;
  u.state.memory.current.input_mode = 1;
  u.in.encoder = {0, 0, 20000};
  u.tick(2);
  EXPECT_EQ(u.state.loop.ref_old, (std::array{20000, 20000})) << "what GET_INPUTS shows";
  EXPECT_EQ(u.state.loop.pwm, (std::array{100, 100}));
  u.state.memory.current.limit_high = {100, 30000};
  u.tick();
  EXPECT_EQ(u.state.loop.ref_old, (std::array{100, 20000}));
}

TEST(Modes, DeflectionIsRelativeToTheShaft) {
  UnitBench u;
  u.state.memory.current.control_mode = 4;
  u.state.memory.current.position = {6553, 0, 0};
  u.in.encoder = {1600, 1600, 1600};
  u.tick(2);
  EXPECT_EQ(u.state.loop.pwm, (std::array{0, 0}));
}

TEST(Modes, ADefaultUnitDoesNothingInTheDoubleLoops) {
  for (const std::uint8_t mode : {std::uint8_t{3}, std::uint8_t{5}}) {
    UnitBench u;
    u.state.memory.current.control_mode = mode;
    u.state.loop.ref = u.state.loop.ref_new = {20000, -20000};
    u.tick(3);
    EXPECT_EQ(u.state.loop.duty, (std::array{0, 0}));
  }
}

TEST(Duty, OnePercentUpIsLostAndOnePercentDownIsNot) {
  Memory m = initial_memory(Model::maker_pro);
  m.position = {6554, 0, 0};
  ControllerState s;
  s.limit_pct = 100;
  s.ref = {10, -1};
  Controller{}.drive_motor({m, m}, s, 0);
  Controller{}.drive_motor({m, m}, s, 1);
  EXPECT_EQ(s.pwm, (std::array{1, -1}));
  EXPECT_EQ(s.duty, (std::array{0, -1}));
}

/// Ticks of one motor's loop at a steady supply, and what went out.
std::vector<std::int32_t> duties(Generation generation, std::span<const std::int32_t> positions, std::int32_t reference) {
  Memory m = initial_memory(Model::maker_pro);
  ControllerState s;
  s.limit_pct = 100;
  s.ref = s.ref_new = {reference, 0};
  const Controller controller{Model::maker_pro, false, {}, generation};
  std::vector<std::int32_t> out;
  for (const std::int32_t at : positions) {
    controller.tick({m, m}, s, {{at, 0, 0}, {1638, 1638}, 2400});
    out.push_back(s.pwm[0]);
  }
  return out;
}

TEST(Generation, TheLoopOf2014RunsEverySecondTickAndDampsTwiceAsMuch) {
  std::vector<std::int32_t> turning;
  for (std::int32_t n = 0; n < 12; ++n) turning.push_back(16 * n);
  // P of 100·0.1 = 10 % less 16·0.8 = 12.8 % a tick, floored each.
  const auto now = duties(Generation::v6, turning, 300), then = duties(Generation::v4, turning, 300);
  for (std::size_t n = 4; n < 12; ++n) {
    const std::int32_t p = (6553 * (300 - turning[n])) >> 16;
    EXPECT_EQ(now[n], p - 13) << n;
    EXPECT_EQ(then[n], n % 2 == 1 ? p - 26 : then[n - 1]) << n;
  }
}

TEST(Generation, OnePercentDownWasLostToo) {
  Memory m = initial_memory(Model::maker_pro);
  ControllerState s;
  s.limit_pct = 100;
  s.ref = {-1, -1};
  const Controller then{Model::maker_pro, true, {}, Generation::v4};
  then.drive_motor({m, m}, s, 0);
  EXPECT_EQ(s.pwm[0], -1);
  EXPECT_EQ(s.duty[0], 0);
}

TEST(Generation, TheSupplysTablesAreThoseOfTheirTime) {
  const auto pct = [](int millivolts, Generation g) { return supply_limit_pct(vsa::MilliVolt{millivolts}, g); };
  EXPECT_EQ(pct(12000, Generation::v6), 61);
  EXPECT_EQ(pct(12000, Generation::v4), 60);
  EXPECT_EQ(pct(11999, Generation::v4), 61);
  EXPECT_EQ(pct(25500, Generation::v4), 42);
  EXPECT_EQ(pct(25501, Generation::v4), 0);
  EXPECT_EQ(pct(8000, Generation::v3), 100);
  EXPECT_EQ(pct(8001, Generation::v3), 80);
  EXPECT_EQ(pct(12000, Generation::v3), 68);
  EXPECT_EQ(pct(12001, Generation::v3), 66);
  EXPECT_EQ(pct(13000, Generation::v3), 64);
  EXPECT_EQ(pct(13001, Generation::v3), 0);
  EXPECT_EQ(pct(24000, Generation::v2), 100);
}

TEST(Generation, AUnitOfThatTimeSettlesOnItsReferencesWithoutAKick) {
  ProgramParams p;
  p.generation = Generation::v4;
  const Program program(p);
  ProgramState s = program.fresh(0);
  s.loop.ref_new = {16000, -16000};
  const TickInputs in{{16000, -16000, 0}, {1638, 1638}, 2400};
  settle(program, s, in);
  Output out;
  for (int n = 0; n < 4; ++n) {
    program.tick(s, in, n * 1'000'000, out);
    EXPECT_LE(std::abs(s.loop.pwm[0]), 2) << n;
    EXPECT_LE(std::abs(s.loop.pwm[1]), 2) << n;
  }
}

TEST(Current, AtZeroDutyIsReadAsPositive) {
  UnitBench u;
  u.in.current_adc = {4000, 4000};
  u.tick(5);
  EXPECT_EQ(u.state.loop.duty, (std::array{0, 0}));
  EXPECT_GT(u.state.loop.current[0].value, 0);
}

TEST(Snapshot, ACopyGoesOnLikeTheOriginal) {
  UnitBench u;
  u.tick(5);
  u.send({':', ':', 1});  // in the middle of a frame
  UnitBench copy = u;
  for (UnitBench* b : {&u, &copy}) {
    b->send({6, 130, 1, 2, 3, 4, 130 ^ 1 ^ 2 ^ 3 ^ 4});
    b->tick(20);
  }
  EXPECT_EQ(u.state.loop.duty, copy.state.loop.duty);
  EXPECT_EQ(u.request(bus::GetInputs{}), copy.request(bus::GetInputs{}));
}

TEST(Allocations, NeitherATickNorAFrameAllocates) {
  UnitBench u;
  const auto list = bus::encode_request(u.program.wire(), 1, bus::Request{bus::GetParameterList{}});
  const auto info = bus::encode_request(u.program.wire(), 1, bus::Request{bus::GetInfo{0}});
  const auto stores = bus::encode_request(u.program.wire(), 1, bus::Request{bus::StoreParameters{}});
  const long before = allocation_count();
  int replies = 0;
  for (const auto& frame : {list, info, stores}) {
    for (const std::uint8_t byte : frame.view()) {
      u.out.clear();
      u.program.receive(u.state, byte, u.now_ns, u.out);
      replies += u.out.count;
    }
    u.now_ns += 100 * kTickNs;
    u.tick(3);
  }
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(replies, 3);
}

}  // namespace
