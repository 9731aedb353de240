// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit's 1 kHz integer controller, all modes. One tick, in this order:
//
//   encoders 0, 1, 2 → motor 0 → motor 1 → supply and currents → measOld := meas; refOld := ref; ref := refNew
//
// A motor's drive uses this tick's positions, and the currents and the supply limit of the last tick.
//
//   e     = ref − meas                            modes 0, 3   (input mode 1: ref = measOld of encoder 3, within the limits)
//   e     = ref + shaft − meas                    modes 4, 5   (advanced: shaft − ref − meas)
//   Σe    clamped to ±100000, shared by modes 0, 3, 4, 5; never cleared
//   P(k)  = (k·e) >> 16, or (k·(e >> 8)) >> 8 when |e| > 2¹⁷
//   0, 4  pwm = P(kp) + ((ki >> 6)·Σe >> 10) + (kd·(measOld − meas) >> 16)
//   3, 5  i   = P(kp) + (ki·Σe >> 16) + (kd·(measOld − meas) >> 16), clamped to ± limit
//         pwm = (kp·ε >> 16) + (ki·Σε >> 16) + (kd·(iOld − i_meas) >> 16),  ε = i − i_meas, Σε clamped to ±100000.
//         iOld is the same sample as i_meas, so the last term is 0 (Repairs::double_loop_current_derivative).
//   2     i   = ref >> resolution, clamped;  pwm = (kp·ε >> 16) + (ki·(Σε >> 6) >> 10) + (kd·(ε − ε_before) >> 16)
//         advanced: i is a reference of its own, and nothing is done while off or before the first supply reading
//   1     pwm = ref >> resolution                 advanced: a reference of its own
//   else  pwm = 0, direction as it was
//   direction = pwm ≥ 0;  pwm clamped to ±100 (advanced: then the rate limit);  except in mode 1
//   duty  = (((pwm << 10)/100)·limit) >> 10       the division truncates, the shift floors: +1 % is lost, −1 % isn't
//
// Gains are 16.16 fixed point; shifts are arithmetic (floor); int32 wraps; `−limit` and |jump| have 16 bits.
//
// Encoder: 12-bit sample in the upper bits of 16 plus the offset, cut to 16 bits; a jump beyond 49152 is the wrap of the turn, one
// beyond 16384 is discarded nine times, then believed. Turns are an int8, 0 at power-up. A word with wrong parity is not looked at.
// Current: ((adc − 1638)·25771 >> 13) mA · sign(duty), sign(0) = +1; filter y := (1021·y + 3·(x << 6)) >> 10, current = y >> 6.
// Supply: (adc − 1638)·1952 >> 7 mV; at 0 or below, currents read 0, and limit and filters stay.
//
// Source: NMMI/qbmove-maker-pro 6.1 (interruptions.c, utils.c); NMMI/qbmove-advanced 6.1.6.
#pragma once

#include <array>
#include <cstdint>

#include "vsa/firmware/memory.hpp"
#include "vsa/firmware/model.hpp"
#include "vsa/units.hpp"

namespace vsa::firmware {

inline constexpr std::int64_t kTickNs = 1'000'000;  ///< of the program

/// What the program's loop holds: a position, a PWM, a current, a deflection, or one through another. Other values give no output.
enum class ControlMode : std::uint8_t {
  position = 0,
  pwm = 1,
  current = 2,
  position_current = 3,
  deflection = 4,
  deflection_current = 5,
};

/// What the electronics hand to a tick.
struct TickInputs {
  std::array<std::int32_t, 3> encoder{};             ///< samples within the turn, raw (sensor::encoder_sample): −32768…32767
  std::array<int, 2> current_adc{};                  ///< counts of the motors' current sensors
  int supply_adc = 0;                                ///< of the supply sensor
  std::array<bool, 3> encoder_ok{true, true, true};  ///< the word's parity
};

/// The rest of a set of references.
struct Orders {
  std::uint8_t onoff = 0;                    ///< 3 on, 0 off: what GET_ACTIVATE reports. The enable pins are the program's
  std::array<std::int32_t, 2> current_mA{};  ///< advanced, mode 2
  std::array<std::int32_t, 2> pwm{};         ///< advanced, mode 1
  static auto fields(auto& s, auto&& visit) {
    return visit("onoff", "", s.onoff, "current", "mA", s.current_mA, "pwm", "%", s.pwm);
  }
};

/// As at power-up.
struct ControllerState {
  std::array<std::int32_t, 3> meas{},         ///< multi-turn raw positions: motor 1, motor 2, shaft
      meas_old{};                             ///< of the last tick
  std::array<std::int32_t, 3> last_sample{};  ///< the last that was believed, offset added
  std::array<std::int8_t, 3> turns{};         ///< whole turns since power-up
  std::array<std::uint8_t, 3> rejected{};     ///< consecutive jumps discarded
  /// Raw references: in force, of the tick before, of the next.
  std::array<std::int32_t, 2> ref{},  ///< raw references in force
      ref_old{},                      ///< of the tick before
      ref_new{};                      ///< of the next
  /// Likewise of the rest of a set of references.
  Orders orders{},   ///< in force
      orders_old{},  ///< of the tick before
      orders_new{};  ///< of the next
  /// Σe of the positions, Σε of the currents, and the error of the tick before.
  std::array<std::int32_t, 2> error_sum{},        ///< Σe
      current_error_sum{},                        ///< Σε
      current_error_before{};                     ///< ε of the tick before
  std::array<std::int32_t, 2> pwm{};              ///< percent before the supply limit, ±100
  std::array<std::int32_t, 2> duty{};             ///< percent that goes out, signed by the direction pin
  std::array<bool, 2> forward{};                  ///< direction pins
  std::array<std::int8_t, 2> current_sign{1, 1};  ///< of the duty, for the current reading
  std::array<std::int32_t, 2> rate_before{};      ///< advanced: the rate limit's memory; as it is, only [0]
  std::array<std::int32_t, 2> current_filter{};   ///< the filter's memory, mA << 6
  /// Of this reading, of the tick before, and of the one before that.
  std::array<MilliAmp, 2> current{},          ///< of this tick
      current_old{},                          ///< of the tick before
      current_before{};                       ///< of the one before that
  MilliVolt supply{};                         ///< of this reading
  std::int32_t limit_pct = 0;                 ///< supply-dependent limit in force
  bool supply_seen = false;                   ///< whether there was a reading
  bool first_tick = true;                     ///< no sample of the third encoder was good yet: samples are taken as they are
  std::array<std::int32_t, 2> meas_driven{};  ///< positions at the last loop, where that isn't the last tick
  std::uint8_t loop_phase = 0;                ///< ticks since then
  bool reset_samples = false;                 ///< SET_ZEROS: the next reading starts from 0
  static auto fields(auto& s, auto&& visit) {
    return visit("meas", "raw", s.meas, "meas_old", "raw", s.meas_old, "last_sample", "raw", s.last_sample, "turns", "", s.turns,
                 "rejected", "", s.rejected, "ref", "raw", s.ref, "ref_old", "raw", s.ref_old, "ref_new", "raw", s.ref_new,
                 "orders", "", s.orders, "orders_old", "", s.orders_old, "orders_new", "", s.orders_new, "error_sum", "",
                 s.error_sum, "current_error_sum", "", s.current_error_sum, "current_error_before", "", s.current_error_before,
                 "pwm", "%", s.pwm, "duty", "%", s.duty, "forward", "", s.forward, "current_sign", "", s.current_sign,
                 "rate_before", "", s.rate_before, "current_filter", "", s.current_filter, "current", "mA", s.current,
                 "current_old", "mA", s.current_old, "current_before", "mA", s.current_before, "supply", "mV", s.supply, "limit",
                 "%", s.limit_pct, "supply_seen", "", s.supply_seen, "first_tick", "", s.first_tick, "meas_driven", "raw",
                 s.meas_driven, "loop_phase", "", s.loop_phase, "reset_samples", "", s.reset_samples);
  }
};

/// What the program makes of the ADC's counts.
[[nodiscard]] MilliVolt supply_reading(int adc) noexcept;
/// Percent of full duty by supply, of v6: 100 up to 8 V, 61 at 12 V, 43 at 24 V, 0 above 25.5 V; 6.4 … 10.6 V are left at the motor.
[[nodiscard]] std::int32_t supply_limit_pct(MilliVolt supply, Generation generation = Generation::v6) noexcept;

/// The two sets that the loop reads.
struct LoopMemory {
  const Memory& stored;   ///< what commands write
  const Memory& current;  ///< what the loop uses
};

/// The laws; no state of its own.
struct Controller {
  Model model = Model::maker_pro;          ///< which unit
  bool supply_table = true;                ///< false: full duty at any supply (the advanced unit)
  Repairs repairs{};                       ///< defects that are repaired
  Generation generation = Generation::v6;  ///< whose loop

  /// One encoder: jump, turns, meas.
  void read_encoder(LoopMemory m, ControllerState& s, const TickInputs& in, int i) const noexcept;
  /// Both motors, in the ticks in which the loop runs.
  void drive_motors(LoopMemory m, ControllerState& s) const noexcept;
  void drive_motor(LoopMemory m, ControllerState& s, int i) const noexcept;   ///< one motor of the last one
  void read_analog(ControllerState& s, const TickInputs& in) const noexcept;  ///< supply and both currents
  static void end_tick(ControllerState& s) noexcept;                          ///< what the sums and the samples before keep

  /// All of it.
  void tick(LoopMemory m, ControllerState& s, const TickInputs& in) const noexcept;

 private:
  [[nodiscard]] bool advanced() const noexcept { return model == Model::advanced; }
  std::int32_t position_error(LoopMemory m, ControllerState& s, int i) const noexcept;
  std::int32_t position_law(LoopMemory m, ControllerState& s, int i) const noexcept;
  std::int32_t double_law(LoopMemory m, ControllerState& s, int i) const noexcept;
  std::int32_t current_law(LoopMemory m, ControllerState& s, int i) const noexcept;
  void limit_rate(LoopMemory m, ControllerState& s, int i) const noexcept;
};

}  // namespace vsa::firmware
