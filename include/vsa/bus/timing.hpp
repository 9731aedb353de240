// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Time on the wire, in integer picoseconds of simulated time, and what a listener hears when speakers overlap.
//
// A byte is 10 bits (8N1): start bit 0, eight data bits from the lowest, stop bit 1. n bytes take n·10/baud, rounded up once, so
// that rates whose bit isn't a whole number of picoseconds don't drift. The line is half duplex: one pair of wires for both
// directions. Nobody listens before speaking, neither client libraries nor units: two speakers at once are a collision.
//
// Collision rule. Real drivers fight and the result depends on cables and supply. We take the deterministic wired-AND:
//   level(t) = AND over all speakers, idle = 1
// and a receiver as every UART has it: a falling edge starts a byte, bits are sampled in their middle, a start bit that is 1 in its
// middle is a glitch, a stop bit that is 0 is a framing error and the receiver waits for 1 before it looks for an edge again.
// Bytes that start at the same instant are heard as their AND; shifted ones as what the samples find, mostly garbage that the
// frame's checksum refuses. Different baud rates garble by the same rule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace vsa::bus {

inline constexpr int kBitsPerByte = 10;                                   ///< 8N1
inline constexpr std::int64_t kPicosecondsPerSecond = 1'000'000'000'000;  ///< of one second
inline constexpr std::int64_t kPsPerNs = 1000;                            ///< of one nanosecond
inline constexpr std::int64_t kDefaultBaud_Hz = 2'000'000;                ///< of a unit that nobody set otherwise
inline constexpr std::int64_t kMostBaud_Hz = 1'000'000'000;               ///< of a simulated line

/// Rounded up: a byte isn't there before its last bit.
[[nodiscard]] constexpr std::int64_t to_ns(std::int64_t ps) noexcept { return (ps + kPsPerNs - 1) / kPsPerNs; }

/// A line's rate, and the time that bits and bytes take there, ps.
struct LineRate {
  std::int64_t baud_Hz = kDefaultBaud_Hz;  ///< bits per second

  /// Time of `bits` bits, rounded up. Exact up to 9 million bits.
  [[nodiscard]] constexpr std::int64_t bits_ps(std::int64_t bits) const noexcept {
    return (bits * kPicosecondsPerSecond + baud_Hz - 1) / baud_Hz;
  }
  /// Of that many bytes.
  [[nodiscard]] constexpr std::int64_t bytes_ps(std::int64_t bytes) const noexcept { return bits_ps(bytes * kBitsPerByte); }
  bool operator==(const LineRate&) const = default;
  static auto fields(auto& s, auto&& visit) { return visit("baud", "Hz", s.baud_Hz); }
  [[nodiscard]] constexpr const char* impossible() const noexcept {
    return baud_Hz >= 1 && baud_Hz <= kMostBaud_Hz ? nullptr : "a baud rate of 1 … 1e9";
  }
};

/// Request, turn-around, reply: when the master has the answer's last bit, from the request's first.
[[nodiscard]] constexpr std::int64_t exchange_ps(LineRate rate, std::int64_t request_bytes, std::int64_t turn_around_ps,
                                                 std::int64_t reply_bytes) noexcept {
  return rate.bytes_ps(request_bytes) + (reply_bytes == 0 ? 0 : turn_around_ps + rate.bytes_ps(reply_bytes));
}

/// Bytes that one speaker sends back to back.
struct Burst {
  std::int64_t start_ps = 0;            ///< of the first bit
  std::span<const std::uint8_t> bytes;  ///< back to back
  LineRate rate{};                      ///< of the speaker

  /// Of the last bit.
  [[nodiscard]] constexpr std::int64_t end_ps() const noexcept {
    return start_ps + rate.bytes_ps(static_cast<std::int64_t>(bytes.size()));
  }
};

/// Whether two speakers are on the line at once.
[[nodiscard]] constexpr bool overlap(const Burst& a, const Burst& b) noexcept {
  return a.start_ps < b.end_ps() && b.start_ps < a.end_ps();
}

/// A byte as a receiver has it.
struct HeardByte {
  std::int64_t end_ps = 0;     ///< end of the stop bit: when the receiver has it
  std::uint8_t value = 0;      ///< as sampled
  bool framing_error = false;  ///< a stop bit that was 0
  bool operator==(const HeardByte&) const = default;
};

/// The line's level at a time; 1 is idle.
[[nodiscard]] bool line_level(std::span<const Burst> speakers, std::int64_t at_ps) noexcept;

/// A receiver that goes on from one call to the next: `from_ps` is where it looks for the next edge.
struct LineReceiver {
  LineRate rate{};                                                  ///< of the receiver; bits of another rate are sampled wrongly
  std::int64_t from_ps = std::numeric_limits<std::int64_t>::min();  ///< until then it has looked
  static auto fields(auto& s, auto&& visit) { return visit("rate", "", s.rate, "from", "ps", s.from_ps); }
  bool operator==(const LineReceiver&) const = default;
};

/// What the receiver hears of these speakers up to `until_ps`: bytes whose stop bit ends by then. Fills `out` and returns how many;
/// if `out` is full, call again. The caller leaves out the listener's own bursts, and may drop those that ended before from_ps.
std::size_t listen(LineReceiver& receiver, std::span<const Burst> speakers, std::span<HeardByte> out,
                   std::int64_t until_ps = std::numeric_limits<std::int64_t>::max()) noexcept;

}  // namespace vsa::bus
