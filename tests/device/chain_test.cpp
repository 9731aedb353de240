// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/chain.hpp"

#include <gtest/gtest.h>

#include <random>

#include "device/chain_rig.hpp"
#include "vsa/bus/parameters.hpp"
#include "vsa/state_io.hpp"
#include "vsa/state_walk.hpp"

namespace {

using namespace vsa;
using vsa::test::Bytes;
using vsa::test::ChainRig;

constexpr std::int64_t kByte = 5'000'000;  // ps at 2 Mbaud

std::vector<double> numbers_of(const firmware::ProgramState& program) {
  state::Sizer sizer;
  state::walk_fields(sizer, program);
  std::vector<double> out(sizer.size());
  state::Writer writer(out);
  state::walk_fields(writer, program);
  return out;
}

TEST(Chain, AnswersStartWhenTheRequestEndsAndTakeTheirTimeOnTheWire) {
  ChainRig rig(3);
  rig.say(0, 2, bus::GetMeasurements{});
  rig.run_to(1'000'000);
  ASSERT_EQ(rig.host.heard.size(), 12U);
  for (int k = 0; k < 12; ++k) EXPECT_EQ(rig.host.heard[static_cast<std::size_t>(k)].end_ps, (6 + k + 1) * kByte);
  ASSERT_EQ(rig.frames().size(), 1U);
  EXPECT_EQ(rig.frames()[0].id, 2);
}

TEST(Chain, TheTurnAroundComesBetween) {
  device::LineConfig line;
  line.turn_around_ps = 7'000'000;
  ChainRig rig(1, line);
  rig.say(0, 1, bus::Ping{});
  rig.run_to(1'000'000);
  ASSERT_EQ(rig.host.heard.size(), 6U);
  EXPECT_EQ(rig.host.heard[0].end_ps, 7 * kByte + 7'000'000);
}

TEST(Chain, AReferenceArrivesWithTheFramesLastBitAndNotBefore) {
  ChainRig rig(2);
  rig.say(0, 2, bus::SetInputs{{Ticks{100}, Ticks{-100}}});
  rig.chain.run_to(49'999, rig.host);
  EXPECT_EQ(rig.states[1].loop.ref_new[0], 0);
  rig.chain.run_to(50'000, rig.host);
  EXPECT_EQ(rig.states[1].loop.ref_new[0], 200);
  EXPECT_EQ(rig.states[0].loop.ref_new[0], 0) << "another's frame";
}

TEST(Chain, WhatAUnitSaysIsHeardByTheOthersAndSkipped) {
  ChainRig rig(3);
  rig.say(0, 1, bus::GetMeasurements{});
  rig.run_to(500'000);
  EXPECT_EQ(rig.states[1].buffer.write, (6 + 12) % 32);
  EXPECT_EQ(rig.states[0].buffer.write, 6) << "not by itself";
  EXPECT_EQ(rig.states[1].receiver.wanted, 8) << "the answer's LEN, skipped by count";
}

TEST(Chain, ABroadcastSetReachesAllAndABroadcastGetIsHeardAsTheAndOfAll) {
  ChainRig rig(3);
  rig.say(0, 0, bus::SetInputs{{Ticks{50}, Ticks{60}}});
  rig.say(1'000'000, 0, bus::Ping{});
  rig.run_to(3'000'000);
  for (const auto& s : rig.states) EXPECT_EQ(s.loop.ref_new[1], 120);
  const Bytes expected{':', ':', 1 & 2 & 3, 2, 0, 0};
  EXPECT_EQ(rig.host.bytes(), expected);
}

TEST(Chain, DifferentAnswersToABroadcastAreHeardAsTheirAndAndTheLineRecovers) {
  ChainRig rig(2);
  rig.states[1].memory.stored.id = rig.states[1].memory.current.id = 255;
  rig.run_to(2'000'000);
  rig.states[1].loop.meas_old = {-2, -2, -2};  // 0xFFFF in ticks: the other's bits remain
  rig.say(2'100'000, 0, bus::GetMeasurements{});
  rig.say(2'900'000, 1, bus::GetMeasurements{});
  rig.run_to(4'000'000);
  ASSERT_EQ(rig.host.heard.size(), 24U);
  const Bytes all = rig.host.bytes();
  const Bytes collided(all.begin(), all.begin() + 11), alone(all.begin() + 12, all.end() - 1);
  EXPECT_EQ(collided, alone) << "the AND with ones is the other one";
}

TEST(Chain, TwoSpeakersWithAShiftSpoilEachOther) {
  ChainRig rig(2);
  rig.say(0, 1, bus::GetMeasurements{});
  rig.say(37'000, 2, bus::Ping{});  // into the answer
  rig.say(900'000, 2, bus::Ping{});
  rig.run_to(1'000'000);
  const auto frames = rig.frames();
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames.back().id, 2) << "the last one, alone again, is fine";
  for (const bus::Frame& f : frames) EXPECT_FALSE(f.id == 1 && f.command() == 132) << "spoilt";
}

TEST(Chain, LongAnswersAreHeardWholeAndDisturbNobody) {
  ChainRig rig(12);
  rig.say(0, 3, bus::GetParameterList{});
  rig.say(7'000'000, 5, bus::GetInfo{});
  rig.say(20'000'000, 7, bus::GetMeasurements{});
  rig.run_to(6'500'000);
  const Bytes list = rig.host.bytes();
  ASSERT_EQ(list.size(), bus::kListBytesSix);
  EXPECT_TRUE(bus::decode_parameter_list({}, list).has_value());
  EXPECT_EQ(rig.host.heard.back().end_ps, (8 + static_cast<std::int64_t>(list.size())) * kByte);
  rig.run_to(22'000'000);
  const Bytes all = rig.host.bytes();
  EXPECT_NE(std::string(all.begin(), all.end()).find("Max stiffness: 3000"), std::string::npos);
  ASSERT_FALSE(rig.frames().empty());
  EXPECT_EQ(rig.frames().back().id, 7);
}

TEST(Chain, AnIdChangesByASetAndAStoreAndTheAnswerStillHasTheOldOne) {
  ChainRig rig(2);
  rig.say(0, 2, *bus::encode_value(bus::ParameterId::id, std::uint8_t{9}));
  rig.say(200'000, 2, bus::StoreParameters{});
  rig.say(100'000'000, 2, bus::Ping{});
  rig.say(101'000'000, 9, bus::Ping{});
  rig.run_to(99'000'000);
  ASSERT_EQ(rig.frames().size(), 1U);
  EXPECT_EQ(rig.frames()[0].id, 2);
  EXPECT_GE(rig.host.heard.back().end_ps, 70'000'000'000) << "seven rows of EEPROM";
  rig.run_to(102'000'000);
  ASSERT_EQ(rig.frames().size(), 2U) << "nobody is 2 any more";
  EXPECT_EQ(rig.frames()[1].id, 9);
}

TEST(Chain, AStoringUnitLetsItsBytesWaitAndTheOthersAnswer) {
  ChainRig rig(2);
  rig.say(0, 1, bus::StoreParameters{});
  rig.say(1'000'000, 1, bus::Ping{});
  rig.say(2'000'000, 2, bus::Ping{});
  rig.run_to(60'000'000);
  ASSERT_EQ(rig.frames().size(), 1U);
  EXPECT_EQ(rig.frames()[0].id, 2);
  rig.run_to(80'000'000);
  ASSERT_EQ(rig.frames().size(), 3U);
  EXPECT_EQ(rig.frames()[1].command(), 1) << "acknowledgement of the store";
  EXPECT_EQ(rig.frames()[2].command(), 0) << "then the ping";
}

TEST(Chain, AUnitWithoutPowerIsSilentAndComesBackAsAfterAPowerUp) {
  ChainRig rig(2);
  rig.run_to(1'000'000);
  rig.states[0].enable = 3;
  device::Wiring off;
  off.powered = false;
  rig.chain.set_wiring(0, off, 1);
  rig.say(1'500'000, 1, bus::Ping{});
  rig.say(1'700'000, 2, bus::Ping{});
  rig.run_to(3'000'000);
  ASSERT_EQ(rig.frames().size(), 1U);
  EXPECT_EQ(rig.frames()[0].id, 2);
  rig.chain.set_wiring(0, {}, 1);
  EXPECT_EQ(rig.states[0].enable, 0) << "motors off until someone activates them";
  rig.say(3'500'000, 1, bus::Ping{});
  rig.run_to(4'000'000);
  EXPECT_EQ(rig.frames().size(), 2U);
}

TEST(Chain, LateAnswersComeLateByThatMuch) {
  ChainRig rig(1);
  device::Wiring late;
  late.late_ns = 3'000'000;
  rig.chain.set_wiring(0, late, 1);
  rig.say(0, 1, bus::Ping{});
  rig.run_to(5'000'000);
  ASSERT_EQ(rig.host.heard.size(), 6U);
  EXPECT_EQ(rig.host.heard.back().end_ps, 3'000'000'000 + 12 * kByte);
}

TEST(Chain, FlippedAndLostBytesCostAboutTheAnswersThatTheirProbabilitySays) {
  const auto answered = [](device::Wiring wiring, std::uint64_t seed) {
    ChainRig rig(1);
    rig.chain.set_wiring(0, wiring, seed);
    for (int n = 0; n < 2000; ++n) rig.say(n * 1'000'000LL, 1, bus::Ping{});
    rig.run_to(2'001'000'000);
    return rig.frames().size();
  };
  EXPECT_EQ(answered({}, 1), 2000U);
  device::Wiring flips, losses;
  flips.flipped_byte = losses.lost_byte = 0.02;
  // A ping and its answer are twelve bytes: 0.98¹² = 0.785. A flip in the answer's ID passes the checksum.
  EXPECT_NEAR(static_cast<double>(answered(flips, 1)), 2000 * 0.785, 120);
  EXPECT_LT(answered(losses, 1), 1700U);
  EXPECT_GT(answered(losses, 1), 1000U);
  EXPECT_EQ(answered(flips, 7), answered(flips, 7)) << "the same seed, the same faults";
}

TEST(Chain, AfterAnyGarbageEveryUnitAnswersAgain) {
  std::mt19937 rng(5);
  for (int round = 0; round < 20; ++round) {
    ChainRig rig(4);
    std::int64_t at = 0;
    for (int n = 0; n < 40; ++n) {
      Bytes noise(1 + rng() % 100);
      for (auto& b : noise) b = rng() % 5 == 0 ? ':' : static_cast<std::uint8_t>(rng());
      rig.say_bytes(at, noise);
      at += 5000 * static_cast<std::int64_t>(noise.size()) + static_cast<std::int64_t>(rng() % 300'000);
    }
    // Longer than the longest frame that may be under way, longer than a calibration or ten stores.
    at += 20'000'000'000;
    rig.say_bytes(at, Bytes(130, 0));
    for (std::size_t i = 0; i < 4; ++i)
      rig.say(at + 2'000'000 + 1'000'000 * static_cast<int>(i), rig.states[i].memory.current.id, bus::Ping{});
    rig.run_to(at);
    rig.host.script.clear();
    rig.host.heard.clear();
    int silent = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& s = rig.states[i];
      if (s.in_bootloader || s.baud_divider != 3) ++silent;
    }
    if (silent != 0) continue;
    rig.say_bytes(at, Bytes(130, 0));
    for (std::size_t i = 0; i < 4; ++i) {
      rig.set_id(i, static_cast<std::uint8_t>(i + 1));
      rig.say(at + 2'000'000 + 1'000'000 * static_cast<int>(i), static_cast<int>(i) + 1, bus::Ping{});
    }
    rig.run_to(at + 8'000'000);
    EXPECT_EQ(rig.frames().size(), 4U) << round;
  }
}

TEST(Chain, ACopiedLineGoesOnBitForBit) {
  ChainRig a(3), b(3);
  device::Wiring bad;
  bad.flipped_byte = 0.1;
  for (ChainRig* r : {&a, &b}) {
    r->chain.set_wiring(1, bad, 3);
    for (int n = 0; n < 400; ++n) r->say(n * 150'000LL, n % 4, bus::GetMeasurements{});
  }
  a.run_to(20'037'000);
  b.host.script = a.host.script;
  b.states = a.states;
  b.chain.restore(a.chain.state());
  b.next_tick_ns = a.next_tick_ns;
  a.host.heard.clear();
  a.run_to(70'000'000);
  b.run_to(70'000'000);
  EXPECT_GT(a.host.bytes().size(), 500U);
  EXPECT_EQ(a.host.bytes(), b.host.bytes());
}

/// Somebody who looks at states now and then. Ticks come to those only whom a random number hits, so that what passes a station waits
/// for long.
struct Keeper final : device::ProgramKeeper {
  void changes(std::size_t /*station*/) noexcept override {}
  void open(std::size_t) noexcept override { ++opened; }
  int opened = 0;
};

TEST(Chain, WhatPassesAStationIsKnownToItWhenItIsAsked) {
  for (unsigned seed = 1; seed < 40; ++seed) {
    std::mt19937 rng(seed);
    const auto draw = [&rng](unsigned below) { return static_cast<int>(rng() % below); };
    ChainRig eager(5), lazy(5);
    Keeper keeper;
    lazy.chain.set_keeper(keeper);
    const auto both = [&](auto&& does) { does(eager), does(lazy); };
    std::int64_t at = 0;
    for (int n = 0; n < 600; ++n) {
      const int id = draw(12) == 0 ? draw(8) : 1 + draw(5), what = draw(40), x = draw(1000);
      // Of 40: mostly the master's cycle; now and then what changes who hears what, noise, two at once.
      both([&](ChainRig& r) {
        if (what < 16) r.say(at, id, bus::SetInputs{{Ticks{static_cast<std::int16_t>(x)}, Ticks{100}}});
        if (what >= 16 && what < 32) r.say(at, id, bus::GetMeasurements{});
        if (what == 32) r.say(at, id, bus::Ping{});
        if (what == 33) r.say_bytes(at, Bytes(static_cast<std::size_t>(1 + x % 9), static_cast<std::uint8_t>(x)));
        if (what == 34) r.say(at, id, bus::SetWatchdog{static_cast<std::uint8_t>(x % 3)});
        if (what == 35) r.say(at, id, bus::Activate{static_cast<std::uint8_t>(x % 4)});
      });
      at += what == 36 ? 20'000 : 250'000 + 1000 * static_cast<std::int64_t>(draw(400));
      if (draw(20) == 0) at += 45'000'000;  // a clock of the watchdogs
      const auto whose = static_cast<std::size_t>(draw(5));
      const bool ticks = draw(3) == 0, looks = draw(7) == 0;
      const std::int64_t by_ns = x % 2 == 0 ? 30'000'000 : -30'000'000;
      both([&](ChainRig& r) {
        r.chain.run_to(at, r.host);
        if (ticks) r.chain.tick(whose, r.in, at);
        if (what == 37) r.chain.set_wiring(whose, {x % 3 != 0, x % 7 == 1 ? 0.05 : 0.0, 0.0, x % 5 == 1 ? 900'000 : 0}, 3);
        if (what == 38) {
          r.chain.shift_time(by_ns);
          for (auto& [start_ps, frame] : r.host.script) start_ps += 1000 * by_ns;
        }
        if (what == 39) {
          r.chain.look_anew();
          r.set_id(whose, static_cast<std::uint8_t>(1 + x % 6));
        }
      });
      if (what == 38) at += by_ns;
      if (!looks) continue;
      lazy.chain.show(whose);
      ASSERT_EQ(numbers_of(lazy.states[whose]), numbers_of(eager.states[whose])) << "seed " << seed << ", " << n;
    }
    for (std::size_t i = 0; i < 5; ++i) {
      lazy.chain.show(i);
      EXPECT_EQ(numbers_of(lazy.states[i]), numbers_of(eager.states[i])) << "seed " << seed;
    }
    EXPECT_EQ(lazy.host.bytes(), eager.host.bytes()) << "seed " << seed;
    EXPECT_GT(keeper.opened, 100);
  }
}

TEST(Chain, StepsOfAnyLengthHearTheSame) {
  const auto heard = [](std::int64_t step_ns) {
    ChainRig rig(4);
    device::Wiring bad;
    bad.flipped_byte = 0.01;
    rig.chain.set_wiring(2, bad, 9);
    for (int n = 0; n < 300; ++n) rig.say(n * 120'000LL, n % 5, bus::GetMeasurements{});
    for (std::int64_t t = 0; t <= 40'000'000; t += step_ns) rig.run_to(t);
    return rig.host.bytes();
  };
  const Bytes coarse = heard(1'000'000);
  EXPECT_GT(coarse.size(), 1000U);
  EXPECT_EQ(heard(13'000), coarse);
  EXPECT_EQ(heard(4'000'000), coarse);
}

TEST(Chain, ALineWhoseTimeIsSetHearsTheSameLaterOrEarlier) {
  const auto heard = [](std::int64_t by_ns) {
    ChainRig rig(2);
    std::int64_t t = 0;
    const auto shift = [&] {
      rig.chain.shift_time(by_ns);
      rig.next_tick_ns += by_ns;
      t += by_ns;
    };
    std::vector<std::pair<int, std::int64_t>> out;
    const auto until = [&](std::int64_t ns) {
      rig.run_to(t + ns);
      for (const auto& h : rig.host.heard) out.emplace_back(h.byte, h.end_ps - 1000 * t);
      rig.host.heard.clear();
    };
    shift();  // before anybody spoke
    rig.say(t, 1, bus::SetBaudRate{13});
    rig.say(t + 500'000, 2, bus::Ping{});
    until(510'000);
    EXPECT_EQ(rig.chain.state().mode, device::ChainState::Mode::bits) << "two rates on the line";
    shift();  // in the middle of the ping
    until(1'500'000);
    rig.say(t + 1'600'000, 2, bus::GetMeasurements{});
    until(2'500'000);
    return out;
  };
  const auto there = heard(0);
  EXPECT_GT(there.size(), 15U);
  EXPECT_EQ(heard(-3'000'000), there);
  EXPECT_EQ(heard(7'000'000), there);
}

TEST(Chain, AUnitThatWasSetToAnotherRateIsHeardAtThatRateOnly) {
  ChainRig rig(2);
  rig.say(0, 1, bus::SetBaudRate{13});
  rig.say(500'000, 1, bus::Ping{});
  rig.say(1'500'000, 2, bus::Ping{});
  rig.run_to(2'500'000);
  ASSERT_EQ(rig.frames().size(), 1U);
  EXPECT_EQ(rig.frames()[0].id, 2);
  rig.chain.set_master_rate({460'800});
  rig.host.heard.clear();
  rig.say_bytes(3'000'000, Bytes(130, 0x55));  // whatever the two rates made of it before
  rig.say(7'000'000, 1, bus::Ping{});
  rig.run_to(9'000'000);
  ASSERT_FALSE(rig.frames().empty());
  EXPECT_EQ(rig.frames().back().id, 1);
}

}  // namespace
