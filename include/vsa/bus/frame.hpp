// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Frames on the wire:   ':' ':' ID LEN CMD payload… CHK
//
// LEN counts CMD, payload and CHK (2…128 for a unit). CHK is the XOR of CMD and payload; the header isn't covered. ID 0 is
// broadcast. Values in the payload are big-endian. Longer answers (the parameter list, the info text) are streams, see
// parameters.hpp and messages.hpp: a unit never receives them as frames.
//
// Nothing here allocates or throws, whatever the bytes.
//
// Source: NMMI/qbmove-maker-pro 6.1, interruptions.c (receiver) and command_processing.c (checksum, sending).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace vsa::bus {

inline constexpr std::uint8_t kStartByte = ':';                           ///< twice before every frame
inline constexpr std::uint8_t kBroadcastId = 0;                           ///< every unit hears it, none answers
inline constexpr std::size_t kHeaderBytes = 4;                            ///< ':' ':' ID LEN
inline constexpr std::size_t kMinLength = 2;                              ///< CMD and CHK
inline constexpr std::size_t kMaxLength = 128;                            ///< the unit's buffer
inline constexpr std::size_t kMaxPayload = kMaxLength - kMinLength;       ///< without CMD and CHK
inline constexpr std::size_t kMaxFrameBytes = kHeaderBytes + kMaxLength;  ///< header and body

/// XOR of all bytes.
[[nodiscard]] std::uint8_t checksum(std::span<const std::uint8_t> bytes) noexcept;

/// A short run of bytes with room for one frame. Appending past its end drops the byte and marks it.
struct FrameBytes {
  std::array<std::uint8_t, kMaxFrameBytes> bytes{};  ///< the first `size` count
  std::uint8_t size = 0;                             ///< of `bytes`
  bool overflowed = false;                           ///< whether one was dropped

  /// Drops the byte if there is no room.
  void push(std::uint8_t byte) noexcept {
    if (size < bytes.size())
      bytes[size++] = byte;
    else
      overflowed = true;
  }
  /// Lives as long as this does: in a range-for over a temporary, iterate over the FrameBytes itself.
  [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
  [[nodiscard]] const std::uint8_t* begin() const noexcept { return bytes.data(); }       ///< for a range-for
  [[nodiscard]] const std::uint8_t* end() const noexcept { return bytes.data() + size; }  ///< for a range-for
  bool operator==(const FrameBytes&) const = default;
};

/// A whole frame. Empty if the payload is longer than kMaxPayload.
[[nodiscard]] FrameBytes encode_frame(std::uint8_t id, std::uint8_t command, std::span<const std::uint8_t> payload) noexcept;

/// Whether these bytes are one frame from end to end, as far as its header tells; the checksum isn't looked at.
[[nodiscard]] constexpr bool whole_frame(std::span<const std::uint8_t> bytes) noexcept {
  return bytes.size() >= kHeaderBytes + kMinLength && bytes[0] == kStartByte && bytes[1] == kStartByte &&
         bytes.size() == kHeaderBytes + bytes[3] && bytes[3] <= kMaxLength;
}

/// Whether the unit with this ID does something about a whole_frame.
[[nodiscard]] constexpr bool is_for(std::span<const std::uint8_t> bytes, std::uint8_t own_id) noexcept {
  return bytes[2] == own_id || bytes[2] == kBroadcastId;
}

/// A received frame. `body` is CMD, payload, CHK as in the unit's own buffer: what lies behind `length` are bytes that earlier,
/// longer frames left there, and the unit's program reads them when a request is shorter than it should be.
struct Frame {
  std::array<std::uint8_t, kMaxLength> body{};  ///< CMD, payload, CHK, and what lies behind
  std::uint8_t id = 0;                          ///< as the header has it
  std::uint8_t length = 0;                      ///< LEN: bytes of body that belong to the frame
  static auto fields(auto& s, auto&& visit) { return visit("body", "", s.body, "id", "", s.id, "length", "", s.length); }
  [[nodiscard]] constexpr const char* impossible() const noexcept { return length <= kMaxLength ? nullptr : "a LEN of up to 128"; }

  [[nodiscard]] std::uint8_t command() const noexcept { return body[0]; }  ///< CMD
  /// Without CMD and CHK; empty where LEN is too small.
  [[nodiscard]] std::span<const std::uint8_t> payload() const noexcept {
    return {body.data() + 1, length < kMinLength ? 0U : length - kMinLength};
  }
  bool operator==(const Frame&) const = default;
};

/// What one more byte meant to a unit.
enum class ReceiverEvent : std::uint8_t {
  none,          ///< in the middle of something, or noise
  frame,         ///< `frame` holds a frame for this unit (or broadcast) with a right checksum
  bad_checksum,  ///< a frame for this unit with a wrong checksum: the unit says nothing
  skipped,       ///< the end of a frame for someone else, skipped by count
  info_request,  ///< '?' CR LF outside a frame: the unit sends its info text
};

/// The unit stops reading after six of these a poll; info requests don't count.
[[nodiscard]] constexpr bool counts_toward_poll(ReceiverEvent e) noexcept {
  return e == ReceiverEvent::frame || e == ReceiverEvent::bad_checksum || e == ReceiverEvent::skipped;
}
inline constexpr int kFramesPerPoll = 6;  ///< after which the unit stops reading a poll

/// The unit's receiver, byte by byte. Plain state: copy it for a snapshot.
///
/// hunt: the last three bytes are kept; "::" starts a frame, "?\r\n" is an info request. They are cleared by "::" only, so that
/// a tail of noise and a new byte can make one of the two.
/// id: this unit's (as it is at this byte) or broadcast → receive; else → skip.
/// length: ≤ 1 or > 128 → hunt again, nothing is counted; the byte itself isn't looked at again.
/// body: LEN bytes, without a time-out: a sender that dies half way swallows the next frame's beginning.
struct UnitReceiver {
  /// Where it is in a frame.
  enum class Phase : std::uint8_t { hunt, id, length, body, skip };

  Frame frame{};                       ///< the frame under way, or the last
  std::array<std::uint8_t, 3> last{};  ///< of the bytes in hunt
  Phase phase = Phase::hunt;           ///< what the next byte is
  std::uint8_t wanted = 0;             ///< LEN of the frame under way
  std::uint8_t received = 0;           ///< body bytes so far, of this unit's or another's frame
  std::uint8_t pending_id = 0;         ///< of the frame under way
  bool mine = false;                   ///< whether it is for this unit
  static auto fields(auto& s, auto&& visit) {
    return visit("frame", "", s.frame, "last", "", s.last, "phase", "", s.phase, "wanted", "", s.wanted, "received", "", s.received,
                 "pending_id", "", s.pending_id, "mine", "", s.mine);
  }
  /// The byte that comes next has a place in the frame.
  [[nodiscard]] constexpr const char* impossible() const noexcept {
    const bool under_way = phase == Phase::body || phase == Phase::skip;
    return wanted <= kMaxLength && received <= wanted && (!under_way || received < wanted) ? nullptr
                                                                                           : "received below wanted ≤ 128";
  }

  [[nodiscard]] ReceiverEvent push(std::uint8_t byte, std::uint8_t own_id) noexcept;  ///< one byte, with the unit's id as it is now
  /// Nothing under way that a frame's first bytes could complete.
  [[nodiscard]] bool at_rest() const noexcept { return phase == Phase::hunt && last[2] != kStartByte; }
  /// At rest: the bytes of one whole_frame at once, with the same end as byte by byte. Someone else's costs next to nothing.
  [[nodiscard]] ReceiverEvent push_frame(std::span<const std::uint8_t> bytes, std::uint8_t own_id) noexcept;
  /// At rest: a whole_frame for another unit, of which these are the ID and the length.
  void pass(std::uint8_t its_id, std::uint8_t length) noexcept;
  bool operator==(const UnitReceiver&) const = default;
};
[[nodiscard]] constexpr int choices(UnitReceiver::Phase) noexcept { return 5; }  ///< for the walk over states

/// A master's receiver: finds frames of any ID in a stream and forgets nothing it may still need. A frame whose checksum is wrong or
/// whose LEN is out of range costs its first byte only; the rest is looked at again, so that a frame behind noise isn't lost.
class MasterReceiver {
 public:
  /// The bytes must be taken by `next` before more are pushed: at most `room()` are accepted, and the number is returned.
  std::size_t push(std::span<const std::uint8_t> bytes) noexcept;
  [[nodiscard]] std::size_t room() const noexcept { return buffer_.size() - size_; }  ///< bytes that push() takes now
  /// The next whole frame, if there is one: true, and `frame` is set.
  [[nodiscard]] bool next(Frame& frame) noexcept;
  /// What is in the buffer and can't be a frame's beginning is noise; this many bytes were dropped so far.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }
  /// No more bytes will come: gives up the frame that waits for them, so that `next` looks behind its first byte. False: nothing
  /// left.
  bool give_up() noexcept;
  void clear() noexcept { size_ = 0; }  ///< forgets what waits; dropped() stays
  static auto fields(auto& s, auto&& visit) {
    return visit("buffer", "", s.buffer_, "size", "", s.size_, "dropped", "", s.dropped_);
  }
  [[nodiscard]] const char* impossible() const noexcept { return size_ <= buffer_.size() ? nullptr : "a size of up to 264"; }

 private:
  void drop(std::size_t count) noexcept;

  std::array<std::uint8_t, 2 * kMaxFrameBytes> buffer_{};
  std::size_t size_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace vsa::bus
