// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One bench with a specimen on it: a world with one actuator, its load, and what is sampled of it.
#pragma once

#include <functional>

#include "vsa/engine/world.hpp"
#include "vsa/experiment/bench.hpp"

namespace vsa::experiment {

inline constexpr const char* kLoadBench = "bench_load.sdf";
inline constexpr const char* kFreeBench = "bench_free.sdf";

inline constexpr double kLiftRate_rad_per_s = 0.25;

/// What is asked of the unit at a time, s.
using Command = std::function<elastic::EquilibriumPreset(double time_s)>;

class Bench {
 public:
  /// `load_share` scales mass and inertia of what the shaft turns.
  Bench(const Specimen& specimen, const char* world, Watch* watch, double load_share = 1);

  [[nodiscard]] const elastic::Transmission& law() const { return *config_->unit.actuator.transmission; }
  [[nodiscard]] double load_peak_Nm() const noexcept { return load_peak_Nm_; }

  /// Raises the equilibrium from 0 by kLiftRate until the shaft reaches `angle_rad` or the equilibrium `most_rad`; returns the
  /// equilibrium.
  double lift(double angle_rad, double most_rad, double preset);
  [[nodiscard]] double shaft_rad() const { return world_.read(actuator_).shaft_rad; }
  void reset();  ///< to the start, notices forgotten

  /// Runs for `duration_s` with the command of each step; its time counts from the call. Returns the largest angle of the shaft.
  double run(double duration_s, const Command& command);
  /// The same with a sample every `sample_s`, the first at time `start_s` after the call and the last at the end.
  [[nodiscard]] BenchRun record(double duration_s, double start_s, double sample_s, const Command& command);

 private:
  void step(const elastic::EquilibriumPreset& command);
  [[nodiscard]] BenchSample sample(double time_s) const;

  engine::World world_;
  engine::ActuatorRef actuator_;
  const host::ActuatorConfig* config_;
  Watch* watch_;
  double load_peak_Nm_ = 0;
};

}  // namespace vsa::experiment
