// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace vsa::bus {

inline constexpr std::size_t kLongUnit = 32;  ///< bytes: dialect seven counts long packets in these

}  // namespace vsa::bus
