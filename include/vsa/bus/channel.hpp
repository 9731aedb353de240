// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A pipe of bytes to a bus: a serial port, a virtual one, or units in the same program. The channel owns the clock, so that a
// client's time-outs run in simulated time where the bus does.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace vsa::bus {

/// A pipe of bytes to a bus, with a clock of its own: where a Client writes and reads.
class Channel {
 public:
  using Time = std::chrono::nanoseconds;  ///< of now() and of time-outs

  Channel() = default;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  virtual ~Channel() = default;

  /// All bytes or none; false: the channel is closed.
  [[nodiscard]] virtual bool write(std::span<const std::uint8_t> bytes) = 0;

  /// At least one byte as soon as there is one; 0 when `timeout` has passed without; none: the channel is closed. A time-out of
  /// zero looks and returns at once.
  [[nodiscard]] virtual std::optional<std::size_t> read(std::span<std::uint8_t> into, Time timeout) = 0;

  /// Never runs backwards, and runs on while read waits.
  [[nodiscard]] virtual Time now() const = 0;
};

}  // namespace vsa::bus
