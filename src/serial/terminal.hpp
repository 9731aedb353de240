// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace vsa::serial {

/// Eight bits, no parity, nothing changed on the way, reads that wait for one byte, no modem lines. False: no terminal.
[[nodiscard]] bool make_raw(int fd) noexcept;
/// Whatever its rate and read's time limits are.
[[nodiscard]] bool is_raw(int fd) noexcept;

/// What the terminal sends at, bit/s; of our end of a pseudo-terminal: what the other end is set to. 0: hung up, or no terminal.
[[nodiscard]] std::int64_t baud_of(int fd) noexcept;

/// Any rate. False: the device can't come within 2.5 % of it.
[[nodiscard]] bool set_baud(int fd, std::int64_t baud_Hz) noexcept;

}  // namespace vsa::serial
