// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The controller (controller.hpp) in control mode 0 with the few parameters that a simulated actuator's preset has. For a unit with
// its bus, memory and other modes see program.hpp.
//
// A reference that arrives during tick k is copied at the end of tick k+1's motor stage and acts at the next: 1–2 ms later. With
// kp = 0.1, 5.49° of error is full PWM.
//
// Two departures from a power-up, for a unit that a simulator starts has been on for long: the first derivative has no kick
// (measOld = meas), and the supply limit is there at once.
#pragma once

#include <array>
#include <cstdint>

#include "vsa/firmware/controller.hpp"
#include "vsa/units.hpp"

namespace vsa::firmware {

struct LoopParams {
  std::int32_t kp = 6553, ki = 0, kd = 52428;  ///< 16.16 fixed point: 0.1, 0, 0.8 truncated as the firmware does
  std::array<std::int32_t, 4> limits_raw{-30000, 30000, -30000, 30000};  ///< inf1, sup1, inf2, sup2
  bool limits_on = true;
  std::array<int, 3> resolution{1, 1, 1};  ///< 0…8
  bool supply_limit = true;                ///< false: full duty at any supply (advanced unit)
  bool operator==(const LoopParams&) const = default;
};

struct LoopState : ControllerState {
  LoopState() noexcept { limit_pct = 100; }
  bool motors_on = false;
};

/// The parameter memory that these parameters mean.
[[nodiscard]] Memory memory_of(const LoopParams& p) noexcept;

/// SET_INPUTS: ticks << resolution, clamped to the limits if they are on. Acts from the tick after next at the latest.
void set_inputs(const LoopParams& p, LoopState& s, std::array<Ticks, 2> inputs) noexcept;

/// What GET_MEASUREMENTS answers: the previous tick's positions >> resolution, cut to 16 bits.
[[nodiscard]] std::array<Ticks, 3> measurements(const LoopParams& p, const LoopState& s) noexcept;

/// One tick; leaves pwm, duty and limit_pct for the bridge.
void tick(const LoopParams& p, LoopState& s, const TickInputs& in) noexcept;

}  // namespace vsa::firmware
