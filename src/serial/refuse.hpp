// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vsa/errors.hpp"

namespace vsa::serial {

/// Throws InputError: why the serial port isn't taken, and what would be.
[[noreturn]] inline void refuse(const std::string& port, const std::string& why, const std::string& allowed) {
  throw InputError({"", "serial port", port, why, allowed});
}

}  // namespace vsa::serial
