// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/master.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::bus {
namespace {

constexpr std::int64_t kMillisecondNs = 1'000'000;

std::int64_t byte_time_ps(double baud_Hz) noexcept { return std::llround(1e12 * kBitsPerByte / baud_Hz); }

/// Rounded up: a frame isn't there before its last bit.
std::int64_t bytes_ns(std::int64_t byte_ps, std::int64_t bytes) noexcept { return (bytes * byte_ps + 999) / 1000; }

}  // namespace

std::int64_t Schedule::inputs_at_ns(std::int64_t cycle_start_ns, int k) const noexcept {
  return cycle_start_ns + bytes_ns(byte_ps, std::int64_t{k} * kBytesPerUnit + kSetInputsBytes);
}

std::int64_t Schedule::request_at_ns(std::int64_t cycle_start_ns, int k) const noexcept {
  return cycle_start_ns + bytes_ns(byte_ps, std::int64_t{k} * kBytesPerUnit + kSetInputsBytes + kGetMeasurementsBytes);
}

std::int64_t Schedule::reply_at_ns(std::int64_t cycle_start_ns, int k) const noexcept {
  return cycle_start_ns + bytes_ns(byte_ps, std::int64_t{k + 1} * kBytesPerUnit);
}

std::int64_t wire_time_ns(int units, double baud_Hz) noexcept {
  return bytes_ns(byte_time_ps(baud_Hz), std::int64_t{units} * kBytesPerUnit);
}

Schedule make_schedule(int units, double baud_Hz, std::optional<double> cycle_s) noexcept {
  Schedule s;
  s.units = units;
  s.byte_ps = byte_time_ps(baud_Hz);
  s.cycle_ns = cycle_s ? std::llround(*cycle_s * 1e9) : std::max(wire_time_ns(units, baud_Hz), kMillisecondNs * units);
  return s;
}

}  // namespace vsa::bus
