// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Arithmetic as the unit's processor and compiler do it: two's complement, wrapping, never undefined; `int` has 16 bits, `double`
// is single precision.
#pragma once

#include <cstdint>
#include <limits>

namespace vsa::firmware {

/// A + b in two's complement, as the next ones.
constexpr std::int32_t wrap_add(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
/// A − b.
constexpr std::int32_t wrap_sub(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
/// A · b, its lower 32 bits.
constexpr std::int32_t wrap_mul(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}
/// The processor shifts bit by bit, so that any count has a meaning: 32 and more leave nothing …
constexpr std::int32_t wrap_shl(std::int32_t a, int bits) noexcept {
  return bits > 31 ? 0 : static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << bits);
}
/// … or only the sign.
constexpr std::int32_t shift_right(std::int32_t a, int bits) noexcept { return a >> (bits > 31 ? 31 : bits); }

/// Cut to 16 bits.
constexpr std::int16_t cut_16(std::int32_t a) noexcept {
  return static_cast<std::int16_t>(static_cast<std::uint32_t>(a) & 0xFFFFU);
}
/// −a in 16 bits: −32768 stays what it is.
constexpr std::int16_t negate_16(std::int16_t a) noexcept { return cut_16(-std::int32_t{a}); }
/// |a| of the lower 16 bits, as the library's abs(int): 32768 → −32768, 49152 → 16384.
constexpr std::int16_t abs_16(std::int32_t a) noexcept {
  const std::int16_t cut = cut_16(a);
  return cut < 0 ? negate_16(cut) : cut;
}

/// Toward zero. Out of range the device's library isn't documented: here it saturates, and NaN is 0.
constexpr std::int32_t truncate(float v) noexcept {
  if (v >= 2147483648.0F) return std::numeric_limits<std::int32_t>::max();
  if (v < -2147483648.0F) return std::numeric_limits<std::int32_t>::min();
  return v == v ? static_cast<std::int32_t>(v) : 0;
}

}  // namespace vsa::firmware
