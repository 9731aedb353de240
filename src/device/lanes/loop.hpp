// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit's tick in lanes: encoders, position loop, supply limit, current filter and bridges of units that do nothing else (plain():
// position mode of version 6.1 from the bus, no line, no faults, supply and motors on). What a tick leaves alone stays in the unit's
// state.
#pragma once

#include <cstring>

#include "device/lanes/table.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/firmware/loop_steps.hpp"

// Lanes of a loop don't depend on each other, and its W rounds are to become one of vectors, not W of single numbers. Only AVX-512 has
// the conversions that make it worth it.
#if defined(__AVX512DQ__) && defined(__GNUC__) && !defined(__clang__)
#define VSA_LANES _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#else
#define VSA_LANES
#endif

namespace vsa::device::lane_kernel {

template <class T>
[[nodiscard]] T load(const double* from) noexcept {
  T p;
  std::memcpy(&p.v, from, sizeof p.v);
  return p;
}
template <class T>
void store(T p, double* to) noexcept {
  std::memcpy(to, &p.v, sizeof p.v);
}

template <int W, class Isa>
struct Loop {
  using T = lanes::Pack<W, Isa>;
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

  // What a loop reads beside the lanes is copied before it: a compiler knows that nothing else points there.

  void read_encoders(const TickStep& io) noexcept {
    const double* angle[3] = {io.motor_angle[0], io.motor_angle[1], io.angle};
    for (int e = 0; e < 3; ++e) {
      const sensor::EncoderParams encoder = io.encoder[e];
      const double zero = e == 2 ? io.shaft_zero_rad : 0.0;
      double counts[W];
      // The shaft's zero is added as Unit::read_sensors does; a motor's angle plus 0 would lose the sign of −0 only.
      const T at = load<T>(angle[e]);
      store(sensor::encoder_counts<T>(encoder, e == 2 ? at + zero : at), counts);
      VSA_LANES
      for (int l = 0; l < W; ++l) word[e][l] = sensor::encoder_word(encoder, counts[l]);
      VSA_LANES
      for (int l = 0; l < W; ++l) {
        const std::int32_t sample = firmware::steps::low_16(firmware::wrap_add(word[e][l], offset[e][l]));
        const bool believed = firmware::steps::follow_word(sample, false, last_sample[e][l], turns[e][l], rejected[e][l]);
        meas[e][l] = believed ? firmware::steps::unwrapped(sample, turns[e][l]) : meas[e][l];
      }
    }
  }

  void drive(int m, std::int32_t limit_pct) noexcept {
    using namespace firmware;
    VSA_LANES
    for (int l = 0; l < W; ++l) {
      const std::int32_t error = wrap_sub(ref[m][l], meas[m][l]);
      error_sum[m][l] = steps::limited_sum(error_sum[m][l], error, loop_facts(Generation::v6).sum_max);
      const std::int32_t asked =
          steps::position_pwm(p[l], i[l], d[l], error, error_sum[m][l], wrap_sub(meas_old[m][l], meas[m][l]));
      forward[m][l] = 1 + steps::negative(asked);
      pwm[m][l] = std::clamp(asked, -steps::kPwmMax, steps::kPwmMax);
      const std::int32_t out = steps::limited_pwm(pwm[m][l], limit_pct);
      sign[m][l] = 1 | steps::negative(out);
      duty[m][l] = steps::signed_duty(forward[m][l] != 0, out);
    }
  }

  void tick(const TickStep& io) noexcept {
    std::int32_t adc[2][W];
    for (int m = 0; m < 2; ++m) {
      double counts[W];
      const T back_emf = io.back_emf_Vs_per_rad[m] * load<T>(io.motor_speed[m]);
      store(sensor::current_counts<T>((load<T>(io.voltage[m]) - back_emf) / io.resistance_Ohm[m]), counts);
      VSA_LANES
      for (int l = 0; l < W; ++l) adc[m][l] = sensor::adc(counts[l]);
    }
    read_encoders(io);
    for (int m = 0; m < 2; ++m) {
      drive(m, io.limit_pct);
      VSA_LANES
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

#undef VSA_LANES
