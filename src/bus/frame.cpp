// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/frame.hpp"

#include <algorithm>

namespace vsa::bus {
namespace {

constexpr std::uint8_t kQuestionMark = '?', kCarriageReturn = '\r', kLineFeed = '\n';

}  // namespace

std::uint8_t checksum(std::span<const std::uint8_t> bytes) noexcept {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum = static_cast<std::uint8_t>(sum ^ byte);
  return sum;
}

FrameBytes encode_frame(std::uint8_t id, std::uint8_t command, std::span<const std::uint8_t> payload) noexcept {
  FrameBytes out;
  if (payload.size() > kMaxPayload) return out;
  for (const std::uint8_t byte : {kStartByte, kStartByte, id, static_cast<std::uint8_t>(payload.size() + kMinLength), command})
    out.push(byte);
  for (const std::uint8_t byte : payload) out.push(byte);
  out.push(static_cast<std::uint8_t>(command ^ checksum(payload)));
  return out;
}

ReceiverEvent UnitReceiver::push(std::uint8_t byte, std::uint8_t own_id) noexcept {
  switch (phase) {
    case Phase::hunt:
      last = {last[1], last[2], byte};
      if (last[1] == kStartByte && last[2] == kStartByte) {
        last = {};
        phase = Phase::id;
      } else if (last[0] == kQuestionMark && last[1] == kCarriageReturn && last[2] == kLineFeed) {
        return ReceiverEvent::info_request;
      }
      return ReceiverEvent::none;
    case Phase::id:
      mine = byte == own_id || byte == kBroadcastId;
      pending_id = byte;
      phase = Phase::length;
      return ReceiverEvent::none;
    case Phase::length:
      received = 0;
      wanted = byte < kMinLength || byte > kMaxLength ? std::uint8_t{0} : byte;
      phase = wanted == 0 ? Phase::hunt : mine ? Phase::body : Phase::skip;
      return ReceiverEvent::none;
    case Phase::body:
      frame.body[received++] = byte;
      if (received < wanted) return ReceiverEvent::none;
      frame.id = pending_id;
      frame.length = wanted;
      phase = Phase::hunt;
      return checksum({frame.body.data(), wanted - std::size_t{1}}) == byte ? ReceiverEvent::frame : ReceiverEvent::bad_checksum;
    case Phase::skip:
      if (++received < wanted) return ReceiverEvent::none;
      phase = Phase::hunt;
      return ReceiverEvent::skipped;
  }
  return ReceiverEvent::none;
}

void UnitReceiver::pass(std::uint8_t its_id, std::uint8_t length) noexcept {
  last = {};
  pending_id = its_id;
  mine = false;
  received = wanted = length;
}

ReceiverEvent UnitReceiver::push_frame(std::span<const std::uint8_t> bytes, std::uint8_t own_id) noexcept {
  pass(bytes[2], bytes[3]);
  mine = is_for(bytes, own_id);
  if (!mine) return ReceiverEvent::skipped;
  std::copy(bytes.begin() + kHeaderBytes, bytes.end(), frame.body.begin());
  frame.id = pending_id;
  frame.length = wanted;
  return checksum(bytes.subspan(kHeaderBytes)) == 0 ? ReceiverEvent::frame : ReceiverEvent::bad_checksum;
}

std::size_t MasterReceiver::push(std::span<const std::uint8_t> bytes) noexcept {
  const std::size_t count = std::min(bytes.size(), room());
  std::copy_n(bytes.begin(), count, buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += count;
  return count;
}

bool MasterReceiver::next(Frame& frame) noexcept {
  while (size_ > 0) {
    const bool start = buffer_[0] == kStartByte && (size_ < 2 || buffer_[1] == kStartByte);
    const bool length_ok = size_ < kHeaderBytes || (buffer_[3] >= kMinLength && buffer_[3] <= kMaxLength);
    if (!start || !length_ok) {
      give_up();
      continue;
    }
    if (size_ < kHeaderBytes || size_ < kHeaderBytes + buffer_[3]) return false;
    const std::span<const std::uint8_t> body{buffer_.data() + kHeaderBytes, buffer_[3]};
    if (checksum(body) != 0) {
      give_up();
      continue;
    }
    frame = Frame{};
    frame.id = buffer_[2];
    frame.length = buffer_[3];
    std::copy(body.begin(), body.end(), frame.body.begin());
    drop(kHeaderBytes + frame.length);
    return true;
  }
  return false;
}

bool MasterReceiver::give_up() noexcept {
  if (size_ == 0) return false;
  drop(1);
  dropped_ += 1;
  return true;
}

void MasterReceiver::drop(std::size_t count) noexcept {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(count), buffer_.begin() + static_cast<std::ptrdiff_t>(size_),
            buffer_.begin());
  size_ -= count;
}

}  // namespace vsa::bus
