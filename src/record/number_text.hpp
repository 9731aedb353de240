// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <string>
#include <type_traits>
#ifndef __cpp_lib_to_chars
#include <fmt/format.h>

#include <iterator>
#endif

namespace vsa::record {

/// The shortest digits that read back the same number. A finite one is JSON as well.
template <class Number>
void put(std::string& text, Number value) {
#ifndef __cpp_lib_to_chars  // g++ 10's has it for integers only; fmt finds the same digits, but may write their exponent otherwise
  if constexpr (std::is_floating_point_v<Number>) {
    fmt::format_to(std::back_inserter(text), "{}", value);
    return;
  } else
#endif
  {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
}

}  // namespace vsa::record
