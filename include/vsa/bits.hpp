// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// std::bit_cast, which the library of g++ 10 doesn't have.
#pragma once

#include <cstring>
#include <type_traits>

namespace vsa {

/// The object with the same bytes.
template <class To, class From>
[[nodiscard]] To bits_as(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

}  // namespace vsa
