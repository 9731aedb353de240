// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Three tasks for any actuator type: which throws farthest, comes to rest soonest after a blow, holds a load cheapest?
//
// A rigid link on the shaft, axis upright, the unit under its own program (device/lever_batch.hpp):
//
//   J q̈ = τ + push
//
//   link    J = τ_p/α₀, α₀ = 200 rad/s², τ_p the largest torque that the type moves at any of its presets: a link in proportion to its
//           strength, so that weak and strong ones are asked the same. Or one J for all.
//   throw   the equilibrium swings back to −1 rad and t later forward to +1 rad, t = 0 (forward only) … 1.2 s by 0.05 s. A ball, part of
//           the link, lies r = 0.5 m from the axis; it flies off where it is fastest, at 45° upwards, and lands as high as it left:
//           d = (r q̇)²/g
//   settle  a blow gives the resting link 2 rad/s. Settled: it stays within 5 % of its largest way from where it comes to rest.
//   hold    an external torque τ_p/2, or one for all, grows within 1 s; after another 4 s, what the supply gives in 10 s. Held: its
//           mean over a second moves by less than 0.01 rad meanwhile, and it gave way by less than a right angle.
//
// Each at presets from 0 to 90 % of what the motors wind to; a type without preset once. No gravity, no air, no heat.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/study/progress.hpp"

namespace vsa::study {

/// Which types are set the tasks, and by what scale.
struct TaskOptions {
  std::vector<std::string> types;           ///< empty: all of the library
  config::TypeLibrary library{};            ///< where the types are
  std::vector<config::Override> overrides;  ///< of every type
  std::optional<double> inertia_kgm2;       ///< J of every link, 1e-6 … 1e3
  std::optional<double> load_Nm;            ///< to hold, 1e-6 … 1e5
  double step_s = 0.25e-3;                  ///< 1e-5 … 1e-3
};

/// The best of the swings at a preset.
struct ThrowResult {
  double preset = 0;                        ///< in the law's unit
  double swing_back_s = 0;                  ///< t
  double link_rad_per_s = 0;                ///< largest q̇ on the way forward
  [[nodiscard]] double distance_m() const;  ///< d
};

/// How soon the link rests after a blow, at one preset.
struct SettleResult {
  double preset = 0;     ///< in the law's unit
  double settled_s = 0;  ///< after the blow; NaN: not within 18 s
  double way_rad = 0;    ///< largest way from where it comes to rest
};

inline constexpr double kBlow_rad_per_s = 2;  ///< which a blow of one step gives the link that is to settle
inline constexpr double kMostBlow_Nm = 1e6;   ///< J·kBlow/step, at most

/// What holding the load costs, at one preset.
struct HoldResult {
  double preset = 0;    ///< in the law's unit
  double energy_J = 0;  ///< from the supply in 10 s; NaN: not held
  double sag_rad = 0;   ///< how far the shaft gives way
};

/// What one type did in the three tasks.
struct TaskResults {
  config::ActuatorType actuator;       ///< as it was read
  double torque_Nm = 0;                ///< τ_p
  double no_load_speed_rad_per_s = 0;  ///< computed, softest
  double inertia_kgm2 = 0,             ///< J; NaN where the motors move nothing, and then no results
      load_Nm = 0;                     ///< to hold; NaN likewise
  std::vector<double> presets;         ///< in the law's unit, upwards
  std::vector<ThrowResult> throws;     ///< one a preset
  std::vector<SettleResult> settles;   ///< one a preset
  std::vector<HoldResult> holds;       ///< one a preset

  /// "rad" …; empty: the law has no stiffness preset.
  [[nodiscard]] std::string preset_unit() const { return std::string(actuator.unit.actuator.transmission->preset_unit()); }
  /// None: no result that counts.
  [[nodiscard]] std::optional<ThrowResult> farthest() const;  ///< of the throws that move
  [[nodiscard]] std::optional<SettleResult> soonest() const;  ///< of those that settled
  [[nodiscard]] std::optional<HoldResult> cheapest() const;   ///< of those that were held
};

/// The three tasks for some types. A plan where the results are empty.
struct Tasks {
  double step_s = 0;              ///< of all simulations
  std::vector<TaskResults> each;  ///< in the order asked for
};

/// Throws InputError with every problem: an unknown type, an override that one of them refuses, a value out of range.
[[nodiscard]] Tasks plan_tasks(const TaskOptions& options);
/// On `threads` threads (0: all the machine has). None: `on_progress` stopped it.
[[nodiscard]] std::optional<Tasks> run(Tasks plan, const OnProgress& on_progress = {}, unsigned threads = 0);

/// results.json: units in the keys; null: nothing that counts. `command`: what made it.
[[nodiscard]] std::string to_json(const Tasks& tasks, const std::string& command);

/// Of samples `sample_s` apart, the last tenth of them at rest: when they have settled, see above; NaN: not in their first nine tenths.
[[nodiscard]] double settling_time_s(std::span<const double> angle_rad, double sample_s);

}  // namespace vsa::study
