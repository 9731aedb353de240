// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a unit's program gives out: bytes for the bus, and events for its surroundings. The caller owns it and clears it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace vsa::firmware {

/// One answer in Output::bytes.
struct Reply {
  std::uint16_t begin = 0,    ///< in Output::bytes
      size = 0;               ///< bytes
  std::int64_t delay_ns = 0;  ///< after the call's time: EEPROM and earlier replies; the turn-around is the bus's
};

/// What a call of the program gave out: bytes for the bus, and events. The caller clears it and hands the bytes on.
struct Output {
  /// Enough for all that 32 buffered bytes can ask for: ten info texts, or six frames.
  static constexpr std::size_t kBytes = 16384;
  static constexpr std::size_t kReplies = 16;  ///< of one call

  std::array<std::uint8_t, kBytes> bytes;  ///< of all replies, back to back
  std::array<Reply, kReplies> replies;     ///< the first `count` count
  std::uint16_t used = 0;                  ///< of `bytes`
  std::uint8_t count = 0;                  ///< of `replies`
  bool baud_changed = false;               ///< the state's baud_divider holds from now on, also for the replies that follow
  bool bootloader = false;                 ///< the unit leaves for its bootloader: silent in 2 s, until the next power-up

  Output() noexcept {}  // the bytes stay as they are: clearing 16 kB a tick would cost more than the tick
  void clear() noexcept { used = count = 0, baud_changed = bootloader = false; }  ///< before the next call

  [[nodiscard]] bool silent() const noexcept { return count == 0 && !baud_changed && !bootloader; }  ///< nothing came out
  /// Of one of `replies`.
  [[nodiscard]] std::span<const std::uint8_t> view(const Reply& r) const noexcept { return {bytes.data() + r.begin, r.size}; }
  /// Where the next reply's bytes go.
  [[nodiscard]] std::span<std::uint8_t> room() noexcept { return std::span{bytes}.subspan(used); }
  /// The first `size` bytes of room() are a reply.
  void commit(std::size_t size, std::int64_t delay_ns) noexcept {
    if (size == 0 || count == kReplies) return;
    replies[count++] = {used, static_cast<std::uint16_t>(size), delay_ns};
    used = static_cast<std::uint16_t>(used + size);
  }
};

}  // namespace vsa::firmware
