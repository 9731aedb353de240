// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>

namespace vsa::device {

/// A number as a message shows it: six digits.
[[nodiscard]] inline std::string text_of(double v) {
  std::ostringstream out;
  out << v;
  return out.str();
}

}  // namespace vsa::device
