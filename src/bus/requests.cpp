// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Requests both ways: master → frame, frame → unit.
#include <algorithm>

#include "vsa/bus/bytes.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/bus/parameters.hpp"

namespace vsa::bus {
namespace {

template <class... Fs>
struct Overload : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overload(Fs...) -> Overload<Fs...>;

constexpr std::size_t kIndexBytes = 2;

std::array<Ticks, 2> two_ticks(ByteReader& in) noexcept {
  const Ticks first{in.i16()};
  return {first, Ticks{in.i16()}};
}

SetZeros read_zeros(Wire wire, const Frame& frame, ByteReader& in) noexcept {
  if (wire.dialect == Dialect::seven && frame.payload().empty()) return {std::nullopt};
  std::array<Ticks, 3> offsets{};
  for (Ticks& t : offsets) t.value = in.i16();
  return {offsets};
}

Request read_parameters(const Frame& frame, ByteReader& in) noexcept {
  SetParameter set;
  set.index = in.u16();
  if (set.index == 0) return GetParameterList{};
  for (std::uint8_t& byte : set.value) byte = in.u8();
  const std::size_t sent = frame.payload().size();
  set.value_bytes = static_cast<std::uint8_t>(sent < kIndexBytes ? 0 : std::min(sent - kIndexBytes, set.value.size()));
  return set;
}

/// The commands of firmware 6.1 with a payload. `in` stands at the payload's start and may read past LEN.
std::optional<Request> decode_with_payload(Wire wire, const Frame& frame, ByteReader& in) noexcept {
  switch (static_cast<Command>(frame.command())) {
    case Command::set_zeros:
      return read_zeros(wire, frame, in);
    case Command::get_info:
      return GetInfo{in.u16()};
    case Command::parameters:
      return read_parameters(frame, in);
    case Command::activate:
      return Activate{in.u8()};
    case Command::set_inputs:
      return SetInputs{two_ticks(in)};
    case Command::set_position_stiffness: {
      const auto v = two_ticks(in);
      return SetPositionStiffness{v[0], v[1].value};
    }
    case Command::set_watchdog:
      return SetWatchdog{in.u8()};
    case Command::set_baud_rate:
      return SetBaudRate{in.u8()};
    case Command::set_inputs_acknowledged:
      if (wire.dialect == Dialect::six) return std::nullopt;
      return SetInputsAcknowledged{two_ticks(in)};
    default:
      return std::nullopt;
  }
}

void write_payload(ByteWriter& out, const Request& request) noexcept {
  const auto two = [&out](std::int16_t a, std::int16_t b) {
    out.i16(a);
    out.i16(b);
  };
  std::visit(Overload{
                 [&](const SetZeros& r) {
                   if (r.offsets)
                     for (const Ticks t : *r.offsets) out.i16(t.value);
                 },
                 [&](const GetInfo& r) { out.u16(r.kind); },
                 [&](const GetParameterList&) { out.u16(0); },
                 [&](const SetParameter& r) {
                   out.u16(r.index);
                   for (std::size_t i = 0; i < r.value_bytes && i < r.value.size(); ++i) out.u8(r.value[i]);
                 },
                 [&](const Activate& r) { out.u8(r.flags); },
                 [&](const SetInputs& r) { two(r.inputs[0].value, r.inputs[1].value); },
                 [&](const SetInputsAcknowledged& r) { two(r.inputs[0].value, r.inputs[1].value); },
                 [&](const SetPositionStiffness& r) { two(r.position.value, r.stiffness); },
                 [&](const SetWatchdog& r) { out.u8(r.period); },
                 [&](const SetBaudRate& r) { out.u8(r.divider); },
                 [](const auto&) {},
             },
             request);
}

}  // namespace

std::optional<Request> decode_request(Wire wire, const Frame& frame) noexcept {
  switch (static_cast<Command>(frame.command())) {
    case Command::ping:
      return Ping{};
    case Command::store_parameters:
      return StoreParameters{};
    case Command::store_defaults:
      return StoreDefaults{};
    case Command::restore_defaults:
      return RestoreDefaults{};
    case Command::bootloader:
      return Bootloader{};
    case Command::init_memory:
      return InitMemory{};
    case Command::calibrate:
      return Calibrate{};
    case Command::get_activate:
      return GetActivate{};
    case Command::get_inputs:
      return GetInputs{};
    case Command::get_measurements:
      return GetMeasurements{};
    case Command::get_currents:
      return GetCurrents{};
    case Command::get_currents_and_measurements:
      return GetCurrentsAndMeasurements{};
    case Command::get_velocities:
      return GetVelocities{};
    case Command::get_cycle_time:
      if (wire.dialect == Dialect::six) return std::nullopt;
      return GetCycleTime{};
    default: {
      ByteReader in{std::span{frame.body}.subspan(1)};
      return decode_with_payload(wire, frame, in);
    }
  }
}

bool complete(Wire wire, const Frame& frame) noexcept {
  const auto request = decode_request(wire, frame);
  if (!request) return true;
  std::array<std::uint8_t, kMaxPayload> scratch{};
  ByteWriter out{scratch};
  write_payload(out, *request);
  if (const auto* set = std::get_if<SetParameter>(&*request)) {
    const ParameterInfo* info = find_parameter(wire.dialect, set->index);
    return info == nullptr || set->value_bytes >= info->count * value_bytes(info->type);
  }
  return frame.payload().size() >= out.size();
}

ReplyKind reply_kind(Wire wire, const Request& request) noexcept {
  return std::visit(Overload{
                        [](const GetInfo& r) { return r.kind == 0 ? ReplyKind::info : ReplyKind::none; },
                        [](const GetParameterList&) { return ReplyKind::parameter_list; },
                        [wire](const SetParameter&) { return wire.dialect == Dialect::six ? ReplyKind::none : ReplyKind::frame; },
                        [](const auto& r) {
                          using Reply = typename std::decay_t<decltype(r)>::Reply;
                          return std::is_same_v<Reply, NoReply> ? ReplyKind::none : ReplyKind::frame;
                        },
                    },
                    request);
}

FrameBytes encode_request(Wire, std::uint8_t id, const Request& request) noexcept {
  std::array<std::uint8_t, kMaxPayload> payload{};
  ByteWriter out{payload};
  write_payload(out, request);
  const Command code = std::visit([](const auto& r) { return std::decay_t<decltype(r)>::code; }, request);
  return encode_frame(id, static_cast<std::uint8_t>(code), {payload.data(), out.size()});
}

}  // namespace vsa::bus
