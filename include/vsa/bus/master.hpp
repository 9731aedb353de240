// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Who speaks when on a chain of units, in simulated time.
//
// Each cycle the master sends, for every unit in id order, SET_INPUTS (10 bytes, no reply) and GET_MEASUREMENTS (6 bytes, reply
// 12 bytes). A byte is 10 bits (8N1). With N units and B baud, unit k (0 = first) has its new references at
//     t_k = t_cycle + (k·28 + 10)·10/B,
// so at 2 Mbaud unit 12 hears 11·140 µs = 1.54 ms after unit 1. The cycle is max(N·28·10/B, 1 ms·N) unless it is set; 1 ms a unit
// is the published guidance for hosts. This is the timing model; the bytes themselves come with the device twin.
//
// Sources: NMMI/qbmove-maker-pro 6.1 (frame layout), NMMI/qbAPI (order of calls).
#pragma once

#include <cstdint>
#include <optional>

#include "vsa/bus/timing.hpp"

namespace vsa::bus {

inline constexpr int kSetInputsBytes = 10;
inline constexpr int kGetMeasurementsBytes = 6;
inline constexpr int kMeasurementsReplyBytes = 12;
inline constexpr int kBytesPerUnit = kSetInputsBytes + kGetMeasurementsBytes + kMeasurementsReplyBytes;

/// The schedule of one bus. All times are integer nanoseconds of simulated time.
struct Schedule {
  std::int64_t cycle_ns = 0;
  std::int64_t byte_ps = 0;  ///< a byte's time in picoseconds: exact for every standard rate
  int units = 0;

  /// When unit `k`'s SET_INPUTS frame is complete in the cycle that starts at `cycle_start_ns`.
  [[nodiscard]] std::int64_t inputs_at_ns(std::int64_t cycle_start_ns, int k) const noexcept;
  /// When the unit has received GET_MEASUREMENTS: what it answers is its last completed tick at that time.
  [[nodiscard]] std::int64_t request_at_ns(std::int64_t cycle_start_ns, int k) const noexcept;
  /// When the master has the unit's reply.
  [[nodiscard]] std::int64_t reply_at_ns(std::int64_t cycle_start_ns, int k) const noexcept;
};

/// Wire time of one whole cycle, ns.
[[nodiscard]] std::int64_t wire_time_ns(int units, double baud_Hz) noexcept;

/// cycle_s none: automatic. A set cycle shorter than the wire time is the caller's error (config refuses it).
[[nodiscard]] Schedule make_schedule(int units, double baud_Hz, std::optional<double> cycle_s) noexcept;

}  // namespace vsa::bus
