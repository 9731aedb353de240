// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The client on a channel with its own clock: a bench unit that answers from a table, late, twice, in pieces, with noise, or not at
// all.
#include "vsa/bus/client.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <random>

namespace {

using namespace vsa::bus;
using vsa::Ticks;
using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

/// A channel of scheduled bytes. Time passes only by waiting for them.
class BenchChannel : public Channel {
 public:
  Wire wire{};
  std::uint8_t id = 7;
  std::optional<std::uint8_t> answers_as;  ///< another id in replies
  Time delay = 1ms;
  std::size_t piece = 1000;  ///< bytes a read gives at most
  Bytes noise_before;
  int deaf = 0;  ///< requests to ignore
  bool open = true;
  bool stored_ok = true;
  ParameterValues values;
  std::string text = "\r\nID: 7\r\n";
  std::vector<Request> heard;

  bool write(std::span<const std::uint8_t> bytes) override {
    if (!open) return false;
    for (const std::uint8_t b : bytes)
      if (unit_.push(b, id) == ReceiverEvent::frame) execute(unit_.frame);
    return true;
  }

  std::optional<std::size_t> read(std::span<std::uint8_t> into, Time timeout) override {
    if (!open) return std::nullopt;
    if (pending_.empty() || pending_.front().first > now_ + timeout) {
      now_ += timeout;
      return 0;
    }
    now_ = std::max(now_, pending_.front().first);
    std::size_t count = 0;
    while (count < std::min(into.size(), piece) && !pending_.empty() && pending_.front().first <= now_) {
      into[count++] = pending_.front().second;
      pending_.pop_front();
    }
    return count;
  }

  Time now() const override { return now_; }

  void say(std::span<const std::uint8_t> bytes, Time after) {
    for (const std::uint8_t b : bytes) pending_.emplace_back(now_ + after, b);
  }

 private:
  void execute(const Frame& frame) {
    if (deaf > 0) {
      --deaf;
      return;
    }
    const auto request = decode_request(wire, frame);
    if (!request) return;
    heard.push_back(*request);
    say(noise_before, delay);
    const std::uint8_t from = answers_as.value_or(id);
    switch (reply_kind(wire, *request)) {
      case ReplyKind::none:
        return;
      case ReplyKind::info: {
        Bytes out(4096);
        out.resize(encode_info(wire, from, text, out));
        return say(out, delay);
      }
      case ReplyKind::parameter_list: {
        Bytes out(kMaxListBytes);
        out.resize(encode_parameter_list(wire, from, values, out));
        return say(out, delay);
      }
      case ReplyKind::frame:
        return say(reply(*request, from).view(), delay);
    }
  }

  FrameBytes reply(const Request& request, std::uint8_t from) const {
    return std::visit(
        [&](const auto& r) -> FrameBytes {
          using R = typename std::decay_t<decltype(r)>::Reply;
          if constexpr (std::is_same_v<R, Acknowledgement>)
            return encode_reply(wire, from, Acknowledgement{stored_ok}, std::decay_t<decltype(r)>::code);
          else if constexpr (std::is_same_v<R, NoReply> || std::is_same_v<R, StreamReply>)
            return {};
          else if constexpr (std::is_same_v<R, PingReply>)
            return encode_reply(wire, from, PingReply{1234});
          else if constexpr (std::is_same_v<R, ActivationReply>)
            return encode_reply(wire, from, ActivationReply{3});
          else if constexpr (std::is_same_v<R, MeasurementsReply>)
            return encode_reply(wire, from, MeasurementsReply{{Ticks{1}, Ticks{2}, Ticks{3}}});
          else if constexpr (std::is_same_v<R, CurrentsReply>)
            return encode_reply(wire, from, CurrentsReply{{10, -20}});
          else
            return encode_reply(wire, from, R{});
        },
        request);
  }

  UnitReceiver unit_;
  std::deque<std::pair<Time, std::uint8_t>> pending_;
  Time now_ = 0ns;
};

ClientOptions options_for(const BenchChannel& channel) {
  ClientOptions options;
  options.wire = channel.wire;
  return options;
}

const Wire kWires[] = {{Dialect::six}, {Dialect::six, true, true}, {Dialect::seven}};

TEST(Client, TalksToAUnitInEveryDialect) {
  for (const Wire& wire : kWires) {
    BenchChannel channel;
    channel.wire = wire;
    channel.values.current_limit = 1500;
    channel.values.multipliers = {1, 1, 1};
    Client client(channel, options_for(channel));
    EXPECT_EQ(client.ping(7)->serial_number, wire.dialect == Dialect::seven ? 1234U : 0U);
    EXPECT_EQ(*client.dialect(7), wire.dialect);
    EXPECT_TRUE(client.activate(7, true));
    EXPECT_TRUE(*client.active(7));
    EXPECT_TRUE(client.set_inputs(7, {Ticks{5}, Ticks{-5}}));
    EXPECT_EQ(std::get<SetInputs>(channel.heard.back()).inputs[1], Ticks{-5});
    EXPECT_EQ(client.measurements(7)->positions[2], Ticks{3});
    EXPECT_EQ(client.currents(7)->currents_mA[1], -20);
    EXPECT_EQ(*client.info(7), channel.text);
    EXPECT_EQ(*client.parameters(7), channel.values);
    EXPECT_TRUE(client.set_parameter(7, ParameterId::current_limit, std::int16_t{900}));
    EXPECT_EQ(std::get<SetParameter>(channel.heard.back()).index, 13);
    EXPECT_TRUE(client.store(7));
    EXPECT_TRUE(client.acknowledge(7, Calibrate{}));
  }
}

TEST(Client, TellsSilenceRefusalAndAClosedPortApart) {
  BenchChannel channel;
  Client client(channel, options_for(channel));
  EXPECT_EQ(client.ping(8).error(), ClientError::timeout);
  EXPECT_EQ(channel.now(), 20ms);
  channel.stored_ok = false;
  EXPECT_EQ(client.store(7).error(), ClientError::refused);
  EXPECT_EQ(client.set_parameter(7, ParameterId::id, std::int16_t{3}).error(), ClientError::bad_value);
  EXPECT_EQ(client.set_parameter(7, ParameterId::rate_limiter, std::uint8_t{3}).error(), ClientError::bad_value);
  const std::size_t sent = channel.heard.size();
  EXPECT_EQ(sent, 1U);  // the store; nothing of the bad values
  channel.open = false;
  EXPECT_EQ(client.ping(7).error(), ClientError::closed);
  EXPECT_EQ(client.info(7).error(), ClientError::closed);
  EXPECT_EQ(client.scan(1, 3, 3ms).error(), ClientError::closed);
}

TEST(Client, AsksAgainAsOftenAsItIsTold) {
  BenchChannel channel;
  ClientOptions options = options_for(channel);
  options.attempts = 3;
  Client client(channel, options);
  channel.deaf = 2;
  EXPECT_TRUE(client.ping(7));
  EXPECT_EQ(channel.now(), 41ms);
  channel.deaf = 3;
  EXPECT_EQ(client.ping(7).error(), ClientError::timeout);
}

TEST(Client, TakesAnAnswerInPiecesBehindNoiseAndOtherUnitsFrames) {
  for (std::size_t piece = 1; piece < 40; ++piece) {
    for (const Wire& wire : kWires) {
      BenchChannel channel;
      channel.wire = wire;
      channel.piece = piece;
      const auto other = encode_reply(wire, 9, MeasurementsReply{});
      channel.noise_before = {0x00, ':', 0x12, ':', ':'};  // "::" then ':' ':' of the answer: a header of id 58, LEN 58
      channel.noise_before.insert(channel.noise_before.begin(), other.view().begin(), other.view().end());
      Client client(channel, options_for(channel));
      ASSERT_EQ(client.measurements(7)->positions[0], Ticks{1}) << piece;
      ASSERT_TRUE(client.parameters(7)) << piece;
    }
  }
}

TEST(Client, ThrowsAwayWhatCameBeforeItAsked) {
  BenchChannel channel;
  channel.say(encode_reply({}, 7, MeasurementsReply{{Ticks{99}, Ticks{99}, Ticks{99}}}).view(), 0ms);
  Client client(channel, options_for(channel));
  EXPECT_EQ(client.measurements(7)->positions[0], Ticks{1});
}

TEST(Client, AcceptsAnotherIdWhereACommandMayChangeIt) {
  BenchChannel channel;
  channel.answers_as = 1;
  Client client(channel, options_for(channel));
  EXPECT_TRUE(client.acknowledge(7, InitMemory{}));
  EXPECT_TRUE(client.acknowledge(7, RestoreDefaults{}));
  EXPECT_EQ(client.store(7).error(), ClientError::timeout);
  EXPECT_EQ(client.measurements(7).error(), ClientError::timeout);
}

TEST(Client, FindsUnitsByScanning) {
  BenchChannel channel;
  Client client(channel, options_for(channel));
  EXPECT_EQ(*client.scan(0, 255, 3ms), Bytes{7});
  EXPECT_EQ(channel.now(), 254 * 3ms + 1ms);
}

TEST(Client, TheWrongDialectIsToldFromSilence) {
  BenchChannel channel;
  channel.wire.dialect = Dialect::seven;
  Client client(channel, {});
  EXPECT_EQ(client.ping(7).error(), ClientError::malformed);
}

TEST(Client, AFloodedLineEndsInAnErrorNotInWaiting) {
  BenchChannel channel;
  std::mt19937 random(4);
  for (int ms = 0; ms < 5000; ++ms) {
    Bytes noise(20);
    for (auto& b : noise) b = static_cast<std::uint8_t>(random() % 2 ? ':' : random());
    channel.say(noise, ms * 1ms);
  }
  channel.deaf = 1000;
  Client client(channel, options_for(channel));
  EXPECT_EQ(client.measurements(7).error(), ClientError::timeout);
  EXPECT_LE(channel.now(), 25ms);
  EXPECT_EQ(client.parameters(7).error(), ClientError::timeout);
  EXPECT_LE(channel.now(), 2100ms);
  EXPECT_EQ(client.info(7).error(), ClientError::malformed);
}

}  // namespace
