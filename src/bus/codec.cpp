// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/codec.hpp"

#include <algorithm>

#include "bus/long_packet.hpp"
#include "vsa/bus/bytes.hpp"

namespace vsa::bus {
namespace {

constexpr std::uint8_t kAckOk = 1, kAckError = 0;

/// A payload under construction, and the frame around it.
class Payload {
 public:
  ByteWriter& out() noexcept { return writer_; }
  [[nodiscard]] FrameBytes frame(std::uint8_t id, Command command) const noexcept {
    return encode_frame(id, static_cast<std::uint8_t>(command), {bytes_.data(), writer_.size()});
  }

 private:
  std::array<std::uint8_t, kMaxPayload> bytes_{};
  ByteWriter writer_{bytes_};
};

template <std::size_t N>
void write(ByteWriter& out, const std::array<Ticks, N>& values) noexcept {
  for (const Ticks t : values) out.i16(t.value);
}
template <std::size_t N>
void write(ByteWriter& out, const std::array<std::int16_t, N>& values) noexcept {
  for (const std::int16_t v : values) out.i16(v);
}

/// Three values with room for three. Firmware 6.1's index is doubled once too often: the second value lands in the third's place
/// and the third behind the packet's end. Two bytes are never written; what they hold on a unit isn't known, here they are 0.
void write_three(ByteWriter& out, bool packed, std::array<std::int16_t, 3> v) noexcept {
  write(out, packed ? v : std::array<std::int16_t, 3>{v[0], 0, v[1]});
}

std::array<std::int16_t, 3> read_three(ByteReader& in, bool packed) noexcept {
  const std::int16_t a = in.i16(), b = in.i16(), c = in.i16();
  return packed ? std::array<std::int16_t, 3>{a, b, c} : std::array<std::int16_t, 3>{a, c, 0};
}

template <std::size_t N>
std::array<Ticks, N> read_ticks(ByteReader& in) noexcept {
  std::array<Ticks, N> values{};
  for (Ticks& t : values) t.value = in.i16();
  return values;
}

/// The payload of a frame that carries `command` and exactly `bytes` of payload.
std::optional<ByteReader> payload_of(const Frame& frame, Command command, std::size_t bytes) noexcept {
  if (frame.command() != static_cast<std::uint8_t>(command) || frame.payload().size() != bytes) return std::nullopt;
  return ByteReader{frame.payload()};
}

}  // namespace

// ------------------------------------------------------------------------------------------------------------------ unit's side

FrameBytes encode_reply(Wire wire, std::uint8_t id, const PingReply& reply) noexcept {
  Payload p;
  if (wire.dialect == Dialect::seven) p.out().u32(reply.serial_number);
  return p.frame(id, Command::ping);
}

FrameBytes encode_reply(Wire wire, std::uint8_t id, const Acknowledgement& reply, Command of) noexcept {
  const std::uint8_t value = reply.ok ? kAckOk : kAckError;
  if (wire.dialect == Dialect::six) return encode_frame(id, value, {});
  return encode_frame(id, static_cast<std::uint8_t>(of), {&value, 1});
}

FrameBytes encode_reply(Wire, std::uint8_t id, const ActivationReply& reply) noexcept {
  return encode_frame(id, static_cast<std::uint8_t>(Command::get_activate), {&reply.flags, 1});
}

FrameBytes encode_reply(Wire, std::uint8_t id, const InputsReply& reply) noexcept {
  Payload p;
  write(p.out(), reply.inputs);
  return p.frame(id, Command::get_inputs);
}

FrameBytes encode_reply(Wire, std::uint8_t id, const MeasurementsReply& reply) noexcept {
  Payload p;
  write(p.out(), reply.positions);
  return p.frame(id, Command::get_measurements);
}

FrameBytes encode_reply(Wire, std::uint8_t id, const CurrentsReply& reply) noexcept {
  Payload p;
  write(p.out(), reply.currents_mA);
  return p.frame(id, Command::get_currents);
}

FrameBytes encode_reply(Wire wire, std::uint8_t id, const CurrentsAndMeasurementsReply& reply) noexcept {
  Payload p;
  write(p.out(), reply.currents_mA);
  write_three(p.out(), wire.packed(), {reply.positions[0].value, reply.positions[1].value, reply.positions[2].value});
  return p.frame(id, Command::get_currents_and_measurements);
}

FrameBytes encode_reply(Wire wire, std::uint8_t id, const VelocitiesReply& reply) noexcept {
  Payload p;
  write_three(p.out(), wire.packed(), reply.velocities);
  return p.frame(id, Command::get_velocities);
}

FrameBytes encode_reply(Wire, std::uint8_t id, const CycleTimeReply& reply) noexcept {
  Payload p;
  p.out().i16(reply.unknown);
  p.out().i16(reply.cycle_time);
  return p.frame(id, Command::get_cycle_time);
}

std::size_t info_bytes(Wire wire, std::size_t text_bytes) noexcept {
  if (wire.dialect == Dialect::six) return text_bytes;
  return kHeaderBytes + (text_bytes + kMinLength + kLongUnit - 1) / kLongUnit * kLongUnit;
}

std::size_t encode_info(Wire wire, std::uint8_t id, std::string_view text, std::span<std::uint8_t> out) noexcept {
  const std::size_t total = info_bytes(wire, text.size());
  const bool six = wire.dialect == Dialect::six;
  if (total > out.size() || (!six && total > kHeaderBytes + kLongUnit * 255)) return 0;
  ByteWriter w{out.first(total)};
  if (!six) {
    for (const std::uint8_t byte : {kStartByte, kStartByte, id, static_cast<std::uint8_t>((total - kHeaderBytes) / kLongUnit)})
      w.u8(byte);
    w.u8(static_cast<std::uint8_t>(Command::get_info));
  }
  for (const char c : text) w.u8(static_cast<std::uint8_t>(c));
  if (six) return total;
  while (w.size() < total - 1) w.u8(0);
  w.u8(checksum(out.subspan(kHeaderBytes, total - kHeaderBytes - 1)));
  return total;
}

// ------------------------------------------------------------------------------------------------------------------ master's side

bool answers(Wire wire, Command command, const Frame& frame) noexcept {
  const bool acknowledged = wire.dialect == Dialect::six && frame.length == kMinLength && frame.command() <= kAckOk;
  switch (command) {
    case Command::set_zeros:
    case Command::store_parameters:
    case Command::store_defaults:
    case Command::restore_defaults:
    case Command::bootloader:
    case Command::init_memory:
    case Command::calibrate:
    case Command::parameters:
    case Command::set_inputs_acknowledged:
      return wire.dialect == Dialect::six ? acknowledged : frame.command() == static_cast<std::uint8_t>(command);
    default:
      return frame.command() == static_cast<std::uint8_t>(command);
  }
}

template <>
std::optional<PingReply> decode_reply<PingReply>(Wire wire, Command command, const Frame& frame) noexcept {
  // Dialect seven before its version 7.1 sent no serial number.
  if (frame.command() != static_cast<std::uint8_t>(command)) return std::nullopt;
  if (frame.payload().empty()) return PingReply{};
  auto in = payload_of(frame, command, 4);
  if (!in || wire.dialect == Dialect::six) return std::nullopt;
  return PingReply{in->u32()};
}

template <>
std::optional<Acknowledgement> decode_reply<Acknowledgement>(Wire wire, Command command, const Frame& frame) noexcept {
  if (!answers(wire, command, frame)) return std::nullopt;
  if (wire.dialect == Dialect::six) return Acknowledgement{frame.command() == kAckOk};
  auto in = payload_of(frame, command, 1);
  if (!in) return std::nullopt;
  return Acknowledgement{in->u8() == kAckOk};
}

template <>
std::optional<ActivationReply> decode_reply<ActivationReply>(Wire, Command command, const Frame& frame) noexcept {
  auto in = payload_of(frame, command, 1);
  if (!in) return std::nullopt;
  return ActivationReply{in->u8()};
}

template <>
std::optional<InputsReply> decode_reply<InputsReply>(Wire, Command command, const Frame& frame) noexcept {
  auto in = payload_of(frame, command, 4);
  if (!in) return std::nullopt;
  return InputsReply{read_ticks<2>(*in)};
}

template <>
std::optional<MeasurementsReply> decode_reply<MeasurementsReply>(Wire, Command command, const Frame& frame) noexcept {
  auto in = payload_of(frame, command, 6);
  if (!in) return std::nullopt;
  return MeasurementsReply{read_ticks<3>(*in)};
}

template <>
std::optional<CurrentsReply> decode_reply<CurrentsReply>(Wire, Command command, const Frame& frame) noexcept {
  auto in = payload_of(frame, command, 4);
  if (!in) return std::nullopt;
  CurrentsReply reply;
  for (std::int16_t& c : reply.currents_mA) c = in->i16();
  return reply;
}

template <>
std::optional<CurrentsAndMeasurementsReply> decode_reply<CurrentsAndMeasurementsReply>(Wire wire, Command command,
                                                                                       const Frame& frame) noexcept {
  auto in = payload_of(frame, command, 10);
  if (!in) return std::nullopt;
  CurrentsAndMeasurementsReply reply;
  for (std::int16_t& c : reply.currents_mA) c = in->i16();
  const auto positions = read_three(*in, wire.packed());
  for (std::size_t i = 0; i < positions.size(); ++i) reply.positions[i].value = positions[i];
  return reply;
}

template <>
std::optional<VelocitiesReply> decode_reply<VelocitiesReply>(Wire wire, Command command, const Frame& frame) noexcept {
  auto in = payload_of(frame, command, 6);
  if (!in) return std::nullopt;
  return VelocitiesReply{read_three(*in, wire.packed())};
}

template <>
std::optional<CycleTimeReply> decode_reply<CycleTimeReply>(Wire, Command command, const Frame& frame) noexcept {
  auto in = payload_of(frame, command, 4);
  if (!in) return std::nullopt;
  CycleTimeReply reply;
  reply.unknown = in->i16();
  reply.cycle_time = in->i16();
  return reply;
}

}  // namespace vsa::bus
