// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/client.hpp"

#include <algorithm>
#include <array>

namespace vsa::bus {
namespace {

constexpr std::uint8_t kMotorsOn = 3;

Command command_of(const Request& request) noexcept {
  return std::visit([](const auto& r) { return std::decay_t<decltype(r)>::code; }, request);
}

/// After these the unit may answer under another id than it was asked by.
bool may_change_id(Command command) noexcept {
  return command == Command::init_memory || command == Command::restore_defaults || command == Command::parameters;
}

bool writes_memory(Command command) noexcept {
  return command == Command::store_parameters || command == Command::store_defaults || command == Command::restore_defaults ||
         command == Command::init_memory;
}

}  // namespace

const char* describe(ClientError error) noexcept {
  switch (error) {
    case ClientError::timeout:
      return "no answer";
    case ClientError::closed:
      return "the port is closed";
    case ClientError::refused:
      return "the unit refused";
    case ClientError::malformed:
      return "an answer that this dialect doesn't have";
    case ClientError::bad_value:
      return "the value isn't of the parameter's type";
  }
  return "unknown error";
}

bool Client::drain() {
  std::array<std::uint8_t, 256> old{};
  while (true) {
    const auto count = channel_.read(old, Channel::Time::zero());
    if (!count) return false;
    if (*count == 0) return true;
  }
}

Result<Done> Client::send(std::uint8_t id, const Request& request) {
  if (!drain() || !channel_.write(encode_request(options_.wire, id, request).view())) return ClientError::closed;
  return Done{};
}

Result<Frame> Client::await_frame(std::uint8_t id, Command command, Channel::Time timeout) {
  MasterReceiver receiver;
  Frame frame;
  const auto take = [&] {
    while (receiver.next(frame)) {
      const bool theirs = frame.id == id || id == kBroadcastId || may_change_id(command);
      if (theirs && answers(options_.wire, command, frame)) return true;
    }
    return false;
  };
  const Channel::Time end = channel_.now() + timeout;
  std::array<std::uint8_t, kMaxFrameBytes> bytes{};
  while (true) {
    const Channel::Time left = end - channel_.now();
    const auto count = left > Channel::Time::zero() ? channel_.read(bytes, left) : std::optional<std::size_t>{0};
    if (!count) return ClientError::closed;
    if (*count == 0) {
      // Noise that looked like the beginning of a long frame may hide the answer.
      while (receiver.give_up())
        if (take()) return frame;
      return ClientError::timeout;
    }
    receiver.push(std::span{bytes}.first(*count));
    if (take()) return frame;
  }
}

Result<Frame> Client::exchange(std::uint8_t id, const Request& request, Channel::Time timeout) {
  for (int attempt = 1;; ++attempt) {
    if (const auto sent = send(id, request); !sent) return sent.error();
    const auto frame = await_frame(id, command_of(request), timeout);
    if (frame || frame.error() != ClientError::timeout || attempt >= options_.attempts) return frame;
  }
}

template <class R>
Result<typename R::Reply> Client::ask(std::uint8_t id, const R& request) {
  const auto frame = exchange(id, request, options_.reply_timeout);
  if (!frame) return frame.error();
  const auto reply = decode_reply<typename R::Reply>(options_.wire, R::code, *frame);
  if (!reply) return ClientError::malformed;
  return *reply;
}

Result<PingReply> Client::ping(std::uint8_t id) { return ask(id, Ping{}); }
Result<InputsReply> Client::inputs(std::uint8_t id) { return ask(id, GetInputs{}); }
Result<MeasurementsReply> Client::measurements(std::uint8_t id) { return ask(id, GetMeasurements{}); }
Result<CurrentsReply> Client::currents(std::uint8_t id) { return ask(id, GetCurrents{}); }
Result<CurrentsAndMeasurementsReply> Client::currents_and_measurements(std::uint8_t id) {
  return ask(id, GetCurrentsAndMeasurements{});
}

Result<Dialect> Client::dialect(std::uint8_t id) {
  const auto frame = exchange(id, Ping{}, options_.reply_timeout);
  if (!frame) return frame.error();
  return frame->payload().empty() ? Dialect::six : Dialect::seven;
}

Result<std::vector<std::uint8_t>> Client::scan(std::uint8_t first, std::uint8_t last, Channel::Time each) {
  std::vector<std::uint8_t> found;
  for (unsigned id = std::max<unsigned>(first, 1); id <= last; ++id) {
    const auto frame = exchange(static_cast<std::uint8_t>(id), Ping{}, each);
    if (frame)
      found.push_back(static_cast<std::uint8_t>(id));
    else if (frame.error() == ClientError::closed)
      return ClientError::closed;
  }
  return found;
}

Result<Done> Client::activate(std::uint8_t id, bool on) { return send(id, Activate{on ? kMotorsOn : std::uint8_t{0}}); }

Result<bool> Client::active(std::uint8_t id) {
  const auto reply = ask(id, GetActivate{});
  if (!reply) return reply.error();
  return reply->flags != 0;
}

Result<Done> Client::set_inputs(std::uint8_t id, std::array<Ticks, 2> inputs) { return send(id, SetInputs{inputs}); }

Result<Done> Client::set_position_stiffness(std::uint8_t id, Ticks position, std::int16_t stiffness) {
  return send(id, SetPositionStiffness{position, stiffness});
}

Result<Done> Client::acknowledge(std::uint8_t id, const Request& request) {
  const Command command = command_of(request);
  const auto frame = exchange(id, request, writes_memory(command) ? options_.slow_timeout : options_.reply_timeout);
  if (!frame) return frame.error();
  const auto reply = decode_reply<Acknowledgement>(options_.wire, command, *frame);
  if (!reply) return ClientError::malformed;
  if (!reply->ok) return ClientError::refused;
  return Done{};
}

Result<Done> Client::store(std::uint8_t id) { return acknowledge(id, StoreParameters{}); }

Result<Done> Client::set_parameter(std::uint8_t id, ParameterId parameter, const ParameterValue& value) {
  const auto set = encode_value(parameter, value);
  if (!set || find_parameter(options_.wire.dialect, set->index) == nullptr) return ClientError::bad_value;
  if (reply_kind(options_.wire, *set) == ReplyKind::none) return send(id, *set);
  return acknowledge(id, *set);
}

}  // namespace vsa::bus
