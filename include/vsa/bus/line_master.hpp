// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The master's end of a simulated line: who asks the units. Times are of the line, in picoseconds.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "vsa/bus/frame.hpp"
#include "vsa/bus/timing.hpp"

namespace vsa::bus {

inline constexpr std::int64_t kNeverPs = std::numeric_limits<std::int64_t>::max();  ///< never, in picoseconds

/// Who asks the units: the simulated master or a client on a port. The chain calls it, by the thread that runs the line.
class LineMaster {
 public:
  virtual ~LineMaster() = default;

  /// When its next bytes set out; kNeverPs: it has nothing to say.
  [[nodiscard]] virtual std::int64_t next_ps() const noexcept = 0;
  /// Those bytes, asked for once, when their time has come.
  virtual FrameBytes speak() noexcept = 0;
  /// A byte it hears, at the end of its stop bit.
  virtual void hear(std::uint8_t byte, std::int64_t end_ps) noexcept = 0;
  /// Bytes back to back that nobody disturbed; the last one ends at `end_ps`.
  virtual void hear_all(std::span<const std::uint8_t> bytes, std::int64_t end_ps, LineRate rate) noexcept {
    for (std::size_t k = 0; k < bytes.size(); ++k)
      hear(bytes[k], end_ps - rate.bytes_ps(static_cast<std::int64_t>(bytes.size() - k - 1)));
  }

 protected:
  LineMaster() = default;
  LineMaster(const LineMaster&) = default;
  LineMaster& operator=(const LineMaster&) = default;
};

}  // namespace vsa::bus
