// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/controller.hpp"
#include "vsa/firmware/loop_steps.hpp"

namespace vsa::firmware {
namespace {

/// Percent PWM of version 3.0, by supply in steps of 500 mV above 8 V.
constexpr std::array<std::int32_t, 10> kFirstPwm{80, 76, 75, 74, 72, 71, 69, 68, 66, 64};

/// Percent PWM of version 6.1, by supply in steps of 512 mV from 8 V: 6.4 … 10.6 V at the motor. The makers measured these; the
/// last is never reached.
constexpr std::array<std::uint8_t, 36> kEightVoltPwm{100, 76, 71, 69, 67, 65, 63, 61, 60, 58, 57, 56, 55, 54, 53, 52, 51, 50,
                                                     49,  49, 48, 47, 47, 46, 45, 45, 45, 44, 44, 43, 43, 43, 43, 42, 42, 42};

/// The advanced unit reads the motors' words the other way round, and the shaft's with its offset negated.
std::int32_t with_offset(bool advanced, std::int32_t sample, std::int32_t offset, int i) noexcept {
  if (!advanced) return cut_16(wrap_add(sample, offset));
  const std::int32_t value = wrap_add(wrap_sub(0, sample), offset);
  return cut_16(i == 2 ? wrap_sub(0, value) : value);
}

std::int32_t adc_counts(int adc) noexcept { return cut_16(adc - steps::kAdcOffset); }

}  // namespace

void Controller::read_encoder(LoopMemory m, ControllerState& s, const TickInputs& in, int i) const noexcept {
  if (s.reset_samples) {
    if (!advanced() || repairs.zeros_reset_samples) s.last_sample = {};
    s.reset_samples = false;
  }
  if (!in.encoder_ok[i]) return;
  const std::int32_t sample = with_offset(advanced(), in.encoder[i], m.stored.offset[i], i);
  if (s.first_tick) {
    s.last_sample[i] = sample;
    s.first_tick = i != 2;
  }
  if (!steps::follow_word(sample, repairs.jump_check_in_16_bits, s.last_sample[i], s.turns[i], s.rejected[i])) return;
  std::int32_t position = steps::unwrapped(sample, s.turns[i]);
  const float multiplier = m.current.multiplier[i];
  if (multiplier != 1.0F) position = truncate(static_cast<float>(position) * multiplier);
  s.meas[i] = position;
}

void Controller::read_analog(ControllerState& s, const TickInputs& in) const noexcept {
  s.supply = supply_reading(in.supply_adc);
  if (s.supply.value <= 0) {
    s.current = {};
    return;
  }
  s.supply_seen = true;
  s.limit_pct = supply_table ? supply_limit_pct(s.supply, generation) : 100;
  for (int i = 0; i < 2; ++i) {
    s.current_filter[i] = steps::filtered(s.current_filter[i], s.current_sign[i], in.current_adc[i]);
    s.current[i] = {s.current_filter[i] >> 6};
  }
}

MilliVolt supply_reading(int adc) noexcept { return {wrap_mul(adc_counts(adc), 1952) >> 7}; }

std::int32_t supply_limit_pct(MilliVolt supply, Generation generation) noexcept {
  const std::int32_t over = supply.value - 8000;
  if (generation == Generation::v2) return 100;
  if (generation == Generation::v3) {
    if (over > 5000) return 0;
    return over <= 0 ? 100 : kFirstPwm[static_cast<std::size_t>((over - 1) / 500)];
  }
  if (supply.value > 25500) return 0;
  if (over < 0) return 100;
  return kEightVoltPwm[static_cast<std::size_t>(generation == Generation::v6 ? over >> 9 : over / 500)];
}

}  // namespace vsa::firmware
