// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The 18-bit word of an encoder (AS5045): position in bits 17…6, most significant first, five status bits, even parity. The unit
// looks at position and parity only: a word with an odd number of ones is as if nothing had come. The position counts against the
// unit's sense: sample = 32768 − 16·code.
//
// Sources: NMMI/qbmove-maker-pro 6.1 (encoder_reading, check_enc_data).
#pragma once

#include <cstdint>

#include "vsa/firmware/arithmetic.hpp"

namespace vsa::firmware {

inline constexpr std::uint32_t kEncoderWordMask = 0x3FFFF;  ///< of the 18 bits

/// Whether the number of ones is even.
[[nodiscard]] constexpr bool parity_even(std::uint32_t word) noexcept {
  word &= kEncoderWordMask;
  for (int half = 16; half > 0; half /= 2) word ^= word >> half;
  return (word & 1) == 0;
}

/// A sample within the turn as TickInputs has it: −32768…32752 in steps of 16.
[[nodiscard]] constexpr std::int32_t encoder_sample_of(std::uint32_t word) noexcept {
  return cut_16(32768 - static_cast<std::int32_t>((word & 0x3FFC0) >> 2));
}

/// The word of a sample; `status` are the five bits between position and parity.
[[nodiscard]] constexpr std::uint32_t encoder_word(std::int32_t sample, std::uint32_t status = 0) noexcept {
  const auto code = static_cast<std::uint32_t>(32768 - sample) >> 4 & 0xFFF;
  const std::uint32_t word = code << 6 | (status & 0x1F) << 1;
  return parity_even(word) ? word : word | 1;
}

}  // namespace vsa::firmware
