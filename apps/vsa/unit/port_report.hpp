// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vsa/serial/virtual_port.hpp"

namespace vsa::app {

/// What a virtual port did, as lines of a summary. `lost_bytes`: of the client, in the units' receive buffer; `noise_bytes`: of a
/// client at another rate.
[[nodiscard]] std::string port_report(const serial::PortCounters& port, std::uint64_t lost_bytes, std::uint64_t noise_bytes);

/// The same without the units' part, in one line.
[[nodiscard]] std::string in_a_line(const serial::PortCounters& port);

}  // namespace vsa::app
