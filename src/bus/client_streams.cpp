// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Answers that are no frames: the info text and the parameter list.
#include <algorithm>
#include <array>

#include "bus/long_packet.hpp"
#include "vsa/bus/client.hpp"

namespace vsa::bus {
namespace {

constexpr std::size_t kMaxInfoBytes = 16384;  ///< a line that never falls silent isn't an info text

/// What a whole long packet of this request needs, from its header.
std::size_t packet_bytes(Wire wire, std::span<const std::uint8_t> header) noexcept {
  return wire.dialect == Dialect::six ? kListBytesSix : kHeaderBytes + header[3] * kLongUnit;
}

}  // namespace

Result<Done> Client::read_some(std::vector<std::uint8_t>& into, Channel::Time timeout) {
  std::array<std::uint8_t, 256> bytes{};
  const auto count = channel_.read(bytes, timeout);
  if (!count) return ClientError::closed;
  if (*count == 0) return ClientError::timeout;
  into.insert(into.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(*count));
  return Done{};
}

Result<std::vector<std::uint8_t>> Client::long_packet(std::uint8_t id, const Request& request) {
  const auto command = std::visit([](const auto& r) { return std::decay_t<decltype(r)>::code; }, request);
  if (const auto sent = send(id, request); !sent) return sent.error();
  std::vector<std::uint8_t> bytes;
  const Channel::Time end = channel_.now() + options_.slow_timeout;
  while (true) {
    const std::array<std::uint8_t, 2> start{kStartByte, kStartByte};
    const auto at = std::search(bytes.begin(), bytes.end(), start.begin(), start.end());
    bytes.erase(bytes.begin(), at == bytes.end() && !bytes.empty() ? at - 1 : at);
    if (bytes.size() > kHeaderBytes) {
      const bool theirs = id == kBroadcastId || bytes[2] == id;
      const std::size_t total = packet_bytes(options_.wire, bytes);
      if (!theirs || bytes[kHeaderBytes] != static_cast<std::uint8_t>(command)) {
        bytes.erase(bytes.begin());
        continue;
      }
      if (bytes.size() >= total) {
        bytes.resize(total);
        return bytes;
      }
    }
    const Channel::Time left = end - channel_.now();
    if (left <= Channel::Time::zero()) return ClientError::timeout;
    if (const auto some = read_some(bytes, left); !some) return some.error();
  }
}

Result<std::vector<std::uint8_t>> Client::parameter_list(std::uint8_t id) {
  auto bytes = long_packet(id, GetParameterList{});
  if (bytes && !decode_parameter_list(options_.wire, *bytes)) return ClientError::malformed;
  return bytes;
}

Result<ParameterValues> Client::parameters(std::uint8_t id) {
  const auto bytes = parameter_list(id);
  if (!bytes) return bytes.error();
  return *decode_parameter_list(options_.wire, *bytes);
}

Result<std::string> Client::info(std::uint8_t id) {
  if (options_.wire.dialect == Dialect::seven) {
    const auto bytes = long_packet(id, GetInfo{});
    if (!bytes) return bytes.error();
    const std::span<const std::uint8_t> body = std::span{*bytes}.subspan(kHeaderBytes);
    if (body.size() < kMinLength || checksum(body) != 0) return ClientError::malformed;
    const auto end = std::find(body.begin() + 1, body.end() - 1, std::uint8_t{0});
    return std::string(body.begin() + 1, end);
  }
  if (const auto sent = send(id, GetInfo{}); !sent) return sent.error();
  std::vector<std::uint8_t> bytes;
  while (bytes.size() < kMaxInfoBytes) {
    const auto some = read_some(bytes, bytes.empty() ? options_.slow_timeout : options_.silence);
    if (some) continue;
    if (some.error() == ClientError::closed || bytes.empty()) return some.error();
    return std::string(bytes.begin(), bytes.end());
  }
  return ClientError::malformed;
}

}  // namespace vsa::bus
