// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "device/lanes/kernel.hpp"

namespace vsa::device {

struct Avx2;

LaneTable lanes_of_avx2() noexcept { return lane_kernel::table<lanes::Pack<4, Avx2>>("avx2"); }

}  // namespace vsa::device
