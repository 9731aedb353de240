// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Any bytes into everything of `bus` that reads bytes: the unit's receiver and request decoder, the host's receiver and reply
// decoders, the parameter list, the line model and the client. A broken invariant traps. How to run: CMakeLists.txt here.
#include <algorithm>
#include <array>
#include <vector>

#include "vsa/bus/client.hpp"
#include "vsa/bus/timing.hpp"

namespace {

using namespace vsa::bus;
using Input = std::span<const std::uint8_t>;

void require(bool ok) {
  if (!ok) __builtin_trap();
}

/// What the unit accepts has a right sum; a request that LEN covers exactly goes back to the same bytes.
void check_request(Wire wire, const Frame& frame) {
  require(frame.length >= kMinLength && frame.length <= kMaxLength);
  require(checksum(std::span{frame.body}.first(frame.length)) == 0);
  const auto request = decode_request(wire, frame);
  if (!request) return;
  (void)reply_kind(wire, *request);
  if (const auto* set = std::get_if<SetParameter>(&*request)) {
    const auto value = decode_value(wire.dialect, *set);
    if (value) require(encode_value(static_cast<ParameterId>(set->index), *value).has_value());
  }
  const FrameBytes again = encode_request(wire, frame.id, *request);
  require(!again.overflowed && again.size >= kHeaderBytes + kMinLength);
  if (complete(wire, frame) && again.size == kHeaderBytes + frame.length)
    require(std::equal(again.bytes.begin() + kHeaderBytes, again.bytes.begin() + again.size, frame.body.begin()));
}

void unit_side(Wire wire, std::uint8_t id, Input bytes) {
  UnitReceiver unit;
  for (const std::uint8_t b : bytes) {
    const UnitReceiver before = unit;
    UnitReceiver copy = before;
    const ReceiverEvent event = unit.push(b, id);
    require(copy.push(b, id) == event && copy == unit);
    if (event == ReceiverEvent::frame) check_request(wire, unit.frame);
  }
}

void host_side(Wire wire, Input bytes) {
  MasterReceiver host;
  Frame frame;
  std::size_t accepted = 0;
  const auto take = [&] {
    while (host.next(frame)) {
      accepted += kHeaderBytes + frame.length;
      require(checksum(std::span{frame.body}.first(frame.length)) == 0);
      const auto command = static_cast<Command>(frame.command());
      (void)decode_reply<PingReply>(wire, command, frame);
      (void)decode_reply<Acknowledgement>(wire, command, frame);
      (void)decode_reply<MeasurementsReply>(wire, command, frame);
      (void)decode_reply<CurrentsAndMeasurementsReply>(wire, command, frame);
      (void)decode_reply<VelocitiesReply>(wire, command, frame);
      (void)decode_reply<CycleTimeReply>(wire, command, frame);
    }
  };
  for (Input left = bytes; !left.empty();) {
    left = left.subspan(host.push(left));
    take();
  }
  while (host.give_up()) take();
  require(accepted + host.dropped() == bytes.size());
}

void list_side(Wire wire, Input bytes) {
  for (std::uint16_t i = 0; i < 20; ++i)
    if (const auto slot = read_slot(bytes, i)) require(slot->values.size() + slot->text.size() <= kSlotBytes);
  const auto values = decode_parameter_list(wire, bytes);
  if (!values) return;
  std::array<std::uint8_t, kMaxListBytes> out{};
  const std::size_t n = encode_parameter_list(wire, 1, *values, out);
  require(decode_parameter_list(wire, std::span{out}.first(n)).has_value());
}

/// Three speakers share the bytes; the first one says when they begin.
void line_side(Input bytes) {
  if (bytes.size() < 6) return;
  const Input head = bytes.first(3), rest = bytes.subspan(3, std::min<std::size_t>(bytes.size() - 3, 60));
  std::vector<Burst> speakers;
  for (std::size_t i = 0; i < 3; ++i)
    speakers.push_back({head[i] * std::int64_t{123'457}, rest.subspan(i * rest.size() / 3, rest.size() / 3),
                        LineRate{head[i] % 7 == 0 ? 460'800 : 2'000'000}});
  LineReceiver receiver;
  std::array<HeardByte, 7> heard{};
  std::size_t total = 0;
  while (const std::size_t n = listen(receiver, speakers, heard)) total += n;
  require(total <= 60 * 5 + 3);
}

/// Says the input, whatever it is asked.
class ParrotChannel : public Channel {
 public:
  explicit ParrotChannel(Input bytes) : bytes_(bytes) {}
  bool write(Input) override {
    said_ = 0;
    asked_ = true;
    return true;
  }
  std::optional<std::size_t> read(std::span<std::uint8_t> into, Time timeout) override {
    if (!asked_ || timeout == Time::zero() || said_ == bytes_.size()) {
      now_ += timeout;
      return 0;
    }
    const std::size_t n = std::min({into.size(), bytes_.size() - said_, std::size_t{7}});
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(said_), n, into.begin());
    said_ += n;
    now_ += std::chrono::microseconds(35);
    return n;
  }
  Time now() const override { return now_; }

 private:
  Input bytes_;
  std::size_t said_ = 0;
  bool asked_ = false;
  Time now_{};
};

void client_side(Wire wire, std::uint8_t id, Input bytes) {
  ParrotChannel channel(bytes);
  ClientOptions options;
  options.wire = wire;
  Client client(channel, options);
  (void)client.ping(id);
  (void)client.measurements(id);
  (void)client.store(id);
  (void)client.info(id);
  (void)client.parameters(id);
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const Wire wire{(data[0] & 1) != 0 ? Dialect::seven : Dialect::six, (data[0] & 2) != 0, (data[0] & 4) != 0};
  const std::uint8_t id = data[1];
  const Input bytes{data + 2, size - 2};
  unit_side(wire, id, bytes);
  host_side(wire, bytes);
  list_side(wire, bytes);
  line_side(bytes);
  client_side(wire, id, bytes);
  return 0;
}
