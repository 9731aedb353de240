// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/motion/gait.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "vsa/units.hpp"

namespace vsa::motion {
namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

/// Times grow; all numbers are finite.
template <class Ask>
void check_keys(const std::vector<MotionKey>& keys, const std::string& of, const Ask& ask) {
  for (std::size_t k = 0; k < keys.size(); ++k) {
    ask(std::isfinite(keys[k].time_s) && (k == 0 || keys[k].time_s > keys[k - 1].time_s), of + ".time_s", keys[k].time_s,
        "finite, after the one before");
    ask(std::isfinite(keys[k].value_rad), of + ".value_rad", keys[k].value_rad, "a finite number");
  }
}

/// Which of a stage's actuators are meant, each once.
class Names {
 public:
  Names(const Stage& stage, const std::string& file, Problems& problems) : stage_(stage), file_(file), problems_(problems) {}
  std::optional<std::size_t> find(const std::string& key, const std::string& name) {
    try {
      const std::size_t found = stage_.find_actuator(name);
      const auto [at, is_new] = known_.emplace(found, name);
      if (!is_new) problems_.add({file_, key, name, "is listed twice, here and as " + at->second, "each actuator once"});
      return found;
    } catch (const InputError& error) {
      for (const Problem& p : error.problems()) problems_.add({file_, key, name, p.message, p.allowed});
      return std::nullopt;
    }
  }

 private:
  const Stage& stage_;
  const std::string& file_;
  Problems& problems_;
  std::map<std::size_t, std::string> known_;
};

}  // namespace

void validate(const GaitParams& p, std::string_view where, Problems& problems) {
  const auto ask = [&](bool right, const std::string& key, double value, const char* allowed) {
    if (!right) problems.add({p.file, std::string(where) + key, fmt::format("{}", value), "can't be played", allowed});
  };
  const auto finite = [&](const std::string& key, double value) { ask(std::isfinite(value), key, value, "a finite number"); };
  ask(p.period_ns >= 1, "period_ns", static_cast<double>(p.period_ns), "1 or more");
  finite("frequency_rad_per_s", p.frequency_rad_per_s);
  ask(p.ramp_s >= 0 && std::isfinite(p.ramp_s), "ramp_s", p.ramp_s, "finite, ≥ 0");
  for (const GaitGroup& g : p.groups) {
    const std::string of = "group." + g.name + ".";
    ask(g.n.size() == g.actuators.size(), of + "n", static_cast<double>(g.n.size()), "one per actuator");
    ask(std::isfinite(g.lambda) && g.lambda != 0, of + "lambda", g.lambda, "finite, not 0");
    for (const double v : {g.amplitude_rad, g.offset_rad, g.delta_rad, g.preset_rad})
      ask(std::isfinite(v), of + "angles", v, "finite numbers");
  }
  if (p.steering) {
    const SteeringParams& s = *p.steering;
    ask(p.frequency_rad_per_s > 0, "frequency_rad_per_s", p.frequency_rad_per_s, "above 0 to steer");
    const auto named = [&](const GaitGroup& g) { return g.name == s.group; };
    if (!p.groups.empty() && std::none_of(p.groups.begin(), p.groups.end(), named))
      problems.add({p.file, std::string(where) + "steering.group", s.group, "no such group", ""});
    for (const double v : {s.gain, s.limit_rad, s.slew_rad_per_s, s.min_travel_m, s.target_rad.value_or(0)}) finite("steering", v);
  }
  if (p.motion) {
    const double end_s = p.motion->end_s, from_s = p.motion->loop_from_s.value_or(0);
    finite("end_s", end_s);
    ask(std::isfinite(from_s) && (!p.motion->loop_from_s || from_s < end_s), "loop_from_s", from_s, "finite, before the end");
    for (const MotionTrack& track : p.motion->tracks) {
      if (track.equilibrium.empty() && track.preset.empty())
        problems.add({p.file, std::string(where) + track.actuator, "", "has no keyframe", "one or more"});
      for (const auto* channel : {&track.equilibrium, &track.preset}) check_keys(*channel, track.actuator, ask);
    }
  }
}

Gait::Gait(GaitParams params) : params_(std::move(params)) {
  Problems problems;
  validate(params_, "", problems);
  problems.throw_if_any();
}

void steer(const SteeringParams& params, SteeringState& state, std::array<double, 2> center, std::size_t window, double dt_s,
           bool engaged) {
  state.trail.push_back(center);
  if (state.trail.size() <= window) return;
  // More than one too many where ω was raised: the period is shorter now.
  state.trail.erase(state.trail.begin(), state.trail.end() - static_cast<std::ptrdiff_t>(window) - 1);
  const auto from = state.trail.front();
  state.trail.erase(state.trail.begin());
  const double dx = center[0] - from[0], dy = center[1] - from[1];
  if (std::hypot(dx, dy) >= params.min_travel_m) state.heading_rad = std::atan2(dy, dx);
  if (!engaged || !state.heading_rad) return;
  if (!state.target_rad) state.target_rad = params.target_rad.value_or(*state.heading_rad);
  const double goal =
      std::clamp(params.gain * wrapped(*state.target_rad - *state.heading_rad), -params.limit_rad, params.limit_rad);
  const double reach = params.slew_rad_per_s * dt_s;
  state.phase_rad += std::clamp(goal - state.phase_rad, -reach, reach);
}

double Gait::equilibrium(const GaitGroup& group, std::size_t k, double t_s) const {
  if (k >= group.n.size())
    throw InputError(Problem{params_.file, "group." + group.name, fmt::format("{}", k), "has no such actuator",
                             fmt::format("below {}", group.n.size())});
  return wave_at(group, k, own_time(t_s));
}

double Gait::wave_at(const GaitGroup& group, std::size_t k, double t_s) const {
  const WaveParams w = wave(group, t_s);
  const double ramp = t_s < params_.ramp_s ? t_s / params_.ramp_s : 1.0;
  double angle = phase(t_s) + group.n[k] * kPi / w.lambda + w.delta_rad;
  if (params_.steering && params_.steering->group == group.name) angle += state_.steering.phase_rad;
  return w.offset_rad + w.amplitude_rad * ramp * std::sin(angle);
}

void Gait::bind(const Stage& stage) {
  Problems problems;
  Names names(stage, params_.file, problems);
  for (const GaitGroup& group : params_.groups) {
    for (const std::string& name : group.actuators) {
      const auto found = names.find("group." + group.name + ".actuators", name);
      if (found && params_.steering && params_.steering->group == group.name) model_ = stage.model_of(*found);
    }
  }
  for (const MotionTrack& track : params_.motion ? params_.motion->tracks : std::vector<MotionTrack>{}) {
    const bool angle = !track.equilibrium.empty();
    const double time_s = (angle ? track.equilibrium : track.preset).front().time_s;
    names.find(fmt::format("keyframe at {} s: {}", time_s, angle ? "equilibrium_deg" : "preset_deg"), track.actuator);
  }
  problems.throw_if_any();
  bound_ = true;
}

void Gait::play_motion(Stage& stage, double t_s) {
  const MotionParams& motion = *params_.motion;
  const double folded_s = motion_time(motion, t_s);
  for (const MotionTrack& track : motion.tracks) {
    const auto equilibrium = motion_value(track.equilibrium, motion.smooth, folded_s);
    const auto preset = motion_value(track.preset, motion.smooth, folded_s);
    send(stage, track.actuator, t_s, equilibrium, preset);
  }
}

void Gait::steer_model(const Stage& stage, double t_s) {
  const double dt_s = static_cast<double>(params_.period_ns) * 1e-9;
  const double cycle_s = 2 * kPi / frequency(t_s);
  const auto center = stage.center_of_mass(model_);
  const auto window = static_cast<std::size_t>(std::max(1.0, std::round(cycle_s / dt_s)));
  steer(*params_.steering, state_.steering, {center[0], center[1]}, window, dt_s, t_s >= params_.ramp_s + cycle_s);
}

void Gait::send(Stage& stage, std::string_view name, double t_s, std::optional<double> equilibrium, std::optional<double> preset) {
  const ByHand left = by_hand(name);
  if (left.equilibrium) equilibrium.reset();
  if (left.preset) preset.reset();
  if (!equilibrium && !preset) return;
  const std::size_t actuator = stage.find_actuator(name);
  blend_back(stage, actuator, name, t_s, equilibrium, preset);
  stage.send(actuator, equilibrium, preset);
}

void Gait::apply(Stage& stage) {
  if (!bound_) bind(stage);
  const std::int64_t now_ns = stage.time_ns(), slot = now_ns / params_.period_ns;
  if (now_ns < state_.last_ns) reset();
  state_.last_ns = now_ns;
  if (slot == state_.last_slot || held()) return;
  state_.last_slot = slot;
  const double t_s = own_time(static_cast<double>(now_ns) * 1e-9);
  if (params_.motion) play_motion(stage, t_s);
  if (params_.steering) steer_model(stage, t_s);
  for (const GaitGroup& group : params_.groups) {
    const double preset = wave(group, t_s).preset_rad;
    for (std::size_t k = 0; k < group.actuators.size(); ++k) send(stage, group.actuators[k], t_s, wave_at(group, k, t_s), preset);
  }
}

void Gait::reset() {
  const bool was_held = held();
  state_ = {};
  if (was_held) hold(0);
}

}  // namespace vsa::motion
