// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vsa::generate {

/// An 8-bit grey PNG. The pixels are stored without compression, so that the bytes don't depend on a compressor's version.
[[nodiscard]] std::string grey_png(int width, int height, const std::vector<std::uint8_t>& pixels);

}  // namespace vsa::generate
