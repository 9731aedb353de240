// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/controller.hpp"

#include <algorithm>

#include "vsa/firmware/loop_steps.hpp"

namespace vsa::firmware {
namespace {

using steps::kPwmMax;
using steps::proportional;

constexpr std::int32_t kCurrentSumMax = 100000;

std::int32_t add_clamped(std::int32_t& sum, std::int32_t error, std::int32_t most = kCurrentSumMax) noexcept {
  return sum = steps::limited_sum(sum, error, most);
}

/// The program tests the upper bound first and looks at the lower one only if that held; a negative limit turns it inside out.
std::int32_t limit_current(std::int32_t value, std::int16_t limit) noexcept {
  if (value > limit) return limit;
  return std::max<std::int32_t>(value, negate_16(limit));
}

bool deflecting(ControlMode mode) noexcept { return mode == ControlMode::deflection || mode == ControlMode::deflection_current; }

}  // namespace

std::int32_t Controller::position_error(LoopMemory m, ControllerState& s, int i) const noexcept {
  std::int32_t target = s.ref[i];
  if (deflecting(ControlMode{m.current.control_mode}))
    target = advanced() ? wrap_sub(0, wrap_sub(s.ref[i], s.meas[2])) : wrap_add(s.ref[i], s.meas[2]);
  const std::int32_t error = wrap_sub(target, s.meas[i]);
  add_clamped(s.error_sum[i], error, loop_facts(generation).sum_max);
  return error;
}

std::int32_t Controller::position_law(LoopMemory m, ControllerState& s, int i) const noexcept {
  const Gains& k = m.current.position;
  const std::int32_t error = position_error(m, s, i);
  if (loop_facts(generation).plain_products) {
    const std::int32_t pi = wrap_add(wrap_mul(k.p, error) >> 16, wrap_mul(k.i, s.error_sum[i]) >> 16);
    return wrap_add(pi, wrap_mul(k.d, wrap_sub(s.meas_driven[i], s.meas[i])) >> 16);
  }
  return steps::position_pwm(k.p, k.i, k.d, error, s.error_sum[i], wrap_sub(s.meas_old[i], s.meas[i]));
}

std::int32_t Controller::double_law(LoopMemory m, ControllerState& s, int i) const noexcept {
  const Gains& kp = m.current.double_position;
  const std::int32_t error = position_error(m, s, i);
  std::int32_t wanted = wrap_add(proportional(kp.p, error), wrap_mul(kp.i, s.error_sum[i]) >> 16);
  wanted = wrap_add(wanted, wrap_mul(kp.d, wrap_sub(s.meas_old[i], s.meas[i])) >> 16);
  wanted = limit_current(wanted, m.current.current_limit_mA);

  const Gains& kc = m.current.double_current;
  const std::int32_t now = s.current[i].value;
  const std::int32_t before = repairs.double_loop_current_derivative ? s.current_before[i].value : s.current_old[i].value;
  const std::int32_t current_error = wrap_sub(wanted, now);
  add_clamped(s.current_error_sum[i], current_error);
  const std::int32_t pwm = wrap_add(wrap_mul(kc.p, current_error) >> 16, wrap_mul(kc.i, s.current_error_sum[i]) >> 16);
  return wrap_add(pwm, wrap_mul(kc.d, wrap_sub(before, now)) >> 16);
}

std::int32_t Controller::current_law(LoopMemory m, ControllerState& s, int i) const noexcept {
  const Gains& k = m.current.current;
  const std::int32_t asked = advanced() ? s.orders.current_mA[i] : shift_right(s.ref[i], m.stored.resolution[i]);
  const std::int32_t error = wrap_sub(limit_current(asked, m.current.current_limit_mA), s.current[i].value);
  add_clamped(s.current_error_sum[i], error);
  const std::int32_t pi = wrap_add(wrap_mul(k.p, error) >> 16, wrap_mul(k.i, s.current_error_sum[i] >> 6) >> 10);
  const std::int32_t derivative = wrap_mul(k.d, wrap_sub(error, s.current_error_before[i])) >> 16;
  s.current_error_before[i] = error;
  return wrap_add(pi, derivative);
}

/// Only a full duty is limited, upward or downward.
void Controller::limit_rate(LoopMemory m, ControllerState& s, int i) const noexcept {
  std::int32_t& before = s.rate_before[repairs.pwm_rate_per_motor ? i : 0];
  const std::int32_t rate = m.current.max_pwm_rate;
  std::int32_t& pwm = s.pwm[i];
  if (pwm - before > rate && pwm == kPwmMax) pwm = before + rate;
  if (pwm - before < -rate && pwm == -kPwmMax) pwm = before - rate;
  before = pwm = std::clamp(pwm, -kPwmMax, kPwmMax);
  if (repairs.pwm_rate_per_motor) s.forward[i] = pwm >= 0;
}

void Controller::drive_motor(LoopMemory m, ControllerState& s, int i) const noexcept {
  if (m.current.input_mode == 1) {
    s.ref[i] = s.meas_old[2];
    if (m.current.limits_on != 0) {
      if (s.ref[i] < m.current.limit_low[i]) s.ref[i] = m.current.limit_low[i];
      if (s.ref[i] > m.current.limit_high[i]) s.ref[i] = m.current.limit_high[i];
    }
  }
  const ControlMode mode{m.current.control_mode};
  std::int32_t pwm = 0;
  bool drives = true;
  switch (mode) {
    case ControlMode::position:
    case ControlMode::deflection:
      pwm = position_law(m, s, i);
      break;
    case ControlMode::position_current:
    case ControlMode::deflection_current:
      pwm = double_law(m, s, i);
      break;
    case ControlMode::current:
      drives = !advanced() || (s.orders.onoff != 0 && s.supply_seen);
      if (drives) pwm = current_law(m, s, i);
      break;
    case ControlMode::pwm:
      pwm = advanced() ? s.orders.pwm[i] : shift_right(s.ref[i], m.stored.resolution[i]);
      break;
    default:
      drives = false;
      break;
  }
  if (drives) s.forward[i] = pwm >= 0;
  s.pwm[i] = std::clamp(pwm, -kPwmMax, kPwmMax);
  if (advanced()) limit_rate(m, s, i);
  // The limit in force is the one that the last tick's supply reading chose.
  const std::int32_t scaled = ((s.pwm[i] * 1024) / kPwmMax) * s.limit_pct;
  const std::int32_t limited = loop_facts(generation).plain_products ? scaled / 1024 : steps::limited_pwm(s.pwm[i], s.limit_pct);
  const std::int32_t out = mode == ControlMode::pwm ? s.pwm[i] : limited;
  s.current_sign[i] = out >= 0 ? 1 : -1;
  s.duty[i] = steps::signed_duty(s.forward[i], out);
}

void Controller::drive_motors(LoopMemory m, ControllerState& s) const noexcept {
  const std::uint8_t ticks = loop_facts(generation).ticks;
  if (ticks > 1 && ++s.loop_phase < ticks) return;
  s.loop_phase = 0;
  for (int i = 0; i < 2; ++i) drive_motor(m, s, i);
  s.meas_driven = {s.meas[0], s.meas[1]};
}

void Controller::end_tick(ControllerState& s) noexcept {
  s.meas_old = s.meas;
  s.current_before = s.current_old;
  s.current_old = s.current;
  s.ref_old = s.ref;
  s.ref = s.ref_new;
  s.orders_old = s.orders;
  s.orders = s.orders_new;
}

void Controller::tick(LoopMemory m, ControllerState& s, const TickInputs& in) const noexcept {
  for (int i = 0; i < 3; ++i) read_encoder(m, s, in, i);
  drive_motors(m, s);
  read_analog(s, in);
  end_tick(s);
}

}  // namespace vsa::firmware
