// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// From a type's file as written, and overrides, to validated parameters.
#pragma once

#include "config/document.hpp"
#include "vsa/config/actuator_type.hpp"

namespace vsa::config {

/// What is usable of the type; it counts only where no problem was added.
[[nodiscard]] ActuatorType build_type(const Document& document, const std::vector<Override>& overrides, const LawRegistry& laws,
                                      Problems& problems);

/// Leads the key of a Problem that an override has.
inline constexpr std::string_view kOverrideMark = "override ";

}  // namespace vsa::config
