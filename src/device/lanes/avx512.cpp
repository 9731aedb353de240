// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "device/lanes/kernel.hpp"

namespace vsa::device {

struct Avx512;

LaneTable lanes_of_avx512() noexcept { return lane_kernel::table<lanes::Pack<8, Avx512>>("avx512"); }

}  // namespace vsa::device
