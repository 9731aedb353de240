// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vsa::fmu {

/// Of what an actuator's library has compiled in that isn't ours.
[[nodiscard]] std::string third_party_licences();

}  // namespace vsa::fmu
