// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The kernel's functions for one instruction set, and which of them this machine has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "vsa/sensor/sensors.hpp"

namespace vsa::device {

class Unit;
struct UnitState;

/// What goes into a block's step and comes out: `width` numbers each.
struct BlockStep {
  double dt_s = 0;
  const double *angle = nullptr, *speed = nullptr, *inverse_inertia = nullptr, *free_acceleration = nullptr;
  const double* voltage[2]{};
  double* torque = nullptr;
  double *motor_angle[2]{}, *motor_speed[2]{};
};

/// What the trials of a block begin with: `width` numbers each, and what comes out.
struct BlockTrials {
  double dt_s = 0, reach = 0;
  const double *angle = nullptr, *speed = nullptr, *inverse_inertia = nullptr, *free_acceleration = nullptr;
  const double* voltage[2]{};
  double *free = nullptr, *last_torque = nullptr, *torque = nullptr, *slope = nullptr;
};

/// What goes into a block's tick: `width` numbers each, and what all units of a type have in common.
struct TickStep {
  const double *angle = nullptr, *motor_angle[2]{}, *motor_speed[2]{};
  double* voltage[2]{};              ///< held until now, and from now on
  sensor::EncoderParams encoder[3];  ///< motors, shaft
  double shaft_zero_rad = 0;
  double back_emf_Vs_per_rad[2]{}, resistance_Ohm[2]{};
  std::int32_t limit_pct = 0;        ///< what the supply allows
  const double* volts_of_duty[2]{};  ///< of each motor, of −100 … 100 %
};

/// How many numbers the rows of a solver's matrices are a multiple of (lanes/algebra.hpp): the lanes of the widest set.
inline constexpr std::size_t kBlock = 8;

/// A symmetric positive definite matrix of n rows as L D Lᵀ, in rows of `stride` numbers.
struct Factor {
  std::size_t n = 0, stride = 0;
  const double *lower = nullptr,  ///< L without its diagonal of ones, 0 elsewhere
      *upper = nullptr,           ///< Lᵀ likewise
          *reciprocal = nullptr;  ///< one row: 1/D
};

struct LaneTable {
  const char* name;
  int width;
  std::size_t block_bytes;  ///< aligned to 64
  void (*begin)(void* block) noexcept;
  void (*put)(void* block, int lane, UnitState& from) noexcept;
  void (*take)(void* block, int lane, UnitState& to) noexcept;
  // What a step writes before it reads it: begun once, kept for all blocks of a thread. To begin it anew costs 8 % of a step.
  std::size_t plan_bytes;  ///< aligned to 64
  void (*begin_plan)(void* plan) noexcept;
  /// Of units whose motors are driven, in a step of one segment. Returns a bit for each lane that didn't settle.
  unsigned (*step)(Unit& unit, void* block, void* plan, const BlockStep& io) noexcept;
  // A step that somebody else solves (vsa/device/joint_trials.hpp), with as much of a unit's as a step has; put and take serve here,
  // too. Bits are for lanes: of those that try, and of those that settled.
  std::size_t trials_bytes;                         ///< aligned to 64
  void (*begin_trials_plan)(void* block) noexcept;  ///< once, as begin_plan
  void (*begin_trials)(Unit& unit, void* block, const BlockTrials& io) noexcept;
  void (*attempt)(Unit& unit, void* block, const double* dy, bool rough, unsigned which, double* torque, double* slope) noexcept;
  unsigned (*carry)(const Unit& unit, const void* block, const double* move, double dt_s, double* torque, double* slope) noexcept;
  void (*finish)(const Unit& unit, void* block, const double* move, const double* torque, double dt_s) noexcept;
  // Of a block that stays in lanes: where its motors are, a row each, and where a shaft turned out to be.
  void (*motors)(const void* block, double* const angle[2], double* const speed[2]) noexcept;
  void (*observe)(void* block, int lane, double angle, double speed) noexcept;
  // The program's loop of units that do nothing but hold their references (lanes/loop.hpp).
  std::size_t loop_bytes;
  void (*put_loop)(void* loop, int lane, const UnitState& from) noexcept;
  void (*take_loop)(const void* loop, int lane, UnitState& to) noexcept;
  void (*tick)(void* loop, const TickStep& io) noexcept;
  void (*refer)(void* loop, int lane, const std::int32_t* refs) noexcept;
  // Matrices of a solver (lanes/algebra.hpp).
  void (*add_product)(const double* matrix, std::size_t rows, std::size_t stride, const double* x, double* y) noexcept;
  void (*substitute)(const Factor& factor, double* x) noexcept;
};

/// Those that this machine can run, the fastest first; the last runs on any.
[[nodiscard]] std::span<const LaneTable> lane_tables();
/// One of them by its name; empty: the first. Throws InputError.
[[nodiscard]] const LaneTable& lane_table(std::string_view instructions);

}  // namespace vsa::device
