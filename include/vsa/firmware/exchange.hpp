// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What commands do to the controller and read from it. Answers come from the last completed tick.
//
// Source: NMMI/qbmove-maker-pro 6.1 (command_processing.c); NMMI/qbmove-advanced 6.1.6, whose wire has the signs of positions
// inverted.
#pragma once

#include <array>
#include <cstdint>

#include "vsa/firmware/controller.hpp"
#include "vsa/units.hpp"

namespace vsa::firmware {

/// Beyond this a unit refuses to be switched on: the count of turns was lost.
inline constexpr std::int32_t kActivationLimit = 26000;

/// SET_INPUTS: ticks << resolution, clamped to the limits if the flag is set. Advanced: in modes 1 and 2 a reference of its own,
/// and limits in modes 0 and 3 only.
void set_inputs(Model model, LoopMemory m, ControllerState& s, std::array<Ticks, 2> inputs) noexcept;

/// SET_POS_STIFF: the position is clamped to [inf₁ + max_stiffness, sup₁ − max_stiffness] whatever the flag;
/// refs = position ± stiffness/32768·max_stiffness, in single precision, truncated.
void set_position_stiffness(Model model, LoopMemory m, ControllerState& s, Ticks position, std::int16_t stiffness) noexcept;

/// ACTIVATE up to the enable pins: new flags, references to where the motors are (modes 0, 3, 4, 5 of the stored set), flags to 0
/// if a position is beyond ±26000 raw. Returns the flags.
std::uint8_t request_activation(LoopMemory m, ControllerState& s, std::uint8_t flags) noexcept;

/// SET_ZEROS and parameter 8: stored offset = ticks << resolution; turns to 0; last samples to 0 at the next reading.
void set_offsets(Memory& stored, ControllerState& s, std::array<Ticks, 3> offsets) noexcept;

/// Before STORE_PARAMS: the new references follow changed multipliers and offsets, within the old limits.
void move_references(LoopMemory m, ControllerState& s) noexcept;

/// As GET_MEASUREMENTS has them: ticks of the last completed tick.
[[nodiscard]] std::array<Ticks, 3> positions(Model model, const Memory& stored, const ControllerState& s) noexcept;
/// As GET_INPUTS has them: the references of the last completed tick.
[[nodiscard]] std::array<Ticks, 2> inputs(const Memory& stored, const ControllerState& s) noexcept;
/// As GET_CURRENTS has them, of the last completed tick.
[[nodiscard]] std::array<std::int16_t, 2> currents_mA(const ControllerState& s) noexcept;

}  // namespace vsa::firmware
