// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Random ticks of a unit's controller from a seed, the same on every machine: parameters, references, encoder words and ADC counts,
// with overflows, lost turns, wrong parity and limits turned inside out. What the committed vectors (data/) were made of.
#pragma once

#include <array>
#include <cstdint>

#include "vsa/firmware/controller.hpp"
#include "vsa/firmware/encoder_word.hpp"

namespace vsa::firmware::test {

/// SplitMix64.
struct Random {
  std::uint64_t state;

  std::uint64_t next() noexcept {
    std::uint64_t z = state += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  std::uint32_t below(std::uint32_t n) noexcept { return static_cast<std::uint32_t>((next() >> 32) * n >> 32); }
  bool one_in(std::uint32_t n) noexcept { return below(n) == 0; }
  std::int32_t any() noexcept { return static_cast<std::int32_t>(next() >> 32); }
  std::int32_t within(std::int32_t size) noexcept {
    return static_cast<std::int32_t>(below(2 * static_cast<std::uint32_t>(size) + 1)) - size;
  }
};

inline constexpr int kTicksPerSettings = 250;

class Scenario {
 public:
  Scenario(Model model, int mode) noexcept : model_(model), mode_(mode) {
    random_.state = 0x5EED0000ULL + 16 * static_cast<std::uint64_t>(mode) + (model == Model::advanced ? 8 : 0);
  }

  // What the next tick finds. `new_settings` and `new_references` say that these changed since the last tick.
  Memory stored, current;
  bool new_settings = false, new_references = false;
  bool zeroed = false;  ///< turns were cleared and the samples are to be reset
  std::array<std::int32_t, 2> references{};
  Orders orders{};
  std::array<std::uint32_t, 3> words{};
  std::array<std::int16_t, 3> adc{};  ///< supply, current 1, current 2

  void next() noexcept {
    new_settings = count_++ % kTicksPerSettings == 0;
    if (new_settings) choose_settings();
    zeroed = random_.one_in(2000);
    if (zeroed)
      for (std::int32_t& offset : stored.offset) offset = random_.one_in(8) ? random_.any() : random_.within(33000);
    new_references = random_.one_in(16);
    if (new_references) choose_references();
    for (int i = 0; i < 3; ++i) turn(i);
    adc[0] = random_.one_in(20) ? low_or_any() : counts(1800);
    for (int i = 1; i < 3; ++i) adc[i] = random_.one_in(40) ? low_or_any() : counts(2457);
  }

  [[nodiscard]] TickInputs inputs() const noexcept {
    TickInputs in;
    for (int i = 0; i < 3; ++i) {
      in.encoder[i] = encoder_sample_of(words[i]);
      in.encoder_ok[i] = parity_even(words[i]);
    }
    in.supply_adc = adc[0];
    in.current_adc = {adc[1], adc[2]};
    return in;
  }

 private:
  std::int32_t gain() noexcept {
    switch (random_.below(8)) {
      case 0:
      case 1:
        return 0;
      case 2:
        return random_.any();
      case 3:
        return random_.within(1000);
      default:
        return random_.within(8 << 16);
    }
  }
  Gains gains() noexcept {
    Gains k;
    k.p = gain();
    k.i = gain();
    k.d = gain();
    return k;
  }
  std::int16_t counts(std::uint32_t span) noexcept { return static_cast<std::int16_t>(1638 + random_.below(span)); }
  std::int16_t low_or_any() noexcept {
    return random_.one_in(4) ? cut_16(random_.any()) : static_cast<std::int16_t>(random_.below(1700));
  }
  std::int32_t reference() noexcept {
    switch (random_.below(8)) {
      case 0:
        return random_.any();
      case 1:
        return random_.within(1 << 24);
      case 2:
      case 3:
        return random_.within(200000);
      case 4:
        return random_.within(300);
      default:
        return random_.within(30000);
    }
  }

  void choose_settings() noexcept {
    current = {};
    current.position = gains();
    current.current = gains();
    current.double_position = gains();
    current.double_current = gains();
    current.current_limit_mA = random_.one_in(4) ? cut_16(random_.any()) : static_cast<std::int16_t>(random_.below(3000));
    current.input_mode = random_.one_in(8) ? 1 : 0;
    current.control_mode = static_cast<std::uint8_t>(mode_);
    current.limits_on = static_cast<std::uint8_t>(random_.below(2));
    for (int i = 0; i < 2; ++i) {
      current.limit_low[i] = random_.one_in(8) ? random_.any() : -static_cast<std::int32_t>(random_.below(60000));
      current.limit_high[i] = random_.one_in(8) ? random_.any() : static_cast<std::int32_t>(random_.below(60000));
    }
    for (int i = 0; i < 3; ++i) {
      current.multiplier[i] = random_.one_in(8) ? static_cast<float>(random_.within(2048)) / 512.0F : 1.0F;
      current.resolution[i] = static_cast<std::uint8_t>(random_.below(9));
    }
    current.max_pwm_rate = random_.one_in(2) ? 255 : static_cast<std::uint8_t>(random_.below(256));
    const auto offset = stored.offset;
    stored = current;
    stored.offset = offset;
    for (std::uint8_t& bits : stored.resolution)
      bits = static_cast<std::uint8_t>(random_.one_in(16) ? random_.below(32) : random_.below(9));
  }

  void choose_references() noexcept {
    for (std::int32_t& r : references) r = reference();
    orders.onoff = static_cast<std::uint8_t>(random_.one_in(4) ? 0 : 3);
    for (int i = 0; i < 2; ++i) {
      orders.current_mA[i] = random_.within(32767);
      orders.pwm[i] = random_.within(200);
    }
  }

  /// Mostly a walk; sometimes a jump, some of exactly a half and three quarters of a turn; sometimes a flipped bit.
  void turn(int i) noexcept {
    if (random_.one_in(400)) speed_[i] = random_.within(200);
    code_[i] += static_cast<std::uint32_t>(speed_[i] + random_.within(4));
    if (random_.one_in(300)) code_[i] += random_.one_in(2) ? 1024 * random_.below(4) : random_.below(4096);
    words[i] = encoder_word(encoder_sample_of(code_[i] << 6), random_.below(32));
    if (random_.one_in(50)) words[i] ^= 1U << random_.below(18);
  }

  Model model_;
  int mode_;
  Random random_{};
  std::uint64_t count_ = 0;
  std::array<std::uint32_t, 3> code_{};
  std::array<std::int32_t, 3> speed_{};
};

/// What a tick leaves: the unit's output registers, positions, currents, references.
struct TickRecord {
  static constexpr int kFields = 24;
  std::array<std::int32_t, kFields> field{};
  bool operator==(const TickRecord&) const = default;
};

inline TickRecord record_of(const ControllerState& s) noexcept {
  TickRecord r;
  int n = 0;
  const auto put = [&](std::int32_t v) { r.field[n++] = v; };
  for (int i = 0; i < 2; ++i) put(s.duty[i] < 0 ? -s.duty[i] : s.duty[i]);
  put((s.forward[0] ? 1 : 0) + (s.forward[1] ? 2 : 0));
  for (const std::int8_t v : s.current_sign) put(v);
  for (const std::int32_t v : s.meas) put(v);
  for (const std::int32_t v : s.meas_old) put(v);
  for (const std::int8_t v : s.turns) put(v);
  for (const MilliAmp v : s.current) put(v.value);
  for (const MilliAmp v : s.current_old) put(v.value);
  put(s.supply.value);
  put(s.limit_pct);
  for (const std::int32_t v : s.ref) put(v);
  put(s.ref_old[0]);
  put(s.orders.onoff);
  return r;
}

/// FNV-1a over the fields' bytes, lowest first.
struct Hash {
  std::uint64_t value = 0xCBF29CE484222325ULL;
  void add(const TickRecord& r) noexcept {
    for (const std::int32_t field : r.field)
      for (int shift = 0; shift < 32; shift += 8)
        value = (value ^ (static_cast<std::uint32_t>(field) >> shift & 0xFF)) * 0x100000001B3ULL;
  }
};

}  // namespace vsa::firmware::test
