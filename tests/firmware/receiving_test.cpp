// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Bytes in: what a unit hears, when it looks, and what it is silent about.
#include "unit_bench.hpp"

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;
namespace bus = vsa::bus;

const Bytes kPing{':', ':', 1, 2, 0, 0};
const Bytes kPingReply{':', ':', 1, 2, 0, 0};

TEST(Receiving, APingIsAnsweredByteForByte) {
  UnitBench u;
  EXPECT_EQ(u.send(kPing), kPingReply);
}

TEST(Receiving, NoiseAndBadLengthsCostAFrameAtMost) {
  UnitBench u;
  EXPECT_TRUE(u.send({0xFF, ':', 0x00, ':', ':', 1, 129}).empty()) << "LEN above 128: hunt again";
  EXPECT_TRUE(u.send({':', ':', 1, 1}).empty()) << "LEN 1: hunt again";
  EXPECT_EQ(u.send(kPing), kPingReply);
}

TEST(Receiving, AWrongChecksumAndAnUnknownCommandAreAnsweredBySilence) {
  UnitBench u;
  EXPECT_TRUE(u.send({':', ':', 1, 2, 0, 1}).empty());
  for (int command = 0; command < 256; ++command) {
    const bool known = command <= 12 || (command >= 128 && command <= 137) || command == 143 || command == 144;
    if (known && command != 2 && command != 7 && command != 8 && command != 136) continue;
    const auto c = static_cast<std::uint8_t>(command);
    EXPECT_TRUE(u.send({':', ':', 1, 2, c, c}).empty()) << command;
  }
}

TEST(Receiving, FramesForOthersAreSkippedByCountWhateverTheyHold) {
  UnitBench u;
  Bytes other{':', ':', 2, 8};
  other.insert(other.end(), kPing.begin(), kPing.end());
  other.insert(other.end(), {0, 0});
  EXPECT_TRUE(u.send(other).empty());
  EXPECT_EQ(u.send(kPing), kPingReply);
}

TEST(Receiving, ABroadcastIsExecutedAndAnsweredWithTheUnitsOwnId) {
  UnitBench u;
  EXPECT_EQ(u.send({':', ':', 0, 2, 0, 0}), kPingReply);
}

TEST(Receiving, AQuestionMarkLineOutsideAFrameAsksForTheInfoText) {
  UnitBench u;
  const Bytes text = u.send({'?', '\r', '\n'});
  ASSERT_GT(text.size(), 500U);
  EXPECT_EQ(std::string(text.begin(), text.begin() + 20), "\r\nFirmware version: ");
}

TEST(Receiving, ShortFramesAreExecutedWithWhatEarlierFramesLeft) {
  UnitBench u;
  u.request(bus::SetInputs{{vsa::Ticks{100}, vsa::Ticks{200}}});
  EXPECT_EQ(u.state.loop.ref_new[0], 200);
  // Only CMD and CHK: the checksum and the old bytes are the inputs.
  EXPECT_TRUE(u.send({':', ':', 1, 2, 130, 130}).empty());
  EXPECT_EQ(u.state.loop.ref_new[0], -30000) << "130·256 + 100 as a negative number, clamped";
  EXPECT_EQ(u.state.loop.ref_new[1], 400);

  UnitBench repaired(with({.short_frames_refused = true}));
  repaired.request(bus::SetInputs{{vsa::Ticks{100}, vsa::Ticks{200}}});
  repaired.send({':', ':', 1, 2, 130, 130});
  EXPECT_EQ(repaired.state.loop.ref_new[0], 200);
}

TEST(Receiving, BytesThatComeDuringAStoreWaitAndAreHandledAfterIt) {
  UnitBench u;
  ASSERT_TRUE(u.stores());
  const std::int64_t busy_until_ns = u.state.busy_until_ns;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(u.send(kPing).empty());
  ASSERT_EQ(u.program.wake_ns(u.state), busy_until_ns);
  EXPECT_TRUE(u.poll().empty()) << "not yet";
  u.wait_for_store();
  EXPECT_EQ(u.poll().size(), 5 * kPingReply.size());
  EXPECT_FALSE(u.program.wake_ns(u.state).has_value());
}

TEST(Receiving, ABufferThatRanOverIsClearedByTheNextTick) {
  UnitBench u;
  ASSERT_TRUE(u.stores());
  for (int i = 0; i < 7; ++i) u.send(kPing);  // 42 bytes into 32
  EXPECT_TRUE(u.state.buffer.overflow);
  u.wait_for_store();
  u.tick();
  EXPECT_TRUE(u.state.buffer.empty());
  u.now_ns = u.state.busy_until_ns;
  u.state.receiver = {};
  EXPECT_EQ(u.send(kPing), kPingReply);
}

TEST(Receiving, RepliesInOnePollFollowOneAnother) {
  UnitBench u;
  ASSERT_TRUE(u.stores());
  u.send(kPing);
  u.send(kPing);
  u.wait_for_store();
  u.out.clear();
  u.program.poll(u.state, u.now_ns, u.out);
  ASSERT_EQ(u.out.count, 2);
  EXPECT_EQ(u.out.replies[0].delay_ns, 0);
  EXPECT_EQ(u.out.replies[1].delay_ns, 30'000) << "six bytes at 2 Mbaud";
}

TEST(Receiving, TheBaudRateChangesAtOnceAndTheEventSaysSo) {
  UnitBench u;
  EXPECT_TRUE(u.request(bus::SetBaudRate{13}).empty());
  EXPECT_TRUE(u.out.baud_changed);
  EXPECT_NEAR(baud_Hz(u.state.baud_divider), 460800, 800);
  u.request(bus::SetBaudRate{99});
  EXPECT_EQ(baud_Hz(u.state.baud_divider), 2e6);
}

TEST(Receiving, TheBootloaderAcknowledgesAndThenTheUnitIsSilentUntilPowerComesBack) {
  UnitBench u;
  EXPECT_EQ(u.ask(bus::Bootloader{}), bus::Acknowledgement{true});
  EXPECT_TRUE(u.state.in_bootloader);
  EXPECT_TRUE(u.send(kPing).empty());
  u.program.power_up(u.state, u.now_ns);
  EXPECT_EQ(u.send(kPing), kPingReply);
}

/// CyDelay(1000) twice between its answer and the other program.
TEST(Receiving, ForTwoSecondsTheBootloaderLeavesBridgesAndPwmAsTheyAre) {
  UnitBench u;
  u.state.enable = 3;
  u.state.loop.duty = {100, -100};
  EXPECT_EQ(u.ask(bus::Bootloader{}), bus::Acknowledgement{true});
  const std::int64_t begun_ns = u.now_ns;
  const auto at = [&](std::int64_t ns) {
    u.program.tick(u.state, {}, ns, u.out);
    return u.program.drive(u.state);
  };
  EXPECT_EQ(at(begun_ns + 1'990'000'000).duty_pct, (std::array<std::int32_t, 2>{100, -100}));
  EXPECT_TRUE(at(begun_ns + 1'990'000'000).enabled[0]);
  EXPECT_EQ(at(begun_ns + 2'010'000'000).duty_pct, (std::array<std::int32_t, 2>{}));
  EXPECT_FALSE(at(begun_ns + 2'010'000'000).enabled[0]);
}

}  // namespace
