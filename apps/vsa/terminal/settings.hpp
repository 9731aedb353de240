// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"

namespace vsa::app {

/// "drive.friction_Nm=0.7" → an override. Throws InputError with every text that has no key or no value. `flag`: "--set".
[[nodiscard]] std::vector<config::Override> parse_settings(const std::vector<std::string>& texts, const std::string& flag);

}  // namespace vsa::app
