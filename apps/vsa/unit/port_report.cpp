// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/port_report.hpp"

#include <fmt/format.h>

namespace vsa::app {

std::string port_report(const serial::PortCounters& port, std::uint64_t lost_bytes, std::uint64_t noise_bytes) {
  return fmt::format("{:<20}{}, {} bytes in, {} bytes out\n", "exchanges", port.exchanges, port.bytes_in, port.bytes_out) +
         fmt::format("{:<20}{} of answers that nobody read, {} of requests that came faster than the line, {} at another rate\n",
                     "bytes lost", port.bytes_dropped, lost_bytes, noise_bytes) +
         fmt::format("{:<20}{}\n", "clients gone", port.clients_gone) +
         fmt::format("{:<20}{:.3f} ms in the port, {:.3f} ms of that in the units\n", "longest service",
                     static_cast<double>(port.longest_service_ns) * 1e-6, static_cast<double>(port.longest_exchange_ns) * 1e-6);
}

std::string in_a_line(const serial::PortCounters& port) {
  return fmt::format("{} exchanges, {} bytes in, {} out, {} dropped; longest service {:.3f} ms", port.exchanges, port.bytes_in,
                     port.bytes_out, port.bytes_dropped, static_cast<double>(port.longest_service_ns) * 1e-6);
}

}  // namespace vsa::app
