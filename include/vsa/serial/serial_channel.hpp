// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A client's end of a serial port, virtual or real, as a bus::Channel. Time is the machine's.
#pragma once

#include <cstdint>
#include <string>

#include "vsa/bus/channel.hpp"
#include "vsa/bus/timing.hpp"

namespace vsa::serial {

constexpr std::int64_t kMostBaud_Hz = 100'000'000;  ///< beyond what any port has

/// A client's end of a serial port, virtual or real, opened for this program alone.
class SerialChannel final : public bus::Channel {
 public:
  /// Opens the port for this program alone: raw, eight bits, no parity, pending input thrown away. Two locks: flock, which our own
  /// programs look at, and TIOCEXCL, which keeps out others (not those of the administrator). Throws InputError: no such port, no
  /// serial port, taken, or a rate that isn't 1 to kMostBaud_Hz or that it can't do.
  explicit SerialChannel(const std::string& path, std::int64_t baud_Hz = bus::kDefaultBaud_Hz);
  ~SerialChannel() override;

  /// Waits up to a second for room.
  [[nodiscard]] bool write(std::span<const std::uint8_t> bytes) override;
  /// Where the port can be read, at least one byte; as bus::Channel has it.
  [[nodiscard]] std::optional<std::size_t> read(std::span<std::uint8_t> into, Time timeout) override;
  [[nodiscard]] Time now() const override;  ///< of the machine, monotonic

 private:
  int fd_ = -1;
};

}  // namespace vsa::serial
