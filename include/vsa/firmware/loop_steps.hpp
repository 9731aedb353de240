// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The parts of a tick that units in lanes take too (src/device/lanes/loop.hpp): of one motor or encoder, without branches where a
// compiler can take many at once. The members may be narrower than the int32 they are computed in.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/memory.hpp"

namespace vsa::firmware::steps {

inline constexpr std::int32_t kPwmMax = 100;         ///< %
inline constexpr std::int32_t kTurnJump = 49152;     ///< a jump past this is the wrap of the turn
inline constexpr std::int32_t kSuspectJump = 16384;  ///< a quarter turn in a tick is not believed …
inline constexpr std::int32_t kBelieveAfter = 10;    ///< … unless it stays for ten ticks
inline constexpr std::int32_t kFarError = 131072;    ///< 2¹⁷: beyond it the P product is shifted early
inline constexpr std::int32_t kAdcOffset = 1638;     ///< of zero current
inline constexpr std::int32_t kFilterAlpha = 3;      ///< of 1024 per tick: τ ≈ 341 ms

/// cut_16 in an int32: a narrower type would keep a compiler from taking many at once.
inline std::int32_t low_16(std::int32_t a) noexcept { return wrap_shl(a, 16) >> 16; }

/// A new word of an encoder, its offset added: the turns it tells of, and whether it is believed.
template <class Turns, class Rejected>
inline bool follow_word(std::int32_t sample, bool whole_jump, std::int32_t& last, Turns& turns, Rejected& rejected) noexcept {
  const std::int32_t jump = sample - last;
  const std::int32_t size = whole_jump ? (jump < 0 ? -jump : jump) : low_16(low_16(jump) < 0 ? -low_16(jump) : low_16(jump));
  const std::int32_t wraps = static_cast<std::int32_t>(jump < -kTurnJump) - static_cast<std::int32_t>(jump > kTurnJump);
  const std::int32_t suspect = static_cast<std::int32_t>(wraps == 0) & static_cast<std::int32_t>(size > kSuspectJump);
  const std::int32_t refused = (rejected + 1) & -suspect;
  const bool believed = (static_cast<std::int32_t>(refused == 0) | static_cast<std::int32_t>(refused >= kBelieveAfter)) != 0;
  turns = static_cast<Turns>(wrap_shl(turns + wraps, 24) >> 24);  // it wraps as the firmware's own 8 bits
  rejected = static_cast<Rejected>(believed ? 0 : refused);
  last = believed ? sample : last;
  return believed;
}

/// Raw over turns.
inline std::int32_t unwrapped(std::int32_t sample, std::int32_t turns) noexcept { return wrap_add(sample, wrap_shl(turns, 16)); }

/// P(k) of a gain in 16.16.
inline std::int32_t proportional(std::int32_t k, std::int32_t error) noexcept {
  const bool far = error > kFarError || error < -kFarError;
  return far ? wrap_mul(k, error >> 8) >> 8 : wrap_mul(k, error) >> 16;
}

/// % of the position loop of version 6.
inline std::int32_t position_pwm(std::int32_t p, std::int32_t i, std::int32_t d, std::int32_t error, std::int32_t error_sum,
                                 std::int32_t moved_back) noexcept {
  const std::int32_t integral = wrap_mul(i >> 6, error_sum) >> 10, derivative = wrap_mul(d, moved_back) >> 16;
  return wrap_add(wrap_add(proportional(p, error), integral), derivative);
}

/// Σ, cut to ± most.
inline std::int32_t limited_sum(std::int32_t sum, std::int32_t error, std::int32_t most) noexcept {
  return std::clamp(wrap_add(sum, error), -most, most);
}

/// What of a PWM the limit by the supply leaves, with the rounding of version 6.
inline std::int32_t limited_pwm(std::int32_t pwm, std::int32_t limit_pct) noexcept {
  return (((pwm * 1024) / kPwmMax) * limit_pct) >> 10;
}
/// −1 where negative, else 0.
inline std::int32_t negative(std::int32_t a) noexcept { return a >> 31; }
/// Signed by the direction.
inline std::int32_t signed_duty(bool forward, std::int32_t out) noexcept {
  const std::int32_t back = static_cast<std::int32_t>(forward) - 1;
  return (std::abs(out) ^ back) - back;
}

/// The filter's memory, mA << 6, after one more reading.
inline std::int32_t filtered(std::int32_t filter, std::int32_t sign, std::int32_t adc) noexcept {
  const std::int32_t now_mA = sign * (wrap_mul(low_16(adc - kAdcOffset), 25771) >> 13);
  return wrap_add(wrap_mul(filter, 1024 - kFilterAlpha), wrap_mul(wrap_shl(now_mA, 6), kFilterAlpha)) >> 10;
}

}  // namespace vsa::firmware::steps
