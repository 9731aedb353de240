// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A gait is data: sinusoids for groups of actuators, played in simulated time through World::command.
//
//   y_n(t) = D + A r(t) sin(ω t + n π/λ + δ + s)          the paper's eq. (10); s = steering, on one group only       rad
//   r(t)   = t/ramp_s below ramp_s, then 1: the body grows into the wave instead of jumping into it
//
// Commands are sent at every multiple of period_s: what is sent is a function of simulated time and, when steering, of where the
// model has been. All memory is in GaitState, which is copyable; a copy of a Gait goes on exactly as the original.
//
// Steering: the direction of travel is that of the model's centre of mass against where it was one gait period ago (so the wobble
// of the cycle cancels). With ψ its angle about the world's z axis,
//   goal = clamp(gain · wrap(ψ_target − ψ), ±limit_rad),   s moves towards goal by at most slew_rad_per_s.
// A model that moved less than min_travel_m in the period has no direction: the last one holds.
//
// A gait file (TOML; angles in degrees as in the paper's Table II):
//
//   base = "sidewind.toml"            # optional: begin with that file (same directory), then replace what follows
//   title = "…"
//   frequency_rad_per_s = 4.71        # ω
//   ramp_s = 2.0
//   period_s = 0.01                   # a command each, a whole number of nanoseconds
//   [group.vertical]
//   actuators = ["joint_1", "joint_3"]
//   n = [1, 3]                        # the n of each
//   amplitude_deg = 60.0              # A
//   offset_deg = 0.0                  # D
//   lambda = 5.0                      # λ: modules a half wave
//   delta_deg = 0.0                   # δ
//   preset_deg = 35.0                 # stiffness preset (half difference); a unit accepts up to its preset_max (0.785 rad
//   = 44.98°) [steering]                        # optional group = "horizontal" gain = 1.0                        # rad/rad;
//   negative turns the other way limit_rad = 0.8 slew_rad_per_s = 0.35 min_travel_m = 0.03 target_deg = 90.0                 # in
//   the world, from +x about +z; left out: the direction of travel after ramp and first period
//
// A file with [[keyframe]] is a motion instead of waves: see motion.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vsa/engine/motion.hpp"
#include "vsa/engine/world.hpp"

namespace vsa::engine {

struct GaitGroup {
  std::string name;
  std::vector<std::string> actuators;  ///< "joint_1", or "model/joint_1" where several models have it
  std::vector<int> n;                  ///< one an actuator
  double amplitude_rad = 0;
  double offset_rad = 0;
  double lambda = 1;
  double delta_rad = 0;
  double preset_rad = 0;
};

struct SteeringParams {
  std::string group;
  double gain = 1;
  double limit_rad = 0.8;
  double slew_rad_per_s = 0.35;
  double min_travel_m = 0.03;
  std::optional<double> target_rad;
};

struct GaitParams {
  std::string file;  ///< for messages
  std::string title;
  double frequency_rad_per_s = 0;
  double ramp_s = 0;
  std::int64_t period_ns = 10'000'000;
  std::vector<GaitGroup> groups;
  std::optional<SteeringParams> steering;
  std::optional<MotionParams> motion;  ///< keyframes; then there are no groups and frequency_rad_per_s is 0
};

struct SteeringState {
  std::vector<std::array<double, 2>> trail;  ///< the last period's centres of mass, oldest first
  std::optional<double> heading_rad;         ///< direction of travel
  std::optional<double> target_rad;
  double phase_rad = 0;  ///< s
};

/// One control period of steering; `window` is a gait period in samples, `engaged` false while the gait still ramps up.
void steer(const SteeringParams& params, SteeringState& state, std::array<double, 2> center, std::size_t window, double dt_s,
           bool engaged);

struct GaitState {
  std::int64_t last_slot = -1;  ///< time_ns / period_ns of the last commands
  SteeringState steering;
};

class Gait {
 public:
  /// Throws InputError with every problem: missing file, syntax, unknown or missing keys, NaN, numbers out of range, doubled
  /// actuators.
  [[nodiscard]] static Gait load(const std::filesystem::path& file);
  explicit Gait(GaitParams params) : params_(std::move(params)) {}

  [[nodiscard]] const GaitParams& params() const noexcept { return params_; }
  [[nodiscard]] const GaitState& state() const noexcept { return state_; }

  /// Throws InputError naming every actuator that the world hasn't. apply() does it by itself on its first call.
  void bind(const World& world);
  /// Call before every step: sends commands when a new control period has begun. Time that went backwards (a reset) starts over.
  void apply(World& world);
  /// Forgets steering and the last commands.
  void reset();

  /// eq. (10) for the k-th actuator of a group at simulated time t.
  [[nodiscard]] double equilibrium(const GaitGroup& group, std::size_t k, double t_s) const;

 private:
  void bind_motion(const World& world, Problems& problems) const;
  void play_motion(World& world) const;
  void steer_model(const World& world, double t_s);

  GaitParams params_;
  GaitState state_;
  std::string model_;  // whose centre of mass steers
  bool bound_ = false;
};

}  // namespace vsa::engine
