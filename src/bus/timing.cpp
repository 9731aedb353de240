// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/timing.hpp"

#include <algorithm>

namespace vsa::bus {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kDataBits = 8;

std::int64_t bits(const Burst& b) noexcept { return static_cast<std::int64_t>(b.bytes.size()) * kBitsPerByte; }

bool bit_level(const Burst& b, std::int64_t bit) noexcept {
  const std::int64_t in_byte = bit % kBitsPerByte;
  if (in_byte == 0) return false;
  if (in_byte > kDataBits) return true;
  return ((b.bytes[static_cast<std::size_t>(bit / kBitsPerByte)] >> (in_byte - 1)) & 1) != 0;
}

std::int64_t bit_start_ps(const Burst& b, std::int64_t bit) noexcept { return b.start_ps + b.rate.bits_ps(bit); }

/// The bit on the line at this time, which lies within the burst. Boundaries are rounded up, as in bits_ps.
std::int64_t bit_at(const Burst& b, std::int64_t at_ps) noexcept {
  return (at_ps - b.start_ps) * b.rate.baud_Hz / kPicosecondsPerSecond;
}

bool on_line(const Burst& b, std::int64_t at_ps) noexcept { return b.start_ps <= at_ps && at_ps < b.end_ps(); }

/// The first time from `at_ps` on at which this speaker holds the line low.
std::int64_t next_low_ps(const Burst& b, std::int64_t at_ps) noexcept {
  if (at_ps >= b.end_ps()) return kNever;
  const std::int64_t from = std::max(at_ps, b.start_ps);
  for (std::int64_t bit = bit_at(b, from); bit < bits(b); ++bit)
    if (!bit_level(b, bit)) return std::max(from, bit_start_ps(b, bit));
  return kNever;
}

std::int64_t next_low_ps(std::span<const Burst> speakers, std::int64_t at_ps) noexcept {
  std::int64_t first = kNever;
  for (const Burst& b : speakers) first = std::min(first, next_low_ps(b, at_ps));
  return first;
}

/// The first time from `at_ps` on at which nobody holds the line low. A stop bit and the end of every burst bound the search.
std::int64_t next_high_ps(std::span<const Burst> speakers, std::int64_t at_ps) noexcept {
  while (!line_level(speakers, at_ps)) {
    for (const Burst& b : speakers)
      if (on_line(b, at_ps) && !bit_level(b, bit_at(b, at_ps))) at_ps = bit_start_ps(b, bit_at(b, at_ps) + 1);
  }
  return at_ps;
}

}  // namespace

bool line_level(std::span<const Burst> speakers, std::int64_t at_ps) noexcept {
  return std::all_of(speakers.begin(), speakers.end(),
                     [at_ps](const Burst& b) { return !on_line(b, at_ps) || bit_level(b, bit_at(b, at_ps)); });
}

std::size_t listen(LineReceiver& receiver, std::span<const Burst> speakers, std::span<HeardByte> out,
                   std::int64_t until_ps) noexcept {
  const auto middle_ps = [&](std::int64_t edge_ps, std::int64_t bit) {
    return edge_ps + (receiver.rate.bits_ps(bit) + receiver.rate.bits_ps(bit + 1)) / 2;
  };
  std::size_t count = 0;
  while (count < out.size()) {
    const std::int64_t edge = next_low_ps(speakers, receiver.from_ps);
    if (edge == kNever || edge > until_ps - receiver.rate.bytes_ps(1)) break;
    if (line_level(speakers, middle_ps(edge, 0))) {
      receiver.from_ps = middle_ps(edge, 0);
      continue;
    }
    HeardByte heard;
    for (std::int64_t bit = 0; bit < kDataBits; ++bit)
      if (line_level(speakers, middle_ps(edge, bit + 1))) heard.value = static_cast<std::uint8_t>(heard.value | (1U << bit));
    const std::int64_t stop = middle_ps(edge, kDataBits + 1);
    heard.framing_error = !line_level(speakers, stop);
    heard.end_ps = edge + receiver.rate.bytes_ps(1);
    receiver.from_ps = heard.framing_error ? next_high_ps(speakers, stop) : stop;
    out[count++] = heard;
  }
  return count;
}

}  // namespace vsa::bus
