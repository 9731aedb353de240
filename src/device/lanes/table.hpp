// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The kernel's functions for one instruction set, and which of them this machine has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "vsa/sensor/sensors.hpp"

namespace vsa::device {

class Unit;
struct UnitState;

/// What goes into a block's step and comes out: `width` numbers each.
struct BlockStep {
  double dt_s = 0;
  const double *angle = nullptr, *speed = nullptr, *inverse_inertia = nullptr;
  const double* voltage[2]{};
  double* torque = nullptr;
  double *motor_angle[2]{}, *motor_speed[2]{};
};

/// What goes into a block's tick: `width` numbers each, and what all units of a type have in common.
struct TickStep {
  const double *angle = nullptr, *motor_angle[2]{}, *motor_speed[2]{};
  double* voltage[2]{};  ///< held until now, and from now on
  sensor::EncoderParams encoder;
  double shaft_zero_rad = 0, back_emf_Vs_per_rad = 0, resistance_Ohm = 0;
  std::int32_t limit_pct = 0;             ///< what the supply allows
  const double* volts_of_duty = nullptr;  ///< of −100 … 100 %
};

struct LaneTable {
  const char* name;
  int width;
  std::size_t block_bytes;  ///< aligned to 64
  void (*begin)(void* block) noexcept;
  void (*put)(void* block, int lane, UnitState& from) noexcept;
  void (*take)(void* block, int lane, UnitState& to) noexcept;
  /// Of units whose motors are driven, in a step of one segment. Returns a bit for each lane that didn't settle.
  unsigned (*step)(Unit& unit, void* block, const BlockStep& io) noexcept;
  // The program's loop of units that do nothing but hold their references (lanes/loop.hpp).
  std::size_t loop_bytes;
  void (*put_loop)(void* loop, int lane, const UnitState& from) noexcept;
  void (*take_loop)(const void* loop, int lane, UnitState& to) noexcept;
  void (*tick)(void* loop, const TickStep& io) noexcept;
  void (*refer)(void* loop, int lane, const std::int32_t* refs) noexcept;
};

/// Those that this machine can run, the fastest first; the last runs on any.
[[nodiscard]] std::span<const LaneTable> lane_tables();

}  // namespace vsa::device
