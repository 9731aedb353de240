// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit's tick in lanes: encoders, position loop, supply limit, current filter and bridges of units that do nothing else (plain():
// position mode of version 6.1 from the bus, no line, no faults, supply and motors on). What a tick leaves alone stays in the unit's
// state.
#pragma once

#include "device/lanes/table.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/firmware/loop_steps.hpp"

namespace vsa::device::lane_kernel {

template <int W, class Isa>
struct Loop {
  using Row = std::int32_t[W];
  Row meas[3], meas_old[3], last_sample[3], turns[3], rejected[3], offset[3], word[3];
  Row ref[2], ref_old[2], ref_new[2], error_sum[2], pwm[2], duty[2], forward[2], sign[2], filter[2], current_old[2],
      current_before[2];
  Row p, i, d;

  void put(int lane, const UnitState& s) noexcept {
    const firmware::ControllerState& c = s.program.loop;
    for (int e = 0; e < 3; ++e) {
      const auto n = static_cast<std::size_t>(e);
      meas[e][lane] = c.meas[n];
      meas_old[e][lane] = c.meas_old[n];
      last_sample[e][lane] = c.last_sample[n];
      turns[e][lane] = std::int32_t{c.turns[n]};
      rejected[e][lane] = c.rejected[n];
      offset[e][lane] = s.program.memory.stored.offset[n];
      word[e][lane] = s.last_encoder[n];
    }
    for (int m = 0; m < 2; ++m) {
      const auto n = static_cast<std::size_t>(m);
      ref[m][lane] = c.ref[n];
      ref_old[m][lane] = c.ref_old[n];
      ref_new[m][lane] = c.ref_new[n];
      error_sum[m][lane] = c.error_sum[n];
      pwm[m][lane] = c.pwm[n];
      duty[m][lane] = c.duty[n];
      forward[m][lane] = c.forward[n] ? 1 : 0;
      sign[m][lane] = std::int32_t{c.current_sign[n]};
      filter[m][lane] = c.current_filter[n];
      current_old[m][lane] = c.current_old[n].value;
      current_before[m][lane] = c.current_before[n].value;
    }
    const firmware::Gains& gains = s.program.memory.current.position;
    p[lane] = gains.p;
    i[lane] = gains.i;
    d[lane] = gains.d;
  }

  void take(int lane, UnitState& s) const noexcept {
    firmware::ControllerState& c = s.program.loop;
    for (int e = 0; e < 3; ++e) {
      const auto n = static_cast<std::size_t>(e);
      c.meas[n] = meas[e][lane];
      c.meas_old[n] = meas_old[e][lane];
      c.last_sample[n] = last_sample[e][lane];
      c.turns[n] = static_cast<std::int8_t>(turns[e][lane]);
      c.rejected[n] = static_cast<std::uint8_t>(rejected[e][lane]);
      s.last_encoder[n] = word[e][lane];
    }
    for (int m = 0; m < 2; ++m) {
      const auto n = static_cast<std::size_t>(m);
      c.ref[n] = ref[m][lane];
      c.ref_old[n] = ref_old[m][lane];
      c.ref_new[n] = ref_new[m][lane];
      c.error_sum[n] = error_sum[m][lane];
      c.pwm[n] = pwm[m][lane];
      c.duty[n] = duty[m][lane];
      c.forward[n] = forward[m][lane] != 0;
      c.current_sign[n] = static_cast<std::int8_t>(sign[m][lane]);
      c.current_filter[n] = filter[m][lane];
      c.current[n] = c.current_old[n] = {current_old[m][lane]};
      c.current_before[n] = {current_before[m][lane]};
      c.meas_driven[n] = meas[m][lane];
    }
    c.loop_phase = 0;
  }

  void read_encoders(const TickStep& io) noexcept {
    const double* angle[3] = {io.motor_angle[0], io.motor_angle[1], io.angle};
    for (int e = 0; e < 3; ++e) {
      const double zero = e == 2 ? io.shaft_zero_rad : 0.0;
      // The shaft's zero is added as Unit::read_sensors does; a motor's angle plus 0 would lose the sign of −0 only.
      for (int l = 0; l < W; ++l) word[e][l] = sensor::encoder_sample(io.encoder[e], e == 2 ? angle[e][l] + zero : angle[e][l]);
      for (int l = 0; l < W; ++l) {
        const std::int32_t sample = firmware::steps::low_16(firmware::wrap_add(word[e][l], offset[e][l]));
        const bool believed = firmware::steps::follow_word(sample, false, last_sample[e][l], turns[e][l], rejected[e][l]);
        meas[e][l] = believed ? firmware::steps::unwrapped(sample, turns[e][l]) : meas[e][l];
      }
    }
  }

  void drive(int m, const TickStep& io) noexcept {
    using namespace firmware;
    for (int l = 0; l < W; ++l) {
      const std::int32_t error = wrap_sub(ref[m][l], meas[m][l]);
      error_sum[m][l] = steps::limited_sum(error_sum[m][l], error, loop_facts(Generation::v6).sum_max);
      const std::int32_t asked =
          steps::position_pwm(p[l], i[l], d[l], error, error_sum[m][l], wrap_sub(meas_old[m][l], meas[m][l]));
      forward[m][l] = asked >= 0 ? 1 : 0;
      pwm[m][l] = std::clamp(asked, -steps::kPwmMax, steps::kPwmMax);
      const std::int32_t out = steps::limited_pwm(pwm[m][l], io.limit_pct);
      sign[m][l] = out >= 0 ? 1 : -1;
      duty[m][l] = steps::signed_duty(forward[m][l] != 0, out);
    }
  }

  void tick(const TickStep& io) noexcept {
    std::int32_t adc[2][W];
    for (int m = 0; m < 2; ++m)
      for (int l = 0; l < W; ++l)
        adc[m][l] =
            sensor::current_adc((io.voltage[m][l] - io.back_emf_Vs_per_rad[m] * io.motor_speed[m][l]) / io.resistance_Ohm[m]);
    read_encoders(io);
    for (int m = 0; m < 2; ++m) {
      drive(m, io);
      for (int l = 0; l < W; ++l) {
        filter[m][l] = firmware::steps::filtered(filter[m][l], sign[m][l], adc[m][l]);
        current_before[m][l] = current_old[m][l];
        current_old[m][l] = filter[m][l] >> 6;
        ref_old[m][l] = ref[m][l];
        ref[m][l] = ref_new[m][l];
      }
      for (int l = 0; l < W; ++l) io.voltage[m][l] = io.volts_of_duty[m][duty[m][l] + firmware::steps::kPwmMax];
    }
    for (int e = 0; e < 3; ++e)
      for (int l = 0; l < W; ++l) meas_old[e][l] = meas[e][l];
  }
};

template <int W, class Isa>
void put_loop(void* memory, int lane, const UnitState& from) noexcept {
  static_cast<Loop<W, Isa>*>(memory)->put(lane, from);
}
template <int W, class Isa>
void take_loop(const void* memory, int lane, UnitState& to) noexcept {
  static_cast<const Loop<W, Isa>*>(memory)->take(lane, to);
}
template <int W, class Isa>
[[gnu::flatten]] void tick(void* memory, const TickStep& io) noexcept {
  static_cast<Loop<W, Isa>*>(memory)->tick(io);
}
template <int W, class Isa>
void refer(void* memory, int lane, const std::int32_t* refs) noexcept {
  auto& loop = *static_cast<Loop<W, Isa>*>(memory);
  for (int m = 0; m < 2; ++m) loop.ref_new[m][lane] = refs[m];
}

}  // namespace vsa::device::lane_kernel
