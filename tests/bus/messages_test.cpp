// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Any message comes back from the wire as it was.
#include "vsa/bus/messages.hpp"

#include <gtest/gtest.h>

#include <random>

#include "vsa/bus/bytes.hpp"
#include "vsa/bus/codec.hpp"

namespace {

using namespace vsa::bus;
using vsa::Ticks;

constexpr int kTries = 20'000;
const Wire kWires[] = {{Dialect::six}, {Dialect::six, true}, {Dialect::seven}};

class Random {
 public:
  std::uint8_t u8() { return static_cast<std::uint8_t>(engine_()); }
  std::int16_t i16() {
    constexpr std::int16_t corners[] = {0, 1, -1, 32767, -32768, 0x3A3A};
    return engine_() % 4 == 0 ? corners[engine_() % 6] : static_cast<std::int16_t>(engine_());
  }
  Ticks ticks() { return {i16()}; }
  std::uint32_t u32() { return static_cast<std::uint32_t>(engine_()); }

 private:
  std::mt19937 engine_{17};
};

Request any_request(Random& r, Wire wire) {
  switch (r.u32() % 13) {
    case 0:
      if (wire.dialect == Dialect::seven && r.u8() % 2 != 0) return SetZeros{std::nullopt};
      return SetZeros{{{r.ticks(), r.ticks(), r.ticks()}}};
    case 1:
      return GetInfo{static_cast<std::uint16_t>(r.i16())};
    case 2: {
      SetParameter set;
      set.index = static_cast<std::uint16_t>(1 + r.u8());
      set.value_bytes = static_cast<std::uint8_t>(r.u8() % 17);
      for (std::size_t i = 0; i < set.value_bytes; ++i) set.value[i] = r.u8();
      return set;
    }
    case 3:
      return Activate{r.u8()};
    case 4:
      return SetInputs{{r.ticks(), r.ticks()}};
    case 5:
      return SetPositionStiffness{r.ticks(), r.i16()};
    case 6:
      return SetWatchdog{r.u8()};
    case 7:
      return SetBaudRate{r.u8()};
    case 8:
      return Ping{};
    case 9:
      return GetParameterList{};
    case 10:
      return GetCurrentsAndMeasurements{};
    case 11:
      if (wire.dialect == Dialect::seven) return SetInputsAcknowledged{{r.ticks(), r.ticks()}};
      return Calibrate{};
    default:
      return StoreParameters{};
  }
}

TEST(Messages, AnyRequestComesBackThroughTheUnitsReceiver) {
  Random random;
  for (const Wire& wire : kWires) {
    UnitReceiver unit;
    for (int t = 0; t < kTries; ++t) {
      const std::uint8_t id = random.u8();
      const Request request = any_request(random, wire);
      const FrameBytes frame = encode_request(wire, id, request);
      ReceiverEvent event = ReceiverEvent::none;
      for (const std::uint8_t b : frame.view()) event = unit.push(b, id);
      ASSERT_EQ(event, ReceiverEvent::frame);
      ASSERT_EQ(unit.frame.id, id);
      auto back = decode_request(wire, unit.frame);
      ASSERT_TRUE(back.has_value());
      if (auto* set = std::get_if<SetParameter>(&*back))  // what lies behind the value is stale
        std::fill(set->value.begin() + set->value_bytes, set->value.end(), std::uint8_t{0});
      ASSERT_EQ(*back, request);
    }
  }
}

template <class R>
void expect_back(Wire wire, const R& reply, Command command) {
  const FrameBytes bytes = encode_reply(wire, 200, reply);
  MasterReceiver host;
  host.push(bytes.view());
  Frame frame;
  ASSERT_TRUE(host.next(frame));
  ASSERT_EQ(frame.id, 200);
  ASSERT_TRUE(answers(wire, command, frame));
  ASSERT_EQ(decode_reply<R>(wire, command, frame), reply);
}

TEST(Messages, AnyReplyComesBackThroughTheHostsReceiver) {
  Random r;
  for (const Wire& wire : kWires) {
    const bool lost = !wire.packed();  // the third value
    for (int t = 0; t < kTries; ++t) {
      if (wire.dialect == Dialect::seven) expect_back(wire, PingReply{r.u32()}, Command::ping);
      expect_back(wire, ActivationReply{r.u8()}, Command::get_activate);
      expect_back(wire, InputsReply{{r.ticks(), r.ticks()}}, Command::get_inputs);
      expect_back(wire, MeasurementsReply{{r.ticks(), r.ticks(), r.ticks()}}, Command::get_measurements);
      expect_back(wire, CurrentsReply{{r.i16(), r.i16()}}, Command::get_currents);
      expect_back(wire, CurrentsAndMeasurementsReply{{r.i16(), r.i16()}, {r.ticks(), r.ticks(), lost ? Ticks{} : r.ticks()}},
                  Command::get_currents_and_measurements);
      expect_back(wire, VelocitiesReply{{r.i16(), r.i16(), lost ? std::int16_t{0} : r.i16()}}, Command::get_velocities);
      expect_back(wire, CycleTimeReply{r.i16(), r.i16()}, Command::get_cycle_time);
    }
  }
}

template <class... Rs>
int decoded_of(Wire wire, Command command, const Frame& frame) {
  return (0 + ... + static_cast<int>(decode_reply<Rs>(wire, command, frame).has_value()));
}

TEST(Messages, RandomFramesAreDecodedOrRefusedButNeverHarm) {
  Random random;
  int requests = 0, replies = 0;
  for (int t = 0; t < 300'000; ++t) {
    Frame frame;
    for (auto& b : frame.body) b = random.u8();
    frame.length = static_cast<std::uint8_t>(random.u8() % 129);
    const Wire& wire = kWires[random.u8() % 3];
    const auto request = decode_request(wire, frame);
    if (request) {
      ++requests;
      ASSERT_LE(encode_request(wire, 1, *request).size, kMaxFrameBytes);
      (void)complete(wire, frame);
      (void)reply_kind(wire, *request);
    }
    replies +=
        decoded_of<PingReply, Acknowledgement, ActivationReply, InputsReply, MeasurementsReply, CurrentsReply,
                   CurrentsAndMeasurementsReply, VelocitiesReply, CycleTimeReply>(wire, static_cast<Command>(random.u8()), frame);
  }
  EXPECT_GT(requests, 10'000);
  EXPECT_GT(replies, 0);
}

TEST(Messages, AReplyOfAnotherLengthIsRefused) {
  for (std::size_t n = 0; n <= kMaxPayload; ++n) {
    const std::vector<std::uint8_t> payload(n, 1);
    UnitReceiver receiver;
    for (const std::uint8_t b : encode_frame(1, 132, payload)) (void)receiver.push(b, 1);
    EXPECT_EQ(decode_reply<MeasurementsReply>({}, Command::get_measurements, receiver.frame).has_value(), n == 6);
  }
}

TEST(Bytes, WritersAndReadersStopAtTheEndAndSaySo) {
  std::array<std::uint8_t, 3> room{};
  ByteWriter w{room};
  w.u32(0x01020304);
  EXPECT_TRUE(w.overflowed());
  EXPECT_EQ(w.size(), 3U);
  EXPECT_EQ(room[2], 3);
  ByteReader r{room};
  EXPECT_EQ(r.u16(), 0x0102);
  EXPECT_FALSE(r.overran());
  EXPECT_EQ(r.u16(), 0x0300);
  EXPECT_TRUE(r.overran());
}

}  // namespace
