// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Many units of one type with a lever on each shaft (UnitBatch): for identification, control and learning without bodies.
//
//   J q̈ = τ − d q̇ − G sin q + push
//   v' = (v + dt/J (τ − G sin q + push)) / (1 + dt d/J),   q' = q + dt v'      τ: the unit's mean torque over the step
//
// Arrays have one number a unit and stay where they are as long as the LeverBatch does.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "vsa/device/unit_batch.hpp"
#include "vsa/units.hpp"

namespace vsa::device {

/// What a unit turns: inertia J, damping d, and gravity's G sin q.
struct Lever {
  double inertia_kgm2 = 1e-3;      ///< J > 0
  double damping_Nms_per_rad = 0;  ///< d ≥ 0
  double gravity_Nm = 0;           ///< G = m g l: pulls towards q = 0 where positive, away where negative
};

/// Many units of one type with a lever on each shaft, J q̈ = τ − d q̇ − G sin q + push, stepped together. One thread.
class LeverBatch {
 public:
  /// InputError as UnitBatch; a lever that is out of range.
  LeverBatch(const UnitConfig& config, std::size_t units, const Lever& lever, std::string_view instructions = {});

  [[nodiscard]] std::size_t size() const noexcept { return units_.size(); }  ///< units
  [[nodiscard]] const UnitBatch& units() const noexcept { return units_; }   ///< to look at; LeverBatch moves them
  /// Simulated, since the start.
  [[nodiscard]] double time_s() const noexcept { return seconds_of(units_.time_ns()); }

  /// From the next step on. InputError: no such unit, out of range.
  void set_lever(std::size_t unit, const Lever& lever);
  [[nodiscard]] const Lever& lever(std::size_t unit) const;  ///< InputError: no such unit

  /// Given with every step().
  [[nodiscard]] std::span<double> equilibrium() noexcept { return equilibrium_; }  ///< rad; NaN, as at first: what it was
  [[nodiscard]] std::span<double> preset() noexcept { return preset_; }            ///< in the law's preset unit; NaN likewise
  [[nodiscard]] std::span<double> push() noexcept { return push_; }                ///< N·m about +q; at first 0

  /// So many steps of dt (at most 16 ms), the commands taken as it begins. `between` is called between slices of about a million
  /// unit steps; what it throws ends the stepping there. InputError: out of range, pushes or commands beyond ±1e6, NaN pushes;
  /// nothing was stepped then. InputError "lever[i]" too where a lever would fly beyond 1e6 rad or rad/s: it stays where it was, the
  /// others have made that step, and none follows.
  void step(int steps, std::int64_t dt_ns = 1'000'000, const std::function<void()>& between = {});
  /// At rest on its references for (equilibrium, preset), on for long, the shaft where it is said to be. What stands in equilibrium()
  /// and preset() is commanded with the next step as ever. InputError: no such unit, numbers beyond ±1e6.
  void reset(std::size_t unit, double equilibrium_rad, double preset, double shaft_rad, double speed_rad_per_s = 0);
  /// InputError as reset(): for several, all of which are to be looked at before the first goes back.
  void check_reset(std::size_t unit, double equilibrium_rad, double preset, double shaft_rad, double speed_rad_per_s = 0) const;

  /// A unit's state at the end of the last step, its shaft where the lever has it. Not in it: the lever, and commands that no step
  /// has taken. InputError: no such unit.
  [[nodiscard]] UnitState state(std::size_t unit) const;
  /// Goes on from a state of a unit with these parameters, taken at `time_ns` there: bit by bit where steps meet the ticks of 1 ms
  /// as they did. equilibrium(), preset() and push() are given with the next step as ever; what it was (NaN) is what the unit's
  /// references stand for, of a command beyond its range no more than it holds: such a one, where it still stands there, is given
  /// once more. InputError: no such unit, a shaft beyond ±1e6 rad or rad/s, times that no state has.
  void restore(std::size_t unit, const UnitState& state, std::int64_t time_ns);

  [[nodiscard]] std::span<const double> shaft_rad() const noexcept { return angle_; }              ///< q now, one number a unit
  [[nodiscard]] std::span<const double> shaft_speed_rad_per_s() const noexcept { return speed_; }  ///< q̇ now, one number a unit
  [[nodiscard]] std::span<const double> torque_Nm() const noexcept { return torque_; }             ///< mean over the last step

 private:
  void command();
  std::optional<std::size_t> move(double dt_s) noexcept;

  UnitBatch units_;
  Unit unit_;  // makes states
  std::vector<Lever> levers_;
  std::vector<double> equilibrium_, preset_, push_, angle_, speed_, inverse_inertia_, torque_;
  std::vector<double> held_equilibrium_, held_preset_;  // what the units have
};

}  // namespace vsa::device
