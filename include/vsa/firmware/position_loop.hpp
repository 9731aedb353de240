// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit's 1 kHz integer position loop (control mode 0), as its own program does it. Other modes, the protocol and the parameter
// memory come with the device twin and have their rooms here.
//
//   e    = ref − meas                                   raw, 65536 a turn
//   P    = (kp·e) >> 16,  or (kp·(e >> 8)) >> 8 when |e| > 2¹⁷
//   I    = ((ki >> 6)·Σe) >> 10,  Σe clamped to ±100000
//   D    = (kd·(measOld − meas)) >> 16                  on the measurement
//   pwm  = clamp(P + I + D, ±100)                        integer percent
//   duty = (((pwm << 10)/100)·limit) >> 10               limit: percent, by supply voltage (table of 36 steps of 512 mV)
// Gains are 16.16 fixed point in percent PWM per tick; shifts are arithmetic (floor). With kp = 0.1, 5.49° of error is full PWM.
//
// Order of a tick: encoders → motors → current filter → measOld := meas; refOld := ref; ref := refNew. A reference that arrives
// during tick k is copied at the end of tick k+1's motor stage and acts at the next: 1–2 ms later.
//
// Source: NMMI/qbmove-maker-pro 6.1.
#pragma once

#include <array>
#include <cstdint>

#include "vsa/units.hpp"

namespace vsa::firmware {

inline constexpr std::int64_t kTickNs = 1'000'000;

struct LoopParams {
  std::int32_t kp = 6553, ki = 0, kd = 52428;  ///< 16.16 fixed point: 0.1, 0, 0.8 truncated as the firmware does
  std::array<std::int32_t, 4> limits_raw{-30000, 30000, -30000, 30000};  ///< inf1, sup1, inf2, sup2
  bool limits_on = true;
  std::array<int, 3> resolution{1, 1, 1};  ///< 0…8
  bool supply_limit = true;                ///< false: full duty at any supply (advanced unit)
  bool operator==(const LoopParams&) const = default;
};

struct LoopState {
  std::array<std::int32_t, 3> meas{}, meas_old{};  ///< multi-turn raw positions: motor 1, motor 2, shaft
  std::array<std::int32_t, 3> last_sample{};
  std::array<std::int8_t, 3> turns{};
  std::array<std::uint8_t, 3> rejected{};  ///< consecutive jumps discarded
  std::array<std::int32_t, 2> ref{}, ref_old{}, ref_new{};
  std::array<std::int32_t, 2> error_sum{};
  std::array<std::int32_t, 2> pwm{};             ///< percent before the supply limit, ±100
  std::array<std::int32_t, 2> duty{};            ///< percent after it
  std::array<std::int32_t, 2> current_filter{};  ///< the filter's memory, mA << 6
  std::array<MilliAmp, 2> current{};             ///< filtered, signed by pwm
  MilliVolt supply{};
  std::int32_t limit_pct = 100;  ///< supply-dependent limit in force
  bool motors_on = false;
  bool first_tick = true;
};

/// What the electronics hand to a tick.
struct TickInputs {
  std::array<std::int32_t, 3> encoder{};  ///< samples within the turn, raw (sensor::encoder_sample)
  std::array<int, 2> current_adc{};
  int supply_adc = 0;
};

/// Percent of full duty that keeps about 8 V at the motor: 100 up to 8 V, 61 at 12 V, 43 at 24 V, 0 above 25.5 V.
[[nodiscard]] std::int32_t supply_limit_pct(MilliVolt supply) noexcept;

/// SET_INPUTS: ticks << resolution, clamped to the limits if they are on. Acts from the tick after next at the latest.
void set_inputs(const LoopParams& p, LoopState& s, std::array<Ticks, 2> inputs) noexcept;

/// What GET_MEASUREMENTS answers: the previous tick's positions >> resolution, cut to 16 bits.
[[nodiscard]] std::array<Ticks, 3> measurements(const LoopParams& p, const LoopState& s) noexcept;

/// One tick; leaves pwm, duty and limit_pct for the bridge.
void tick(const LoopParams& p, LoopState& s, const TickInputs& in) noexcept;

}  // namespace vsa::firmware
