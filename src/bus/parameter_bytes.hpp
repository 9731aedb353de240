// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One parameter's values as bytes, for the list.
#pragma once

#include "vsa/bus/bytes.hpp"
#include "vsa/bus/parameters.hpp"

namespace vsa::bus {

void write_value(ByteWriter& out, const ParameterValues& values, ParameterId id) noexcept;
void read_value(ByteReader& in, ParameterValues& values, ParameterId id) noexcept;

}  // namespace vsa::bus
