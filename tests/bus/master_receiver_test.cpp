// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bus/hex.hpp"
#include "vsa/bus/frame.hpp"

namespace {

using namespace vsa::bus;
using vsa_test::hex;
using vsa_test::unhex;
using Bytes = std::vector<std::uint8_t>;

std::vector<Frame> frames_of(MasterReceiver& host, std::span<const std::uint8_t> bytes) {
  std::vector<Frame> frames;
  Frame frame;
  while (!bytes.empty()) {
    const std::size_t taken = host.push(bytes);
    bytes = bytes.subspan(taken);
    while (host.next(frame)) frames.push_back(frame);
    if (taken == 0 && host.room() == 0) break;
  }
  return frames;
}

const Bytes kMeasurements = unhex("3A 3A 07 08 84 11 C7 EE 39 00 0C 89");
const Bytes kPing = unhex("3A 3A 08 02 00 00");

TEST(MasterReceiver, FindsFramesOfAnyIdHoweverTheyAreCut) {
  Bytes stream = kMeasurements;
  stream.insert(stream.end(), kPing.begin(), kPing.end());
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    MasterReceiver host;
    auto frames = frames_of(host, std::span{stream}.first(cut));
    for (const Frame& f : frames_of(host, std::span{stream}.subspan(cut))) frames.push_back(f);
    ASSERT_EQ(frames.size(), 2U) << cut;
    EXPECT_EQ(frames[0].id, 7);
    EXPECT_EQ(hex(frames[0].payload()), "11 C7 EE 39 00 0C");
    EXPECT_EQ(frames[1].id, 8);
    EXPECT_EQ(host.dropped(), 0U);
  }
}

TEST(MasterReceiver, FindsTheFrameBehindEveryBeginningOfAnother) {
  for (std::size_t part = 1; part < kMeasurements.size(); ++part) {
    Bytes stream(kMeasurements.begin(), kMeasurements.begin() + static_cast<std::ptrdiff_t>(part));
    stream.insert(stream.end(), kPing.begin(), kPing.end());
    MasterReceiver host;
    auto frames = frames_of(host, stream);
    Frame frame;
    while (frames.empty() && host.give_up())
      while (host.next(frame)) frames.push_back(frame);
    ASSERT_EQ(frames.size(), 1U) << part;
    EXPECT_EQ(frames[0].id, 8) << part;
    EXPECT_EQ(host.dropped(), part);
  }
}

TEST(MasterReceiver, AcceptsOnlyRightChecksumsAndLosesNoFrameBehindNoise) {
  std::mt19937 random(5);
  constexpr int kTries = 2000;
  int intact = 0;
  for (int t = 0; t < kTries; ++t) {
    Bytes stream(random() % 300);
    for (auto& b : stream) b = random() % 3 == 0 ? std::uint8_t{':'} : static_cast<std::uint8_t>(random());
    stream.insert(stream.end(), kMeasurements.begin(), kMeasurements.end());
    MasterReceiver host;
    auto frames = frames_of(host, stream);
    Frame frame;
    do {
      while (host.next(frame)) frames.push_back(frame);
    } while (host.give_up());
    std::size_t accepted = 0;
    for (const Frame& f : frames) {
      ASSERT_EQ(checksum(std::span{f.body}.first(f.length)), 0);
      accepted += f.length + kHeaderBytes;
    }
    ASSERT_EQ(accepted + host.dropped(), stream.size());
    ASSERT_FALSE(frames.empty());
    intact += frames.back().id == 7 && hex(frames.back().payload()) == "11 C7 EE 39 00 0C";
  }
  // Every time, but where noise passes for a frame by chance (one of 256 headers) and swallows it.
  EXPECT_GT(intact, kTries * 19 / 20);
}

}  // namespace
