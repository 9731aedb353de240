// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vsa::config {

/// How the element's <initial> calls a preset of that unit: "preset_rad", of N·m/rad "preset_Nm_per_rad". Empty: there is no preset.
[[nodiscard]] std::string preset_attribute(std::string_view unit);

}  // namespace vsa::config
