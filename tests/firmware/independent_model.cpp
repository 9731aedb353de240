// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "independent_model.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::firmware::test {
namespace {

/// The residue of v modulo 2^bits in [−2^(bits−1), 2^(bits−1)).
std::int64_t residue(std::int64_t v, int bits) noexcept {
  const std::int64_t n = std::int64_t{1} << bits;
  std::int64_t r = v % n;
  if (r < 0) r += n;
  return r >= n / 2 ? r - n : r;
}
std::int64_t word(std::int64_t v) noexcept { return residue(v, 32); }

/// ⌊v / 2^bits⌋.
std::int64_t floor_part(std::int64_t v, int bits) noexcept {
  if (bits > 31) return v < 0 ? -1 : 0;
  const std::int64_t n = std::int64_t{1} << bits;
  return v >= 0 ? v / n : -((n - 1 - v) / n);
}

std::int64_t into(std::int64_t v, std::int64_t size) noexcept { return std::max(-size, std::min(size, v)); }

std::int64_t gain(std::int64_t k, std::int64_t v, int bits) noexcept { return floor_part(word(k * v), bits); }

std::int64_t stretched(std::int64_t k, std::int64_t e) noexcept {
  return e * e > (std::int64_t{1} << 34) ? gain(k, floor_part(e, 8), 8) : gain(k, e, 16);
}

std::int64_t kept_below(std::int64_t wish, std::int64_t limit) noexcept {
  return wish > limit ? limit : std::max(wish, residue(-limit, 16));
}

/// Percent for 8 V in steps of 0.512 V, from 8 V up.
std::int64_t eight_volts(std::int64_t millivolts) noexcept {
  static constexpr const char* digits =
      "100 76 71 69 67 65 63 61 60 58 57 56 55 54 53 52 51 50 49 49 48 47 47 46 45 45 45 44 44 43 43 43 43 42 42";
  if (millivolts < 8000) return 100;
  if (millivolts > 25500) return 0;
  const char* p = digits;
  for (std::int64_t skip = (millivolts - 8000) / 512; skip > 0; --skip)
    while (*p++ != ' ') continue;
  std::int64_t v = 0;
  for (; *p >= '0' && *p <= '9'; ++p) v = 10 * v + (*p - '0');
  return v;
}

}  // namespace

void IndependentUnit::zero() noexcept {
  turns_ = {};
  samples_to_zero_ = true;
}

void IndependentUnit::encoder(const Scenario& in, int i) noexcept {
  if (samples_to_zero_) last_ = {};
  samples_to_zero_ = false;
  int ones = 0;
  for (int bit = 0; bit < 18; ++bit) ones += static_cast<int>(in.words[i] >> bit & 1);
  if (ones % 2 != 0) return;
  const std::int64_t code = in.words[i] / 64 % 4096;
  const std::int64_t sample = residue(32768 - 16 * code + in.stored.offset[i], 16);
  if (fresh_) last_[i] = sample;
  if (fresh_ && i == 2) fresh_ = false;
  const std::int64_t jump = sample - last_[i];
  if (jump > 49152) {
    turns_[i] = residue(turns_[i] - 1, 8);
  } else if (jump < -49152) {
    turns_[i] = residue(turns_[i] + 1, 8);
  } else {
    const std::int64_t seen = residue(jump, 16);
    const std::int64_t size = seen == -32768 ? seen : std::llabs(seen);
    if (size > 16384) {
      ++doubts_[i];
      if (doubts_[i] < 10) return;
    }
  }
  doubts_[i] = 0;
  last_[i] = sample;
  position_[i] = sample + 65536 * turns_[i];
  const float by = in.current.multiplier[i];
  if (by != 1.0F) position_[i] = static_cast<std::int64_t>(std::trunc(static_cast<float>(position_[i]) * by));
}

std::int64_t IndependentUnit::position_error(const Memory& m, int i) noexcept {
  const bool deflection = m.control_mode == 4 || m.control_mode == 5;
  const std::int64_t e = word(word(reference_[i] + (deflection ? position_[2] : 0)) - position_[i]);
  sum_[i] = into(word(sum_[i] + e), 100000);
  return e;
}

std::int64_t IndependentUnit::position_pid(const Memory& m, int i) noexcept {
  const std::int64_t e = position_error(m, i);
  const std::int64_t p = stretched(m.position.p, e);
  const std::int64_t integral = gain(floor_part(m.position.i, 6), sum_[i], 10);
  const std::int64_t d = gain(m.position.d, word(position_before_[i] - position_[i]), 16);
  return word(p + integral + d);
}

std::int64_t IndependentUnit::double_pid(const Memory& m, int i) noexcept {
  const std::int64_t e = position_error(m, i);
  const std::int64_t moved = word(position_before_[i] - position_[i]);
  const Gains &outer = m.double_position, &inner = m.double_current;
  const std::int64_t wish = word(stretched(outer.p, e) + gain(outer.i, sum_[i], 16) + gain(outer.d, moved, 16));
  const std::int64_t error = word(kept_below(wish, m.current_limit_mA) - current_[i]);
  current_sum_[i] = into(word(current_sum_[i] + error), 100000);
  // The derivative's two samples are the same one.
  return word(gain(inner.p, error, 16) + gain(inner.i, current_sum_[i], 16));
}

std::int64_t IndependentUnit::current_pid(const Scenario& in, int i) noexcept {
  const Gains& k = in.current.current;
  const std::int64_t wish = floor_part(reference_[i], in.stored.resolution[i]);
  const std::int64_t error = word(kept_below(wish, in.current.current_limit_mA) - current_[i]);
  current_sum_[i] = into(word(current_sum_[i] + error), 100000);
  const std::int64_t change = word(error - current_error_[i]);
  current_error_[i] = error;
  return word(gain(k.p, error, 16) + gain(k.i, floor_part(current_sum_[i], 6), 10) + gain(k.d, change, 16));
}

void IndependentUnit::motor(const Scenario& in, int i) noexcept {
  const Memory& m = in.current;
  if (m.input_mode == 1) {
    reference_[i] = position_before_[2];
    if (m.limits_on != 0)
      reference_[i] = std::min<std::int64_t>(std::max<std::int64_t>(reference_[i], m.limit_low[i]), m.limit_high[i]);
  }
  std::int64_t pwm = 0;
  if (m.control_mode == 0 || m.control_mode == 4) pwm = position_pid(m, i);
  if (m.control_mode == 3 || m.control_mode == 5) pwm = double_pid(m, i);
  if (m.control_mode == 2) pwm = current_pid(in, i);
  if (m.control_mode == 1) pwm = floor_part(reference_[i], in.stored.resolution[i]);
  if (m.control_mode <= 5) forward_[i] = pwm >= 0;
  pwm = into(pwm, 100);
  if (m.control_mode != 1) pwm = floor_part(pwm * 1024 / 100 * limit_, 10);
  sign_[i] = pwm < 0 ? -1 : 1;
  duty_[i] = std::llabs(pwm);
}

void IndependentUnit::analog(const Scenario& in) noexcept {
  supply_ = floor_part(word(residue(in.adc[0] - 1638, 16) * 1952), 7);
  for (int i = 0; i < 2; ++i) {
    if (supply_ <= 0) {
      current_[i] = 0;
      continue;
    }
    limit_ = eight_volts(supply_);
    const std::int64_t milliamps = sign_[i] * floor_part(word(residue(in.adc[1 + i] - 1638, 16) * 25771), 13);
    filter_[i] = floor_part(word(filter_[i] * 1021 + milliamps * 64 * 3), 10);
    current_[i] = floor_part(filter_[i], 6);
  }
}

void IndependentUnit::tick(const Scenario& in) noexcept {
  for (int i = 0; i < 3; ++i) encoder(in, i);
  for (int i = 0; i < 2; ++i) motor(in, i);
  analog(in);
  position_before_ = position_;
  current_before_ = current_;
  reference_before_ = reference_;
  reference_ = next_reference;
  onoff_ = next_onoff;
}

TickRecord IndependentUnit::record() const noexcept {
  TickRecord r;
  int n = 0;
  const auto put = [&](const auto& values) {
    for (const auto v : values) r.field[n++] = static_cast<std::int32_t>(v);
  };
  put(duty_);
  r.field[n++] = (forward_[0] ? 1 : 0) + (forward_[1] ? 2 : 0);
  put(sign_);
  put(position_);
  put(position_before_);
  put(turns_);
  put(current_);
  put(current_before_);
  put(std::array{supply_, limit_});
  put(reference_);
  put(std::array{reference_before_[0], std::int64_t{onoff_}});
  return r;
}

}  // namespace vsa::firmware::test
