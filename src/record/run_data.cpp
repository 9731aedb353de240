// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/run_data.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::record {

// Of the lowest rates a period is as long as one can be of which two are still a time.
Cadence::Cadence(double rate_Hz) : period_ns_(std::llround(std::clamp(1e9 / rate_Hz, 1.0, 4e18))) {}

}  // namespace vsa::record
