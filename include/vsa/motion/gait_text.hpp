// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "vsa/motion/gait.hpp"

namespace vsa::motion {

/// Gait::load from a text; `file` is what problems call it, and where it looks for its base.
[[nodiscard]] Gait parse_gait(std::string_view text, const std::filesystem::path& file);

}  // namespace vsa::motion
