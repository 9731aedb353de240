// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/position_loop.hpp"

#include <algorithm>
#include <cstdlib>

#include "vsa/firmware/arithmetic.hpp"

namespace vsa::firmware {
namespace {

constexpr std::int32_t kPwmMax = 100;
constexpr std::int32_t kErrorSumMax = 100000;
constexpr std::int32_t kFarError = 131072;    // 2¹⁷: beyond it the P product is shifted early
constexpr std::int32_t kTurnJump = 49152;     // a jump past this is the wrap of the turn
constexpr std::int32_t kSuspectJump = 16384;  // a quarter turn in a tick is not believed …
constexpr std::uint8_t kBelieveAfter = 10;    // … unless it stays for ten ticks
constexpr std::int32_t kFilterAlpha = 3;      // of 1024 a tick: τ ≈ 341 ms

/// Percent PWM that gives about 8 V, by supply in steps of 512 mV from 8 V. The makers measured these.
constexpr std::array<std::uint8_t, 36> kEightVoltPwm{100, 76, 71, 69, 67, 65, 63, 61, 60, 58, 57, 56, 55, 54, 53, 52, 51, 50,
                                                     49,  49, 48, 47, 47, 46, 45, 45, 45, 44, 44, 43, 43, 43, 43, 42, 42, 42};

void read_encoder(LoopState& s, int i, std::int32_t sample) noexcept {
  if (s.first_tick) s.last_sample[i] = sample;
  const std::int32_t jump = sample - s.last_sample[i];
  if (jump > kTurnJump) {
    s.turns[i] = static_cast<std::int8_t>(s.turns[i] - 1);
  } else if (jump < -kTurnJump) {
    s.turns[i] = static_cast<std::int8_t>(s.turns[i] + 1);
  } else if (std::abs(jump) > kSuspectJump && ++s.rejected[i] < kBelieveAfter) {
    return;
  }
  s.rejected[i] = 0;
  s.last_sample[i] = sample;
  s.meas[i] = wrap_add(sample, wrap_shl(s.turns[i], 16));
}

std::int32_t position_pid(const LoopParams& p, LoopState& s, int i) noexcept {
  const std::int32_t error = wrap_sub(s.ref[i], s.meas[i]);
  s.error_sum[i] = std::clamp(wrap_add(s.error_sum[i], error), -kErrorSumMax, kErrorSumMax);
  std::int32_t pwm = 0;
  if (p.kp != 0) {
    const bool far = error > kFarError || error < -kFarError;
    pwm = far ? wrap_mul(p.kp, error >> 8) >> 8 : wrap_mul(p.kp, error) >> 16;
  }
  if (p.ki != 0) pwm = wrap_add(pwm, wrap_mul(p.ki >> 6, s.error_sum[i]) >> 10);
  if (p.kd != 0) pwm = wrap_add(pwm, wrap_mul(p.kd, wrap_sub(s.meas_old[i], s.meas[i])) >> 16);
  return pwm;
}

void drive_motor(const LoopParams& p, LoopState& s, int i) noexcept {
  s.pwm[i] = std::clamp(position_pid(p, s, i), -kPwmMax, kPwmMax);
  // The limit in force is the one that the last tick's supply reading chose.
  s.duty[i] = p.supply_limit ? (((s.pwm[i] * 1024) / kPwmMax) * s.limit_pct) >> 10 : s.pwm[i];
}

std::int32_t sign(std::int32_t v) noexcept { return (v > 0) - (v < 0); }

void read_analog(LoopState& s, const TickInputs& in) noexcept {
  s.supply = {((in.supply_adc - 1638) * 1952) >> 7};
  if (s.supply.value <= 0) {
    s.current = {};
    return;
  }
  s.limit_pct = supply_limit_pct(s.supply);
  for (int i = 0; i < 2; ++i) {
    const std::int32_t mA = sign(s.duty[i]) * (((in.current_adc[i] - 1638) * 25771) >> 13);
    s.current_filter[i] = (s.current_filter[i] * (1024 - kFilterAlpha) + mA * 64 * kFilterAlpha) >> 10;
    s.current[i] = {s.current_filter[i] >> 6};
  }
}

}  // namespace

std::int32_t supply_limit_pct(MilliVolt supply) noexcept {
  if (supply.value > 25500) return 0;
  if (supply.value < 8000) return 100;
  return kEightVoltPwm[static_cast<std::size_t>((supply.value - 8000) >> 9)];
}

void set_inputs(const LoopParams& p, LoopState& s, std::array<Ticks, 2> inputs) noexcept {
  for (int i = 0; i < 2; ++i) {
    std::int32_t ref = wrap_shl(inputs[i].value, p.resolution[i]);
    if (p.limits_on) ref = std::max(std::min(ref, p.limits_raw[2 * i + 1]), p.limits_raw[2 * i]);
    s.ref_new[i] = ref;
  }
}

std::array<Ticks, 3> measurements(const LoopParams& p, const LoopState& s) noexcept {
  std::array<Ticks, 3> out;
  for (int i = 0; i < 3; ++i) out[i] = {static_cast<std::int16_t>(s.meas_old[i] >> p.resolution[i])};
  return out;
}

void tick(const LoopParams& p, LoopState& s, const TickInputs& in) noexcept {
  for (int i = 0; i < 3; ++i) read_encoder(s, i, in.encoder[i]);
  // The unit's memory of the last positions is zero at power-up; a first derivative kick of it is what the device does too, but
  // a unit that a simulator starts has been on for long: it begins with meas_old = meas.
  if (s.first_tick) s.meas_old = s.meas;
  s.first_tick = false;
  for (int i = 0; i < 2; ++i) drive_motor(p, s, i);
  read_analog(s, in);
  s.meas_old = s.meas;
  s.ref_old = s.ref;
  s.ref = s.ref_new;
}

}  // namespace vsa::firmware
