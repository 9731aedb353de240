// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Many units of one type, each alone on a shaft of its own: for identification, control and learning, where no bodies are simulated.
//
//   vsa::device::UnitBatch units(config, 64);
//   units.command(i, 0.5, 0.3);
//   units.step(1'000'000, angle, speed, inverse_inertia, torque);     // one number a unit in each array
//
// The physics goes in lanes (vsa/lanes.hpp), as many units side by side as the machine's vectors hold. A unit goes bit for bit as
// Unit::step would take it, whatever its neighbours do and whatever the machine. What lanes don't do, the scalar path does, a block at
// a time: laws other than TwoSinh, motors with inductance or on a modulated enable pin (all units of such a type), a motor that isn't
// driven, a shaft that was placed, steps with a tick inside or longer than a segment.
//
// Units have no line: commands come as if SET_INPUTS had just arrived.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "vsa/device/unit.hpp"

namespace vsa::device {

/// Many units of one type, each alone on a shaft of its own and without a line, stepped together in lanes: bit for bit as
/// Unit::step would take them. One thread calls.
class UnitBatch {
 public:
  /// All begin at time 0, at rest at equilibrium 0 and preset 0, the shaft at 0 (Unit::initial). `instructions`: "avx512", "avx2" or
  /// "any"; empty: the fastest that this machine has. InputError: no units, a configuration that Unit refuses, instructions that
  /// aren't here.
  UnitBatch(const UnitConfig& config, std::size_t units, std::string_view instructions = {});
  ~UnitBatch();
  UnitBatch(UnitBatch&&) noexcept;
  UnitBatch& operator=(UnitBatch&&) noexcept;

  /// Those that this machine can run, the fastest first.
  [[nodiscard]] static std::vector<std::string_view> instruction_sets();

  [[nodiscard]] std::size_t size() const noexcept;               ///< units
  [[nodiscard]] const UnitConfig& config() const noexcept;       ///< common to all
  [[nodiscard]] std::string_view instructions() const noexcept;  ///< in use, as instruction_sets() names them
  /// How many units go side by side; 1: this type has no lanes.
  [[nodiscard]] int width() const noexcept;
  [[nodiscard]] std::int64_t time_ns() const noexcept;  ///< since the start

  /// A unit's state, as Unit has it; what its program waits for is in the batch's time. InputError: no such unit.
  [[nodiscard]] UnitState state(std::size_t unit) const;
  void set(std::size_t unit, const UnitState& state);  ///< goes on from that state; InputError: no such unit

  /// Equilibrium (rad) and preset of a unit, from its next tick on. InputError: no such unit, numbers that aren't finite.
  void command(std::size_t unit, double equilibrium_rad, double preset);

  /// One host step of all, (0, 16 ms]: each shaft's angle (rad) and speed (rad/s) where it begins, and 1/(kg·m²) of what it turns, 0
  /// where somebody else moves it; `torque` gets the mean torques on the shafts, N·m. InputError: arrays of another size, numbers
  /// that aren't finite, a negative inertia, a step out of range; nothing was stepped then.
  void step(std::int64_t dt_ns, std::span<const double> angle, std::span<const double> speed,
            std::span<const double> inverse_inertia, std::span<double> torque);
  static void check_step(std::int64_t dt_ns);  ///< InputError as step() for its length
  /// Units whose solution hasn't settled in the last step (JointSolver::solve).
  [[nodiscard]] std::size_t unsettled() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::device
