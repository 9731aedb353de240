// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/run_data.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::record {

Cadence::Cadence(double rate_Hz) : period_ns_(std::max<std::int64_t>(1, std::llround(1e9 / rate_Hz))) {}

}  // namespace vsa::record
