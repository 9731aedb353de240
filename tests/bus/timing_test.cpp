// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/timing.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "vsa/bus/codec.hpp"

namespace {

using namespace vsa::bus;
using Bytes = std::vector<std::uint8_t>;

constexpr LineRate kFast{};
constexpr std::int64_t kByte = 5'000'000;  // ps at 2 Mbaud
constexpr std::int64_t kBit = kByte / 10;

std::vector<HeardByte> heard(const std::vector<Burst>& speakers, LineRate rate = kFast) {
  LineReceiver receiver{rate};
  std::vector<HeardByte> out(1000);
  out.resize(listen(receiver, speakers, out));
  return out;
}

Bytes values(const std::vector<HeardByte>& all) {
  Bytes bytes;
  for (const HeardByte& h : all) bytes.push_back(h.value);
  return bytes;
}

TEST(WireTime, OfTheMessagesAtTwoMegabaud) {
  EXPECT_EQ(kFast.bytes_ps(1), kByte);
  EXPECT_EQ(kFast.bytes_ps(static_cast<std::int64_t>(encode_request({}, 1, SetInputs{}).size)), 50'000'000);
  EXPECT_EQ(exchange_ps(kFast, 6, 0, 12), 90'000'000);
  EXPECT_EQ(exchange_ps(kFast, 6, 20'000'000, 16), 130'000'000);
  EXPECT_EQ(exchange_ps(kFast, 10, 20'000'000, 0), 50'000'000);
}

TEST(WireTime, DoesNotDriftWhereABitIsNoWholeNumberOfPicoseconds) {
  const LineRate slow{460'800};
  EXPECT_EQ(slow.bits_ps(1), 2'170'139);
  EXPECT_EQ(slow.bits_ps(460'800), kPicosecondsPerSecond);
  EXPECT_EQ(slow.bytes_ps(46'080), kPicosecondsPerSecond);
}

TEST(Line, OneSpeakerIsHeardAsItSpoke) {
  std::mt19937 random(1);
  for (const std::int64_t baud : {115'200, 460'800, 2'000'000}) {
    Bytes bytes(300);
    for (auto& b : bytes) b = static_cast<std::uint8_t>(random());
    const std::int64_t start = 123'456'789;
    const auto all = heard({{start, bytes, LineRate{baud}}}, LineRate{baud});
    ASSERT_EQ(values(all), bytes);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_FALSE(all[i].framing_error);
      EXPECT_NEAR(static_cast<double>(all[i].end_ps - start),
                  static_cast<double>(LineRate{baud}.bytes_ps(static_cast<std::int64_t>(i) + 1)), 2);
    }
  }
}

TEST(Line, SpeakersOneAfterTheOtherAreBothHeard) {
  const Bytes first{1, 2, 3}, second{4, 5};
  EXPECT_EQ(values(heard({{0, first}, {3 * kByte, second}})), (Bytes{1, 2, 3, 4, 5}));
  EXPECT_FALSE(overlap({0, first}, {3 * kByte, second}));
  EXPECT_TRUE(overlap({0, first}, {3 * kByte - 1, second}));
}

TEST(Line, BytesThatStartTogetherAreHeardAsTheirAnd) {
  const Bytes a{0xFF, 0xF0, 0x3A}, b{0x0F, 0xAA, 0x3A};
  const auto all = heard({{0, a}, {0, b}});
  EXPECT_EQ(values(all), (Bytes{0x0F, 0xA0, 0x3A}));
  for (const HeardByte& h : all) EXPECT_FALSE(h.framing_error);
}

TEST(Line, ADelayedSpeakerShiftsTheFraming) {
  // 0xFF is one low bit and nine high; the same byte four bits later pulls data bit 3 (the fourth) low.
  const Bytes ff{0xFF};
  EXPECT_EQ(values(heard({{0, ff}, {4 * kBit, ff}})), Bytes{0xF7});
  // Nine bits later it lies on the stop bit: a framing error, and the edge is spent.
  const auto all = heard({{0, ff}, {9 * kBit, ff}});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].value, 0xFF);
  EXPECT_TRUE(all[0].framing_error);
}

TEST(Line, AGlitchShorterThanHalfABitIsNoStartBit) {
  const LineRate faster{8'000'000};
  const Bytes ff{0xFF};
  EXPECT_TRUE(heard({{0, ff, faster}}, kFast).empty());
}

TEST(Line, AnotherRateIsGarbledNotHeard) {
  const Bytes request{0x3A, 0x3A, 7, 2, 0, 0};
  const auto all = heard({{0, request, LineRate{460'800}}}, kFast);
  EXPECT_FALSE(all.empty());
  EXPECT_NE(values(all), request);
}

TEST(Line, ALongLowIsOneFramingError) {
  const Bytes zeros{0, 0, 0};  // at a tenth of the rate: nine low bits are 90 of ours
  const auto all = heard({{0, zeros, LineRate{200'000}}}, kFast);
  ASSERT_EQ(all.size(), 3U);
  for (const HeardByte& h : all) EXPECT_TRUE(h.framing_error);
}

TEST(Line, TheOrderInWhichSpeakersAreListedDoesNotMatter) {
  std::mt19937 random(2);
  for (int t = 0; t < 300; ++t) {
    std::vector<Bytes> bytes(3, Bytes(8));
    std::vector<Burst> speakers;
    for (Bytes& b : bytes) {
      for (auto& x : b) x = static_cast<std::uint8_t>(random());
      speakers.push_back({static_cast<std::int64_t>(random() % (4 * kByte)), b});
    }
    const auto all = heard(speakers);
    std::swap(speakers[0], speakers[2]);
    ASSERT_EQ(heard(speakers), all);
    // Nobody is heard outside the time in which someone speaks, nor more than fits in it.
    ASSERT_LE(all.size(), 3U * 8U + 1);
    for (const HeardByte& h : all) ASSERT_LE(h.end_ps, 13 * kByte);
  }
}

TEST(Line, HearingItInPiecesIsHearingItAtOnce) {
  std::mt19937 random(3);
  for (int t = 0; t < 200; ++t) {
    Bytes a(10), b(10);
    for (auto& x : a) x = static_cast<std::uint8_t>(random());
    for (auto& x : b) x = static_cast<std::uint8_t>(random());
    const std::vector<Burst> speakers{{0, a}, {static_cast<std::int64_t>(random() % (12 * kByte)), b}};
    LineReceiver receiver;
    std::vector<HeardByte> pieces, out(3);
    for (std::int64_t until = 0; until < 40 * kByte; until += static_cast<std::int64_t>(random() % kByte)) {
      while (const std::size_t n = listen(receiver, speakers, out, until)) {
        for (std::size_t i = 0; i < n; ++i) {
          ASSERT_LE(out[i].end_ps, until);
          pieces.push_back(out[i]);
        }
      }
    }
    ASSERT_EQ(pieces, heard(speakers));
  }
}

/// Replies of several units to one broadcast request, `spread_ps` apart, as the host's receiver takes them.
std::vector<Frame> broadcast_replies(const std::vector<FrameBytes>& replies, std::int64_t spread_ps) {
  std::vector<Burst> speakers;
  for (std::size_t i = 0; i < replies.size(); ++i)
    speakers.push_back({static_cast<std::int64_t>(i) * spread_ps, replies[i].view()});
  MasterReceiver host;
  std::vector<Frame> frames;
  Frame frame;
  for (const HeardByte& h : heard(speakers)) {
    if (!h.framing_error) host.push({&h.value, 1});
    while (host.next(frame)) frames.push_back(frame);
  }
  return frames;
}

TEST(Line, RepliesOfAChainToABroadcastGetDestroyEachOther) {
  const auto reply = [](std::uint8_t id, std::int16_t at) {
    const vsa::Ticks t{at};
    return encode_reply({}, id, MeasurementsReply{{t, t, t}});
  };
  const std::vector<FrameBytes> replies{reply(1, 1000), reply(2, -3333), reply(3, 12345)};
  // Apart by more than a frame all three are heard; together none of them.
  EXPECT_EQ(broadcast_replies(replies, 12 * kByte).size(), 3U);
  for (const std::int64_t spread : {std::int64_t{0}, kBit / 3, kBit, 7 * kBit, kByte, 3 * kByte + kBit})
    for (const Frame& f : broadcast_replies(replies, spread))
      for (const FrameBytes& r : replies) {
        const bool whole = r.bytes[2] == f.id && std::equal(f.payload().begin(), f.payload().end(), r.bytes.begin() + 5);
        // The last to speak may still be heard whole if the receiver finds the frame again; at these delays it doesn't.
        EXPECT_FALSE(whole) << spread;
      }
}

TEST(Line, EqualPingsAtTheSameInstantAreHeardAsOneUnitWithTheAndOfTheIds) {
  const auto frames = broadcast_replies({encode_reply({}, 6, PingReply{}), encode_reply({}, 3, PingReply{})}, 0);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].id, 6 & 3);
}

}  // namespace
