// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Golden frames, to and from unit 7. Requests were recorded from NMMI/qbAPI's own functions (named in each line) on a
// pseudo-terminal, outside the repository, with the arguments that the message shows; those of dialect seven are written by hand
// from qbdevice-api 7.2.8's serializePackage. Replies are written by hand from the cmd_… functions of NMMI/qbmove-maker-pro 6.1:
// field offsets as there, values big-endian, CHK the XOR of all bytes after LEN.
#include <gtest/gtest.h>

#include "bus/hex.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/bus/parameters.hpp"

namespace {

using namespace vsa::bus;
using vsa::Ticks;
using vsa_test::hex;
using vsa_test::unhex;

constexpr std::uint8_t kId = 7;
constexpr Wire kSix{};
constexpr Wire kSixRepaired{Dialect::six, true};
constexpr Wire kSeven{Dialect::seven};

Frame received(const std::string& text) {
  UnitReceiver unit;
  ReceiverEvent last = ReceiverEvent::none;
  for (const std::uint8_t b : unhex(text)) last = unit.push(b, kId);
  EXPECT_EQ(last, ReceiverEvent::frame) << text;
  return unit.frame;
}

SetParameter value(ParameterId id, const ParameterValue& v) { return encode_value(id, v).value(); }

struct GoldenRequest {
  const char* source;
  Wire wire;
  Request request;
  const char* bytes;
};

std::vector<GoldenRequest> requests() {
  const std::array<Ticks, 2> inputs{Ticks{4551}, Ticks{-4551}};  // ±50° at 32768 per turn
  return {
      {"commPing", kSix, Ping{}, "3A 3A 07 02 00 00"},
      {"commSetZeros", kSix, SetZeros{{{Ticks{1}, Ticks{-2}, Ticks{300}}}}, "3A 3A 07 08 01 00 01 FF FE 01 2C 2C"},
      {"commStoreParams", kSix, StoreParameters{}, "3A 3A 07 02 03 03"},
      {"commStoreDefaultParams", kSix, StoreDefaults{}, "3A 3A 07 02 04 04"},
      {"commRestoreParams", kSix, RestoreDefaults{}, "3A 3A 07 02 05 05"},
      {"commGetInfo", kSix, GetInfo{0}, "3A 3A 07 04 06 00 00 06"},
      {"commBootloader", kSix, Bootloader{}, "3A 3A 07 02 09 09"},
      {"commInitMem", kSix, InitMemory{}, "3A 3A 07 02 0A 0A"},
      {"commCalibrate", kSix, Calibrate{}, "3A 3A 07 02 0B 0B"},
      {"commGetParamList, index 0", kSix, GetParameterList{}, "3A 3A 07 04 0C 00 00 0C"},
      {"commGetParamList, index 1", kSix, value(ParameterId::id, std::uint8_t{9}), "3A 3A 07 05 0C 00 01 09 04"},
      {"commGetParamList, index 2", kSix, value(ParameterId::position_pid, std::array<float, 3>{0.1F, 0.0F, 0.8F}),
       "3A 3A 07 10 0C 00 02 3D CC CC CD 00 00 00 00 3F 4C CC CD 8C"},
      {"commGetParamList, index 11", kSix, value(ParameterId::limits, std::array<std::int32_t, 4>{-15000, 15000, -15000, 15000}),
       "3A 3A 07 14 0C 00 0B FF FF C5 68 00 00 3A 98 FF FF C5 68 00 00 3A 98 07"},
      {"commActivate, on", kSix, Activate{3}, "3A 3A 07 03 80 03 83"},
      {"commActivate, off", kSix, Activate{0}, "3A 3A 07 03 80 00 80"},
      {"commGetActivate", kSix, GetActivate{}, "3A 3A 07 02 81 81"},
      {"commSetInputs", kSix, SetInputs{inputs}, "3A 3A 07 06 82 11 C7 EE 39 83"},
      {"commGetInputs", kSix, GetInputs{}, "3A 3A 07 02 83 83"},
      {"commGetMeasurements", kSix, GetMeasurements{}, "3A 3A 07 02 84 84"},
      {"commGetCurrents", kSix, GetCurrents{}, "3A 3A 07 02 85 85"},
      {"commGetCurrAndMeas", kSix, GetCurrentsAndMeasurements{}, "3A 3A 07 02 86 86"},
      {"commSetPosStiff", kSix, SetPositionStiffness{Ticks{1000}, -16384}, "3A 3A 07 06 87 03 E8 C0 00 AC"},
      {"commGetVelocities", kSix, GetVelocities{}, "3A 3A 07 02 89 89"},
      {"commSetWatchDog, 1000: it sends half, modulo 256", kSix, SetWatchdog{0xF4}, "3A 3A 07 03 8F F4 7B"},
      {"commSetBaudRate, 460 800", kSix, SetBaudRate{13}, "3A 3A 07 03 90 0D 9D"},
      {"commSetBaudRate, 2 000 000", kSix, SetBaudRate{3}, "3A 3A 07 03 90 03 93"},
      {"setParamZeros", kSeven, SetZeros{std::nullopt}, "3A 3A 07 02 01 01"},
      {"setControlReferencesAndWait", kSeven, SetInputsAcknowledged{inputs}, "3A 3A 07 06 93 11 C7 EE 39 92"},
      {"getCycleTime", kSeven, GetCycleTime{}, "3A 3A 07 02 96 96"},
      {"setParamRateLimiter", kSeven, value(ParameterId::rate_limiter, std::uint8_t{2}), "3A 3A 07 05 0C 00 0E 02 00"},
      {"setParamSerialNumber", kSeven, value(ParameterId::serial_number, std::uint32_t{0x00980001}),
       "3A 3A 07 08 0C 00 0F 00 98 00 01 9A"},
  };
}

TEST(GoldenFrames, RequestsAreTheBytesThatPublicHostLibrariesSend) {
  for (const auto& g : requests()) EXPECT_EQ(hex(encode_request(g.wire, kId, g.request).view()), g.bytes) << g.source;
}

TEST(GoldenFrames, AUnitReadsTheseBytesAsTheRequest) {
  for (const auto& g : requests()) {
    const Frame frame = received(g.bytes);
    const auto request = decode_request(g.wire, frame);
    ASSERT_TRUE(request.has_value()) << g.source;
    EXPECT_TRUE(complete(g.wire, frame)) << g.source;
    if (const auto* set = std::get_if<SetParameter>(&*request)) {
      const auto& sent = std::get<SetParameter>(g.request);
      EXPECT_EQ(set->index, sent.index);
      EXPECT_EQ(set->value_bytes, sent.value_bytes);
      EXPECT_EQ(decode_value(g.wire.dialect, *set), decode_value(g.wire.dialect, sent)) << g.source;
    } else {
      EXPECT_EQ(*request, g.request) << g.source;
    }
  }
}

/// Both ways: `reply` as bytes, and the bytes as `reply` (or as `read`, where the wire loses something).
template <class R>
void expect_reply(Wire wire, Command command, const R& reply, const char* bytes, const R& read) {
  EXPECT_EQ(hex(encode_reply(wire, kId, reply).view()), bytes);
  EXPECT_EQ(decode_reply<R>(wire, command, received(bytes)), read) << bytes;
}
template <class R>
void expect_reply(Wire wire, Command command, const R& reply, const char* bytes) {
  expect_reply(wire, command, reply, bytes, reply);
}

TEST(GoldenFrames, APingAnswersItselfOrTheSerialNumber) {
  expect_reply(kSix, Command::ping, PingReply{}, "3A 3A 07 02 00 00");
  expect_reply(kSeven, Command::ping, PingReply{0x00980001}, "3A 3A 07 06 00 00 98 00 01 99");
}

TEST(GoldenFrames, AnAcknowledgementIsAValueTwiceOrCommandAndValue) {
  const auto bytes = [](Wire w, bool ok, Command of) { return hex(encode_reply(w, kId, Acknowledgement{ok}, of).view()); };
  EXPECT_EQ(bytes(kSix, true, Command::store_parameters), "3A 3A 07 02 01 01");
  EXPECT_EQ(bytes(kSix, false, Command::store_parameters), "3A 3A 07 02 00 00");  // looks like a ping's answer
  EXPECT_EQ(bytes(kSeven, true, Command::store_parameters), "3A 3A 07 03 03 01 02");
  EXPECT_EQ(bytes(kSeven, false, Command::store_parameters), "3A 3A 07 03 03 00 03");
  EXPECT_EQ(bytes(kSeven, true, Command::parameters), "3A 3A 07 03 0C 01 0D");
  EXPECT_EQ(bytes(kSeven, true, Command::set_inputs_acknowledged), "3A 3A 07 03 93 01 92");
  const auto read = [](Wire w, Command c, const char* text) { return decode_reply<Acknowledgement>(w, c, received(text)); };
  EXPECT_EQ(read(kSix, Command::calibrate, "3A 3A 07 02 01 01"), Acknowledgement{true});
  EXPECT_EQ(read(kSix, Command::calibrate, "3A 3A 07 02 00 00"), Acknowledgement{false});
  EXPECT_EQ(read(kSix, Command::calibrate, "3A 3A 07 02 0B 0B"), std::nullopt);
  EXPECT_EQ(read(kSeven, Command::parameters, "3A 3A 07 03 0C 01 0D"), Acknowledgement{true});
  EXPECT_EQ(read(kSeven, Command::calibrate, "3A 3A 07 03 0C 01 0D"), std::nullopt);
}

TEST(GoldenFrames, AnswersToTheGets) {
  for (const Wire wire : {kSix, kSixRepaired, kSeven}) {
    expect_reply(wire, Command::get_activate, ActivationReply{3}, "3A 3A 07 03 81 03 82");
    expect_reply(wire, Command::get_inputs, InputsReply{{Ticks{4551}, Ticks{-4551}}}, "3A 3A 07 06 83 11 C7 EE 39 82");
    expect_reply(wire, Command::get_measurements, MeasurementsReply{{Ticks{4551}, Ticks{-4551}, Ticks{12}}},
                 "3A 3A 07 08 84 11 C7 EE 39 00 0C 89");
    expect_reply(wire, Command::get_currents, CurrentsReply{{250, -317}}, "3A 3A 07 06 85 00 FA FE C3 42");
  }
  expect_reply(kSeven, Command::get_cycle_time, CycleTimeReply{0, 1000}, "3A 3A 07 06 96 00 00 03 E8 7D");
}

TEST(GoldenFrames, CurrentsAndPositionsComeInFirmwareSixsLayoutUnlessRepaired) {
  const CurrentsAndMeasurementsReply reply{{250, -317}, {Ticks{4551}, Ticks{-4551}, Ticks{12}}};
  CurrentsAndMeasurementsReply without_shaft = reply;
  without_shaft.positions[2] = Ticks{0};
  const char* packed = "3A 3A 07 0C 86 00 FA FE C3 11 C7 EE 39 00 0C 4C";
  const char* broken = "3A 3A 07 0C 86 00 FA FE C3 11 C7 00 00 EE 39 40";
  expect_reply(kSix, Command::get_currents_and_measurements, reply, broken, without_shaft);
  expect_reply(kSixRepaired, Command::get_currents_and_measurements, reply, packed);
  expect_reply(kSeven, Command::get_currents_and_measurements, reply, packed);
  // What a public client, which reads the packed layout, takes from the broken one: motor 1, zero, motor 2.
  const auto misread =
      decode_reply<CurrentsAndMeasurementsReply>(kSixRepaired, Command::get_currents_and_measurements, received(broken));
  EXPECT_EQ(misread->positions, (std::array<Ticks, 3>{Ticks{4551}, Ticks{0}, Ticks{-4551}}));
}

TEST(GoldenFrames, VelocitiesHaveTheSameBrokenLayout) {
  expect_reply(kSix, Command::get_velocities, VelocitiesReply{{1, 2, 3}}, "3A 3A 07 08 89 00 01 00 00 00 02 8A",
               VelocitiesReply{{1, 2, 0}});
  expect_reply(kSixRepaired, Command::get_velocities, VelocitiesReply{{1, 2, 3}}, "3A 3A 07 08 89 00 01 00 02 00 03 89");
}

TEST(GoldenFrames, InfoIsRawTextOrALongPacket) {
  std::vector<std::uint8_t> out(200);
  const std::string text = "\r\nID: 7\r\n";
  ASSERT_EQ(encode_info(kSix, kId, text, out), text.size());
  EXPECT_EQ(std::string(out.begin(), out.begin() + 9), text);
  // CMD, 9 bytes, CHK: one unit of 32.
  ASSERT_EQ(encode_info(kSeven, kId, text, out), 4U + 32U);
  EXPECT_EQ(hex(std::span{out}.first(15)), "3A 3A 07 01 06 0D 0A 49 44 3A 20 37 0D 0A 00");
  EXPECT_EQ(checksum(std::span{out}.subspan(4, 32)), 0);
  EXPECT_EQ(encode_info(kSeven, kId, std::string(30, 'x'), out), 4U + 32U);
  EXPECT_EQ(encode_info(kSeven, kId, std::string(31, 'x'), out), 4U + 64U);
  EXPECT_EQ(encode_info(kSeven, kId, std::string(197, 'x'), out), 0U);
  EXPECT_EQ(encode_info(kSix, kId, std::string(201, 'x'), out), 0U);
}

TEST(GoldenFrames, DialectSixKnowsNoneOfSevensCommandsAndNobodyKnowsTheRest) {
  for (int c = 0; c < 256; ++c) {
    const auto frame = encode_frame(kId, static_cast<std::uint8_t>(c), {});
    const Frame f = received(hex(frame.view()));
    const bool seven_only = c == 147 || c == 150;
    const bool both =
        c <= 1 || (c >= 3 && c <= 6) || (c >= 9 && c <= 12) || (c >= 128 && c <= 135) || c == 137 || c == 143 || c == 144;
    EXPECT_EQ(decode_request(kSix, f).has_value(), both) << c;
    EXPECT_EQ(decode_request(kSeven, f).has_value(), both || seven_only) << c;
  }
}

TEST(GoldenFrames, WhatIsAnsweredAndHow) {
  const auto kind = [](Wire w, const Request& r) { return reply_kind(w, r); };
  for (const Request& r : {Request{Activate{3}}, Request{SetInputs{}}, Request{SetPositionStiffness{}}, Request{SetWatchdog{}},
                           Request{SetBaudRate{}}, Request{GetInfo{1}}})
    for (const Wire w : {kSix, kSeven}) EXPECT_EQ(kind(w, r), ReplyKind::none);
  EXPECT_EQ(kind(kSix, SetParameter{}), ReplyKind::none);
  EXPECT_EQ(kind(kSeven, SetParameter{}), ReplyKind::frame);
  EXPECT_EQ(kind(kSix, GetInfo{0}), ReplyKind::info);
  EXPECT_EQ(kind(kSix, GetParameterList{}), ReplyKind::parameter_list);
  EXPECT_EQ(kind(kSix, SetZeros{}), ReplyKind::frame);
  EXPECT_EQ(kind(kSeven, SetInputsAcknowledged{}), ReplyKind::frame);
}

}  // namespace
