// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/exchange.hpp"

#include "vsa/firmware/arithmetic.hpp"

namespace vsa::firmware {
namespace {

/// As the program does it, lower limit first: crossed limits end at the upper one.
void keep_within_limits(const Memory& current, std::int32_t& ref, int i) noexcept {
  if (ref < current.limit_low[i]) ref = current.limit_low[i];
  if (ref > current.limit_high[i]) ref = current.limit_high[i];
}

bool follows_position(std::uint8_t mode) noexcept {
  const ControlMode m{mode};
  return m == ControlMode::position || m == ControlMode::position_current || m == ControlMode::deflection ||
         m == ControlMode::deflection_current;
}

}  // namespace

void set_inputs(Model model, LoopMemory m, ControllerState& s, std::array<Ticks, 2> inputs) noexcept {
  const bool advanced = model == Model::advanced;
  const ControlMode mode{m.stored.control_mode};
  for (int i = 0; i < 2; ++i) {
    const std::int32_t value = inputs[i].value;
    if (advanced && mode == ControlMode::current)
      s.orders_new.current_mA[i] = value;
    else if (advanced && mode == ControlMode::pwm)
      s.orders_new.pwm[i] = value;
    else
      s.ref_new[i] = wrap_shl(advanced ? -value : value, m.stored.resolution[i]);
  }
  const bool limited = !advanced || mode == ControlMode::position || mode == ControlMode::position_current;
  for (int i = 0; i < 2 && limited && m.current.limits_on != 0; ++i) keep_within_limits(m.current, s.ref_new[i], i);
}

void set_position_stiffness(Model model, LoopMemory m, ControllerState& s, Ticks position, std::int16_t stiffness) noexcept {
  const std::int32_t reach = m.current.max_stiffness;
  const std::int32_t high = wrap_sub(m.current.limit_high[0], reach);
  const std::int32_t low = wrap_add(m.current.limit_low[0], reach);
  std::int32_t centre = wrap_shl(position.value, m.stored.resolution[0]);
  if (centre > high) centre = high;
  if (centre < low) centre = low;
  const std::int32_t spread = truncate(static_cast<float>(reach) / 32768.0F * static_cast<float>(stiffness));
  const std::array<std::int32_t, 2> refs{wrap_add(centre, spread), wrap_sub(centre, spread)};
  for (int i = 0; i < 2; ++i) s.ref_new[i] = model == Model::advanced ? wrap_sub(0, refs[i]) : refs[i];
}

std::uint8_t request_activation(LoopMemory m, ControllerState& s, std::uint8_t flags) noexcept {
  s.orders_new.onoff = flags;
  if (follows_position(m.stored.control_mode)) s.ref_new = {s.meas[0], s.meas[1]};
  for (const std::int32_t position : s.meas)
    if (position > kActivationLimit || position < -kActivationLimit) s.orders_new.onoff = 0;
  return s.orders_new.onoff;
}

void set_offsets(Memory& stored, ControllerState& s, std::array<Ticks, 3> offsets) noexcept {
  for (int i = 0; i < 3; ++i) stored.offset[i] = wrap_shl(offsets[i].value, stored.resolution[i]);
  s.turns = {};
  s.reset_samples = true;
}

void move_references(LoopMemory m, ControllerState& s) noexcept {
  if (m.current.input_mode != 0) return;
  for (int i = 0; i < 2; ++i) {
    if (m.current.multiplier[i] != m.stored.multiplier[i]) {
      s.ref_new[i] = truncate(static_cast<float>(s.ref_new[i]) / m.current.multiplier[i]);
      s.ref_new[i] = truncate(static_cast<float>(s.ref_new[i]) * m.stored.multiplier[i]);
    }
    s.ref_new[i] = wrap_add(s.ref_new[i], wrap_sub(m.stored.offset[i], m.current.offset[i]));
    if (m.current.limits_on != 0) keep_within_limits(m.current, s.ref_new[i], i);
  }
}

std::array<Ticks, 3> positions(Model model, const Memory& stored, const ControllerState& s) noexcept {
  std::array<Ticks, 3> out;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t ticks = shift_right(s.meas_old[i], stored.resolution[i]);
    out[i] = {cut_16(model == Model::advanced ? wrap_sub(0, ticks) : ticks)};
  }
  return out;
}

std::array<Ticks, 2> inputs(const Memory& stored, const ControllerState& s) noexcept {
  std::array<Ticks, 2> out;
  for (int i = 0; i < 2; ++i) out[i] = {cut_16(shift_right(s.ref_old[i], stored.resolution[i]))};
  return out;
}

std::array<std::int16_t, 2> currents_mA(const ControllerState& s) noexcept {
  return {cut_16(s.current_old[0].value), cut_16(s.current_old[1].value)};
}

}  // namespace vsa::firmware
