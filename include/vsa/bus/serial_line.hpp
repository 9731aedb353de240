// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What lies behind a serial port: the units on their line, as a client that opened the port meets them.
//
// A port's thread hands over bytes as they come and gets the answers at once: units answer from their last tick, so an answer never
// waits for a physics step. Only what the units themselves delay (a store, an answer made late on purpose) comes later, by `wake`.
// Implementations hold a lock for one exchange or one tick, microseconds, never across a physics step.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vsa::bus {

/// A line behind a port: exchange(), wake() and set_rate() are the port's thread's.
class SerialLine {
 public:
  using Clock = std::chrono::steady_clock;  ///< of the wall, which the port's thread lives by
  virtual ~SerialLine() = default;

  /// The client's bytes, heard now, in order; may be empty. What the line says by now is appended to `answer`. Any bytes are fine.
  virtual void exchange(std::span<const std::uint8_t> from_client, std::vector<std::uint8_t>& answer) = 0;

  /// What the client's own serial port is set to, bit/s, 0: hung up; told before each exchange. A line without a rate of its own
  /// takes any.
  virtual void set_rate(std::int64_t baud_Hz) { static_cast<void>(baud_Hz); }

  /// When the line will have something to say unasked: call `exchange` again then. None: nothing waits.
  [[nodiscard]] virtual std::optional<Clock::time_point> wake() const = 0;

 protected:
  SerialLine() = default;
  SerialLine(const SerialLine&) = default;
  SerialLine& operator=(const SerialLine&) = default;
};

}  // namespace vsa::bus
