// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "device/lanes/kernel.hpp"

namespace vsa::device {

struct Any;

LaneTable lanes_of_any() noexcept { return lane_kernel::table<lanes::Pack<2, Any>>("any"); }

}  // namespace vsa::device
