// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A gait is data: sinusoids for groups of actuators, played in simulated time on a Stage: a world, or whatever has actuators.
//
//   y_n(t) = D + A r(t) sin(ω t + n π/λ + δ + s)          the paper's eq. (10); s = steering, on one group only       rad
//   r(t)   = t/ramp_s below ramp_s, then 1: the body grows into the wave instead of jumping into it
//
// Commands are sent at every multiple of period_s: what is sent is a function of simulated time and, when steering, of where the
// model has been. What changes as it plays is in GaitState, which is copyable; a copy of a Gait goes on exactly as the original.
//
// Steering: the direction of travel is that of the model's centre of mass against where it was one gait period ago (so the wobble
// of the cycle cancels). With ψ its angle about the world's z axis,
//   goal = clamp(gain · wrap(ψ_target − ψ), ±limit_rad),   s moves towards goal by at most slew_rad_per_s.
// A model that moved less than min_travel_m in the period has no direction: the last one holds.
//
// While it plays it can be changed (change()): amplitude, offset, π/λ, δ, preset and ω go to their new values linearly in kBlend_s
// and the phase is ∫ω dt, so that commands never jump. Nor do those of an actuator that somebody gives back (leave()), nor those of a
// gait that was held: t is its own time, which stands from hold() to resume(). Simulated time that goes backwards starts over with
// the new values.
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
//   preset_deg = 35.0                 # half difference; a unit accepts up to its preset_max (0.785 rad = 44.98°)
//
//   [steering]                        # optional
//   group = "horizontal"
//   gain = 1.0                        # rad/rad; negative turns the other way
//   limit_rad = 0.8
//   slew_rad_per_s = 0.35
//   min_travel_m = 0.03
//   target_deg = 90.0                 # in the world, from +x about +z; left out: where it went after ramp and first period
//
// A file with [[keyframe]] is a motion instead of waves: see motion.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/errors.hpp"
#include "vsa/motion/motion.hpp"
#include "vsa/motion/stage.hpp"

namespace vsa::motion {

/// A wave over actuators: y_n(t) = D + A r(t) sin(ω t + n π/λ + δ + s), rad, n of each, s of the group that steers.
struct GaitGroup {
  std::string name;                    ///< of the file's [group.NAME]
  std::vector<std::string> actuators;  ///< "joint_1", or "model/joint_1" where several models have it
  std::vector<int> n;                  ///< one per actuator
  double amplitude_rad = 0;            ///< A
  double offset_rad = 0;               ///< D
  double lambda = 1;                   ///< λ: actuators a half wave
  double delta_rad = 0;                ///< δ
  double preset_rad = 0;               ///< p, of every actuator in it
};

/// Turns a model as it travels: s goes towards clamp(gain · wrap(ψ_target − ψ), ±limit_rad), ψ its direction, by at most
/// slew_rad_per_s.
struct SteeringParams {
  std::string group;                 ///< whose s it changes
  double gain = 1;                   ///< rad/rad; negative turns the other way
  double limit_rad = 0.8;            ///< of s
  double slew_rad_per_s = 0.35;      ///< at most
  double min_travel_m = 0.03;        ///< below it there is no direction
  std::optional<double> target_rad;  ///< none: where it went after ramp and first period
};

/// A gait as a file has it: waves, or a motion.
struct GaitParams {
  std::string file;                        ///< for messages
  std::string title;                       ///< one line for people
  double frequency_rad_per_s = 0;          ///< ω
  double ramp_s = 0;                       ///< until the wave has its amplitude; 0: at once
  std::int64_t period_ns = 10'000'000;     ///< between two commands, a whole number
  std::vector<GaitGroup> groups;           ///< actuators once, over all groups
  std::optional<SteeringParams> steering;  ///< none: nothing is steered
  std::optional<MotionParams> motion;      ///< keyframes; then there are no groups and frequency_rad_per_s is 0
};

/// Adds what can't be played.
void validate(const GaitParams& params, std::string_view where, Problems& problems);

/// What a value may be, ends included.
struct GaitRange {
  double min = 0,  ///< end included
      max = 0;     ///< end included
};

/// What files and changes may say.
struct GaitBounds {
  GaitRange frequency_rad_per_s{0.01, 1000};  ///< ω
  GaitRange amplitude_deg{0, 160};            ///< A
  GaitRange offset_deg{-160, 160};            ///< D
  GaitRange lambda{0.1, 1000};                ///< λ
  GaitRange delta_deg{-360, 360};             ///< δ
  GaitRange preset_deg{0, 90};                ///< p
};
inline constexpr GaitBounds kGaitBounds{};  ///< those that files and changes are held to

/// What of a group can be changed while it plays.
struct WaveParams {
  double amplitude_rad = 0,  ///< A
      offset_rad = 0,        ///< D
      lambda = 1,            ///< λ
      delta_rad = 0,         ///< δ
      preset_rad = 0;        ///< p
};
/// What change() goes to: ω, and the wave of each group.
struct GaitChange {
  double frequency_rad_per_s = 0;  ///< ω
  std::vector<WaveParams> groups;  ///< as many as the gait has, in its order
};

/// Where steering stands: the way travelled, and the present s.
struct SteeringState {
  std::vector<std::array<double, 2>> trail;  ///< the last period's centres of mass, oldest first
  std::optional<double> heading_rad;         ///< direction of travel
  std::optional<double> target_rad;          ///< that it turns to; none: not chosen yet
  double phase_rad = 0;                      ///< s
};

/// One control period of steering; `window` is a gait period in samples, `engaged` false while the gait still ramps up.
void steer(const SteeringParams& params, SteeringState& state, std::array<double, 2> center, std::size_t window, double dt_s,
           bool engaged);

/// Where the values were when they were last changed.
struct GaitBlend {
  double t_s = 0,     ///< the gait's own time, when it was changed
      phase_rad = 0;  ///< ∫ω dt then
  GaitChange from;    ///< the values then
};

/// Which commands of an actuator the gait leaves to somebody else.
struct ByHand {
  bool equilibrium = false,                                                  ///< is somebody else's
      preset = false;                                                        ///< is somebody else's
  [[nodiscard]] bool any() const noexcept { return equilibrium || preset; }  ///< either of them
};

/// An actuator that was given back: its commands blend from where the hand left them to the gait's.
struct GaitReturn {
  ByHand of;                   ///< which of the two come back
  std::optional<double> t_s;   ///< since when, in the gait's own time; none: from the next commands on
  double equilibrium_rad = 0,  ///< commanded then
      preset = 0;              ///< commanded then
};

/// All that changes while a gait plays, but for leave(). A copy goes on as it was.
struct GaitState {
  std::int64_t last_slot = -1;                               ///< time_ns / period_ns of the last commands
  std::int64_t last_ns = 0;                                  ///< when it was asked last
  SteeringState steering;                                    ///< where it stands
  std::optional<GaitBlend> blend;                            ///< what is left of a change; none: all as params() has it
  double stood_s = 0;                                        ///< for how long it was held: its own time is simulated time less that
  std::optional<double> held_s;                              ///< while it is held: its own time
  std::map<std::string, GaitReturn, std::less<>> returning;  ///< by the actuator's name
};

/// Plays a gait on a Stage: bind it, then call apply() before every step.
class Gait {
 public:
  /// Throws InputError with every problem: missing file, syntax, unknown or missing keys, NaN, numbers out of range, doubled
  /// actuators.
  [[nodiscard]] static Gait load(const std::filesystem::path& file);
  /// Throws InputError where it can't be played: a period below 1 ns, not one n an actuator, numbers that aren't finite, a λ of 0,
  /// steering without a frequency or of a group that there isn't, keyframes whose times don't grow.
  explicit Gait(GaitParams params);

  [[nodiscard]] const GaitParams& params() const noexcept { return params_; }  ///< as they are now, after change()
  [[nodiscard]] const GaitState& state() const noexcept { return state_; }     ///< to look at; a copy of the Gait is how it is kept

  /// Throws InputError naming every actuator that the stage hasn't and each that is listed twice. apply() does it by itself on its first call.
  void bind(const Stage& stage);
  /// Call before every step: sends commands when a new control period has begun. Time that went backwards (a reset) starts over.
  void apply(Stage& stage);
  /// Forgets steering, the last commands and what is left of a change.
  void reset();

  static constexpr double kBlend_s = 1.0;  ///< that a change takes
  /// The values as files give them, for changing.
  [[nodiscard]] GaitChange values() const;
  /// From simulated time t_s on. Throws InputError with every number out of kGaitBounds.
  void change(const GaitChange& to, double t_s);
  /// From simulated time t_s on no commands: the last ones stay.
  void hold(double t_s);
  void resume(double t_s);  ///< goes on from where hold() stopped it: wave, ramp, what is left of a change, keyframes
  [[nodiscard]] bool held() const noexcept { return state_.held_s.has_value(); }  ///< between hold() and resume()
  static constexpr double kGiveBack_s = 0.5;                                      ///< that giving an actuator back takes
  /// From its next commands on. What was by hand and no longer is goes from where the hand left it to the gait's own values,
  /// linearly in kGiveBack_s. An actuator that isn't the gait's: false. A reset doesn't undo it.
  bool leave(std::string_view actuator, ByHand by_hand);
  [[nodiscard]] ByHand by_hand(std::string_view actuator) const;  ///< both false where leave() wasn't called
  [[nodiscard]] bool has(std::string_view actuator) const;        ///< whether it is of a group or of a keyframe, by this name

  /// eq. (10) for the k-th actuator of a group at simulated time t_s. Throws InputError where the group has no such actuator.
  [[nodiscard]] double equilibrium(const GaitGroup& group, std::size_t k, double t_s) const;

 private:
  /// Sends what of an actuator's commands isn't somebody else's. `t_s`: from here on the gait's own time.
  void send(Stage& stage, std::string_view name, double t_s, std::optional<double> equilibrium, std::optional<double> preset);
  void play_motion(Stage& stage, double t_s);
  void steer_model(const Stage& stage, double t_s);
  [[nodiscard]] double own_time(double simulated_s) const noexcept { return state_.held_s.value_or(simulated_s - state_.stood_s); }
  [[nodiscard]] double wave_at(const GaitGroup& group, std::size_t k, double t_s) const;
  void blend_back(const Stage& stage, std::size_t actuator, std::string_view name, double t_s, std::optional<double>& equilibrium,
                  std::optional<double>& preset);
  [[nodiscard]] WaveParams wave(const GaitGroup& group, double t_s) const;
  [[nodiscard]] double frequency(double t_s) const;
  [[nodiscard]] double phase(double t_s) const;

  GaitParams params_;
  GaitState state_;
  std::map<std::string, ByHand, std::less<>> by_hand_;
  std::string model_;  // whose centre of mass steers
  bool bound_ = false;
};

}  // namespace vsa::motion
