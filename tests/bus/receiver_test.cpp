// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit's receiver against hand-made streams, and against a second reading of the rules on random bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bus/hex.hpp"
#include "vsa/bus/codec.hpp"

namespace {

using namespace vsa::bus;
using vsa_test::unhex;
using Event = ReceiverEvent;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kId = 7;

Bytes text(const std::string& s) { return {s.begin(), s.end()}; }

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes frame_for(std::uint8_t id, std::uint8_t command, const Bytes& payload = {}) {
  const FrameBytes f = encode_frame(id, command, payload);
  return {f.view().begin(), f.view().end()};
}

struct Seen {
  std::size_t at;
  Event event;
  Frame frame;  ///< set for Event::frame
};

std::vector<Seen> feed(UnitReceiver& unit, const Bytes& bytes, std::uint8_t id = kId) {
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (const Event e = unit.push(bytes[i], id); e != Event::none) seen.push_back({i, e, e == Event::frame ? unit.frame : Frame{}});
  return seen;
}

std::vector<Event> events(const Bytes& bytes) {
  UnitReceiver unit;
  std::vector<Event> all;
  for (const Seen& s : feed(unit, bytes)) all.push_back(s.event);
  return all;
}

const Bytes kPing = frame_for(kId, 0);
const Bytes kSetInputs = unhex("3A 3A 07 06 82 11 C7 EE 39 83");

TEST(UnitReceiver, AcceptsItsOwnIdAndBroadcastAndSkipsOthersByCount) {
  EXPECT_EQ(events(kPing), std::vector{Event::frame});
  EXPECT_EQ(events(frame_for(0, 132)), std::vector{Event::frame});
  EXPECT_EQ(events(frame_for(8, 132) + kPing), (std::vector{Event::skipped, Event::frame}));
  // What looks like a frame for it within another's payload is skipped with it.
  EXPECT_EQ(events(frame_for(8, 132, kPing) + kPing), (std::vector{Event::skipped, Event::frame}));
}

TEST(UnitReceiver, DropsAWrongChecksumInSilenceAndTakesTheNextFrame) {
  Bytes bad = kSetInputs;
  bad[5] ^= 0x10;
  EXPECT_EQ(events(bad + kSetInputs), (std::vector{Event::bad_checksum, Event::frame}));
  // Two equal errors in one column cancel: the XOR can't see them.
  bad[7] ^= 0x10;
  EXPECT_EQ(events(bad), std::vector{Event::frame});
}

TEST(UnitReceiver, TakesLengthsFromTwoToOneHundredTwentyEight) {
  EXPECT_EQ(events(unhex("3A 3A 07 00") + kPing), std::vector{Event::frame});
  EXPECT_EQ(events(unhex("3A 3A 07 01 00") + kPing), std::vector{Event::frame});
  EXPECT_EQ(events(frame_for(kId, 130, Bytes(126, 0x55)) + kPing), (std::vector{Event::frame, Event::frame}));
  EXPECT_EQ(events(unhex("3A 3A 07 81") + kPing), std::vector{Event::frame});
  EXPECT_EQ(events(unhex("3A 3A 08 FF") + kPing), std::vector{Event::frame});
  EXPECT_EQ(encode_frame(kId, 130, Bytes(127, 0)).size, 0);
}

TEST(UnitReceiver, TheLengthByteOfARefusedHeaderIsNotLookedAtAgain) {
  // LEN 0x3A is a length (58), so the third colon pair is needed: "::" ":" ":" would be ID 58 and LEN 58.
  UnitReceiver unit;
  EXPECT_TRUE(feed(unit, text("::::")).empty());
  EXPECT_EQ(unit.phase, UnitReceiver::Phase::skip);
  EXPECT_EQ(unit.wanted, 58);
  UnitReceiver own;
  EXPECT_TRUE(feed(own, text("::::"), 58).empty());
  EXPECT_EQ(own.phase, UnitReceiver::Phase::body);
}

TEST(UnitReceiver, AnswersAQuestionMarkWithLineEndOutsideFramesOnly) {
  EXPECT_EQ(events(text("?\r\n")), std::vector{Event::info_request});
  EXPECT_EQ(events(text("noise:?\r\n") + kPing), (std::vector{Event::info_request, Event::frame}));
  EXPECT_EQ(events(text("?\n")), std::vector<Event>{});
  EXPECT_EQ(events(frame_for(kId, 130, text("?\r\n"))), std::vector{Event::frame});
  EXPECT_EQ(events(frame_for(9, 130, text("?\r\n"))), std::vector{Event::skipped});
  EXPECT_FALSE(counts_toward_poll(Event::info_request));
}

TEST(UnitReceiver, FollowsTheIdThatTheUnitHasAtTheIdByte) {
  UnitReceiver unit;
  for (std::size_t i = 0; i < kPing.size(); ++i) {
    const Event e = unit.push(kPing[i], i == 2 ? kId : std::uint8_t{99});
    EXPECT_EQ(e, i + 1 == kPing.size() ? Event::frame : Event::none);
  }
}

TEST(UnitReceiver, CutAnywhereAndCopiedItGoesOn) {
  const Bytes stream = text("x?\r\n") + kSetInputs + frame_for(9, 132) + frame_for(0, 3) + text(":?\r\n") + kPing;
  UnitReceiver whole;
  const auto expected = feed(whole, stream);
  ASSERT_EQ(expected.size(), 6U);
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    UnitReceiver first;
    auto seen = feed(first, Bytes(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(cut)));
    UnitReceiver second = first;
    EXPECT_EQ(second, first);
    for (Seen s : feed(second, Bytes(stream.begin() + static_cast<std::ptrdiff_t>(cut), stream.end()))) {
      s.at += cut;
      seen.push_back(s);
    }
    ASSERT_EQ(seen.size(), expected.size()) << cut;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i].at, expected[i].at);
      EXPECT_EQ(seen[i].event, expected[i].event);
      EXPECT_EQ(seen[i].frame, expected[i].frame);
    }
  }
}

TEST(UnitReceiver, ShortRequestsReadWhatEarlierFramesLeft) {
  UnitReceiver unit;
  feed(unit, kSetInputs);
  feed(unit, frame_for(kId, 130));  // no payload: the buffer is 82 82 C7 EE 39 83
  EXPECT_FALSE(complete(Wire{}, unit.frame));
  const auto request = decode_request(Wire{}, unit.frame);
  const SetInputs expected{{vsa::Ticks{static_cast<std::int16_t>(0x82C7)}, vsa::Ticks{static_cast<std::int16_t>(0xEE39)}}};
  EXPECT_EQ(std::get<SetInputs>(*request), expected);
}

/// The rules once more, by index over the whole stream instead of state by state.
std::vector<std::pair<std::size_t, Event>> second_reading(const Bytes& s) {
  std::vector<std::pair<std::size_t, Event>> out;
  const auto at = [&s](std::size_t i) { return i < s.size() ? static_cast<int>(s[i]) : -1; };
  std::size_t fresh = 0;  // bytes before this one no longer take part in patterns
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (i >= fresh + 2 && at(i - 2) == '?' && at(i - 1) == '\r' && at(i) == '\n') out.push_back({i, Event::info_request});
    if (i < fresh + 1 || at(i - 1) != ':' || at(i) != ':') continue;
    const int id = at(i + 1), length = at(i + 2);
    if (length < 0) break;
    if (length < 2 || length > 128) {
      i += 2;
    } else {
      const std::size_t last = i + 2 + static_cast<std::size_t>(length);
      if (last >= s.size()) break;
      std::uint8_t sum = 0;
      for (std::size_t k = i + 3; k <= last; ++k) sum = static_cast<std::uint8_t>(sum ^ s[k]);
      const bool mine = id == kId || id == 0;
      out.push_back({last, !mine ? Event::skipped : sum == 0 ? Event::frame : Event::bad_checksum});
      i = last;
    }
    fresh = i + 1;
  }
  return out;
}

Bytes random_stream(std::uint32_t seed, std::size_t size, bool likely_frames) {
  std::mt19937 random(seed);
  const std::uint8_t common[] = {':', ':', ':', kId, 0, 2, 3, 8, '?', '\r', '\n', 200};
  Bytes bytes(size);
  for (std::uint8_t& b : bytes)
    b = likely_frames && random() % 4 != 0 ? common[random() % sizeof common] : static_cast<std::uint8_t>(random());
  return bytes;
}

TEST(UnitReceiver, AMillionRandomBytesAreReadAsTheRulesSay) {
  for (const bool likely : {false, true}) {
    const Bytes bytes = random_stream(likely ? 1 : 2, 1'000'000, likely);
    UnitReceiver unit;
    const auto seen = feed(unit, bytes);
    const auto expected = second_reading(bytes);
    ASSERT_EQ(seen.size(), expected.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      ASSERT_EQ(seen[i].at, expected[i].first);
      ASSERT_EQ(seen[i].event, expected[i].second);
    }
    EXPECT_GT(seen.size(), likely ? 10'000U : 5U);
  }
}

TEST(UnitReceiver, NoiseIsAcceptedAsOftenAsAnEightBitSumCantTell) {
  // Headers are right, bodies are random: 1 of 256 passes.
  std::mt19937 random(3);
  const int tries = 100'000;
  int accepted = 0;
  UnitReceiver unit;
  for (int t = 0; t < tries; ++t) {
    const std::uint8_t length = static_cast<std::uint8_t>(2 + random() % 127);
    Bytes bytes = {':', ':', kId, length};
    for (int i = 0; i < length; ++i) bytes.push_back(static_cast<std::uint8_t>(random()));
    for (const Seen& s : feed(unit, bytes)) {
      ASSERT_NE(s.event, Event::skipped);
      if (s.event == Event::frame) {
        ++accepted;
        ASSERT_EQ(checksum(std::span{s.frame.body}.first(s.frame.length)), 0);
      }
    }
  }
  const double expected = tries / 256.0;
  EXPECT_NEAR(accepted, expected, 5 * std::sqrt(expected));
}

TEST(UnitReceiver, AfterAnyNoiseAtMostOneLongFramesWorthOfRequestsIsLost) {
  const Bytes set = kSetInputs;
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    UnitReceiver unit;
    feed(unit, random_stream(seed, 50 + seed % 300, true));
    std::size_t lost = 0;
    while (feed(unit, set).empty() || unit.frame.command() != 130) ASSERT_LE(++lost, 128 / set.size() + 1) << seed;
    for (int i = 0; i < 3; ++i) {
      const auto seen = feed(unit, set);
      ASSERT_EQ(seen.size(), 1U);
      ASSERT_EQ(seen[0].event, Event::frame);
    }
  }
}

}  // namespace
