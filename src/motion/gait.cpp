// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/motion/gait.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vsa/units.hpp"

namespace vsa::motion {
namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

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
    for (const double v : {s.gain, s.limit_rad, s.slew_rad_per_s, s.min_travel_m, s.target_rad.value_or(0)}) finite("steering", v);
  }
  if (p.motion) {
    finite("end_s", p.motion->end_s);
    finite("loop_from_s", p.motion->loop_from_s.value_or(0));
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
  const WaveParams w = wave(group, t_s);
  const double ramp = t_s < params_.ramp_s ? t_s / params_.ramp_s : 1.0;
  double angle = phase(t_s) + group.n[k] * kPi / w.lambda + w.delta_rad;
  if (params_.steering && params_.steering->group == group.name) angle += state_.steering.phase_rad;
  return w.offset_rad + w.amplitude_rad * ramp * std::sin(angle);
}

void Gait::bind(const Stage& stage) {
  Problems problems;
  for (const GaitGroup& group : params_.groups) {
    for (const std::string& name : group.actuators) {
      try {
        const std::size_t found = stage.find_actuator(name);
        if (params_.steering && params_.steering->group == group.name) model_ = stage.model_of(found);
      } catch (const InputError& error) {
        for (const Problem& p : error.problems())
          problems.add({params_.file, "group." + group.name + ".actuators", name, p.message, p.allowed});
      }
    }
  }
  if (params_.motion) bind_motion(stage, problems);
  problems.throw_if_any();
  bound_ = true;
}

void Gait::bind_motion(const Stage& stage, Problems& problems) const {
  for (const MotionTrack& track : params_.motion->tracks) {
    try {
      static_cast<void>(stage.find_actuator(track.actuator));
    } catch (const InputError& error) {
      const bool angle = !track.equilibrium.empty();
      const double time_s = (angle ? track.equilibrium : track.preset).front().time_s;
      const std::string key = fmt::format("keyframe at {} s: {}", time_s, angle ? "equilibrium_deg" : "preset_deg");
      for (const Problem& p : error.problems()) problems.add({params_.file, key, track.actuator, p.message, p.allowed});
    }
  }
}

void Gait::play_motion(Stage& stage, double now_s) const {
  const MotionParams& motion = *params_.motion;
  const double t_s = motion_time(motion, now_s);
  for (const MotionTrack& track : motion.tracks) {
    const auto equilibrium = motion_value(track.equilibrium, motion.smooth, t_s);
    const auto preset = motion_value(track.preset, motion.smooth, t_s);
    if (equilibrium || preset) stage.send(stage.find_actuator(track.actuator), equilibrium, preset);
  }
}

void Gait::steer_model(const Stage& stage, double t_s) {
  const double dt_s = static_cast<double>(params_.period_ns) * 1e-9;
  const double cycle_s = 2 * kPi / frequency(t_s);
  const auto center = stage.center_of_mass(model_);
  const auto window = static_cast<std::size_t>(std::max(1.0, std::round(cycle_s / dt_s)));
  steer(*params_.steering, state_.steering, {center[0], center[1]}, window, dt_s, t_s >= params_.ramp_s + cycle_s);
}

void Gait::apply(Stage& stage) {
  if (!bound_) bind(stage);
  const std::int64_t slot = stage.time_ns() / params_.period_ns;
  if (slot == state_.last_slot) return;
  if (slot < state_.last_slot) reset();
  if (held()) return;
  state_.last_slot = slot;
  const double t_s = static_cast<double>(stage.time_ns()) * 1e-9;
  if (params_.motion) play_motion(stage, t_s);
  if (params_.steering) steer_model(stage, t_s);
  for (const GaitGroup& group : params_.groups) {
    const std::vector<std::string>& names = group.actuators;
    const double preset = wave(group, t_s).preset_rad;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const ByHand left = by_hand(names[k]);
      const std::size_t actuator = stage.find_actuator(names[k]);
      const auto unless = [](bool hand, double value) { return hand ? std::nullopt : std::optional(value); };
      if (left.equilibrium && left.preset) continue;
      double angle = equilibrium(group, k, t_s), stiffness = preset;
      blend_back(stage, actuator, names[k], t_s, angle, stiffness);
      stage.send(actuator, unless(left.equilibrium, angle), unless(left.preset, stiffness));
    }
  }
}

void Gait::reset() {
  const bool was_held = held();
  state_ = {};
  if (was_held) hold(0);
}

}  // namespace vsa::motion
