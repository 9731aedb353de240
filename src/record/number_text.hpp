// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <string>

namespace vsa::record {

/// The shortest digits that read back the same number. A finite one is JSON as well.
template <class Number>
void put(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace vsa::record
