// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vsa::config {

/// What a type's file tells about the device though no model needs it.
///
///   [type]
///   mass_kg = { value = 0.45, unit = "kg", source = "maker's leaflet" }
struct Stated {
  double value = 0;    ///< in the unit that its key names
  std::string source;  ///< where it came from
};

}  // namespace vsa::config
