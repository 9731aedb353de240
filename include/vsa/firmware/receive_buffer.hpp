// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The serial port's receive buffer: a ring of 32 bytes that an interrupt fills while the program is busy. When it runs over, the
// write index passes the read index, so that one byte seems to be there; the main loop then clears it.
//
// Source: the port's generated driver in NMMI/qbmove-advanced (UART_RS485_INT.c).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vsa::firmware {

/// The serial port's ring of 32 bytes between interrupt and program.
struct ReceiveBuffer {
  static constexpr std::uint8_t kSize = 32;  ///< bytes

  std::array<std::uint8_t, kSize> bytes{};  ///< in the ring
  std::uint8_t read = 0,                    ///< place of the next that is taken
      write = 0;                            ///< place of the next that comes
  bool full = false;                        ///< as many bytes wait as there is room for
  bool overflow = false;                    ///< it ran over, and one byte seems to be there

  /// What comes while it is full overwrites what waits.
  void push(std::uint8_t byte) noexcept {
    bytes[write] = byte;
    overflow = overflow || full;
    write = static_cast<std::uint8_t>((write + 1) % kSize);
    full = full || read == write;
  }
  [[nodiscard]] bool empty() const noexcept { return read == write && !full; }  ///< nothing waits
  /// The next, whether or not one waits.
  std::uint8_t pop() noexcept {
    const std::uint8_t byte = bytes[read];
    read = static_cast<std::uint8_t>((read + 1) % kSize);
    full = false;
    return byte;
  }
  /// `count` bytes came and were taken; the buffer is empty before and after.
  void pass(std::size_t count) noexcept { read = write = static_cast<std::uint8_t>((write + count) % kSize); }
  /// As the main loop does when it ran over.
  void clear() noexcept {
    read = write = 0;
    full = overflow = false;
  }
  static auto fields(auto& s, auto&& visit) {
    return visit("bytes", "", s.bytes, "read", "", s.read, "write", "", s.write, "full", "", s.full, "overflow", "", s.overflow);
  }
  [[nodiscard]] constexpr const char* impossible() const noexcept {
    return read < kSize && write < kSize && (!full || overflow || read == write) ? nullptr
                                                                                 : "read and write below 32, equal if full";
  }
};

}  // namespace vsa::firmware
