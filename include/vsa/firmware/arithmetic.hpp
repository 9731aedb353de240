// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// 32-bit arithmetic as the unit's processor does it: two's complement, wrapping, never undefined.
#pragma once

#include <cstdint>

namespace vsa::firmware {

constexpr std::int32_t wrap_add(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
constexpr std::int32_t wrap_sub(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
constexpr std::int32_t wrap_mul(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}
constexpr std::int32_t wrap_shl(std::int32_t a, int bits) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << bits);
}

}  // namespace vsa::firmware
