// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A gait that is changed while it plays. With s = (t − t₀)/kBlend_s in 0 … 1 since the last change:
//   value(t) = from + s·(to − from)                      of 1/λ where λ is meant: what moves is the phase nπ/λ
//   φ(t)     = φ₀ + ω_from·τ + (ω_to − ω_from)·τ²/(2·kBlend_s) + ω_to·(t − t₀ − τ),  τ = min(t − t₀, kBlend_s)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vsa/errors.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/units.hpp"

namespace vsa::motion {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kRounding = 1e-12;  // of a bound in degrees that was turned into radians

WaveParams wave_of(const GaitGroup& g) { return {g.amplitude_rad, g.offset_rad, g.lambda, g.delta_rad, g.preset_rad}; }

class Checker {
 public:
  void number(const std::string& key, double value, const GaitRange& range, double unit = 1) {
    const double shown = value / unit, slack = kRounding * std::max(std::abs(range.min), std::abs(range.max));
    if (shown >= range.min - slack && shown <= range.max + slack) return;
    problems_.add({"", key, fmt::format("{}", shown), "out of range", fmt::format("{} … {}", range.min, range.max)});
  }
  void group(const std::string& name, const WaveParams& w) {
    const std::string scope = "group." + name + ".";
    number(scope + "amplitude_deg", w.amplitude_rad, kGaitBounds.amplitude_deg, kDegree);
    number(scope + "offset_deg", w.offset_rad, kGaitBounds.offset_deg, kDegree);
    number(scope + "lambda", w.lambda, kGaitBounds.lambda);
    number(scope + "delta_deg", w.delta_rad, kGaitBounds.delta_deg, kDegree);
    number(scope + "preset_deg", w.preset_rad, kGaitBounds.preset_deg, kDegree);
  }
  Problems& problems() { return problems_; }

 private:
  Problems problems_;
};

}  // namespace

GaitChange Gait::values() const {
  GaitChange out{params_.frequency_rad_per_s, {}};
  for (const GaitGroup& group : params_.groups) out.groups.push_back(wave_of(group));
  return out;
}

double Gait::frequency(double t_s) const {
  const double to = params_.frequency_rad_per_s;
  if (!state_.blend) return to;
  const double part = std::clamp((t_s - state_.blend->t_s) / kBlend_s, 0.0, 1.0);
  return std::lerp(state_.blend->from.frequency_rad_per_s, to, part);
}

double Gait::phase(double t_s) const {
  const double to = params_.frequency_rad_per_s;
  if (!state_.blend) return to * t_s;
  const double from = state_.blend->from.frequency_rad_per_s, since = t_s - state_.blend->t_s;
  const double blending = std::clamp(since, 0.0, kBlend_s);
  return state_.blend->phase_rad + from * blending + (to - from) * blending * blending / (2 * kBlend_s) + to * (since - blending);
}

WaveParams Gait::wave(const GaitGroup& group, double t_s) const {
  const WaveParams to = wave_of(group);
  if (!state_.blend || t_s >= state_.blend->t_s + kBlend_s) return to;
  const auto same = [&](const GaitGroup& g) { return g.name == group.name; };
  const auto index = std::find_if(params_.groups.begin(), params_.groups.end(), same) - params_.groups.begin();
  if (index >= static_cast<std::ptrdiff_t>(state_.blend->from.groups.size())) return to;  // none of ours
  const WaveParams& from = state_.blend->from.groups[static_cast<std::size_t>(index)];
  const double part = std::max(0.0, (t_s - state_.blend->t_s) / kBlend_s);
  return {std::lerp(from.amplitude_rad, to.amplitude_rad, part), std::lerp(from.offset_rad, to.offset_rad, part),
          1 / std::lerp(1 / from.lambda, 1 / to.lambda, part), std::lerp(from.delta_rad, to.delta_rad, part),
          std::lerp(from.preset_rad, to.preset_rad, part)};
}

void Gait::change(const GaitChange& to, double simulated_s) {
  const double t_s = own_time(simulated_s);
  Checker check;
  check.number("frequency_rad_per_s", to.frequency_rad_per_s, kGaitBounds.frequency_rad_per_s);
  if (to.groups.size() != params_.groups.size()) {
    check.problems().add({"", "group", fmt::format("{} groups", to.groups.size()), "not as many as the gait has",
                          fmt::format("{}", params_.groups.size())});
  }
  for (std::size_t g = 0; g < std::min(to.groups.size(), params_.groups.size()); ++g) {
    check.group(params_.groups[g].name, to.groups[g]);
  }
  check.problems().throw_if_any();
  GaitBlend blend{t_s, phase(t_s), {frequency(t_s), {}}};
  for (const GaitGroup& group : params_.groups) blend.from.groups.push_back(wave(group, t_s));
  params_.frequency_rad_per_s = to.frequency_rad_per_s;
  for (std::size_t g = 0; g < params_.groups.size(); ++g) {
    GaitGroup& group = params_.groups[g];
    const WaveParams& w = to.groups[g];
    group.amplitude_rad = w.amplitude_rad, group.offset_rad = w.offset_rad, group.lambda = w.lambda;
    group.delta_rad = w.delta_rad, group.preset_rad = w.preset_rad;
  }
  state_.blend = std::move(blend);
}

void Gait::hold(double t_s) { state_.held_s = own_time(t_s); }

void Gait::resume(double t_s) {
  if (!held()) return;
  state_.stood_s = t_s - *state_.held_s;
  state_.held_s.reset();
  state_.steering.trail.clear();
  for (auto& [name, back] : state_.returning) back.t_s.reset();  // from where they stood
}

bool Gait::has(std::string_view actuator) const {
  const auto named = [&](const std::string& name) { return name == actuator; };
  for (const GaitGroup& group : params_.groups)
    if (std::any_of(group.actuators.begin(), group.actuators.end(), named)) return true;
  return params_.motion && std::any_of(params_.motion->tracks.begin(), params_.motion->tracks.end(),
                                       [&](const MotionTrack& track) { return named(track.actuator); });
}

bool Gait::leave(std::string_view actuator, ByHand by_hand) {
  if (!has(actuator)) return false;
  const ByHand before = this->by_hand(actuator);
  GaitReturn& back = state_.returning[std::string(actuator)];
  const ByHand joins{before.equilibrium && !by_hand.equilibrium, before.preset && !by_hand.preset};
  if (joins.any()) back.t_s.reset();
  back.of.equilibrium = !by_hand.equilibrium && (back.of.equilibrium || joins.equilibrium);
  back.of.preset = !by_hand.preset && (back.of.preset || joins.preset);
  if (!back.of.any()) state_.returning.erase(state_.returning.find(actuator));
  by_hand_.insert_or_assign(std::string(actuator), by_hand);
  return true;
}

void Gait::blend_back(const Stage& stage, std::size_t actuator, std::string_view name, double t_s,
                      std::optional<double>& equilibrium, std::optional<double>& preset) {
  const auto found = state_.returning.find(name);
  if (found == state_.returning.end()) return;
  GaitReturn& back = found->second;
  if (!back.t_s) {
    const Commanded now = stage.commanded(actuator);
    back = {back.of, t_s, now.equilibrium_rad, now.preset};
  }
  const double part = (t_s - *back.t_s) / kGiveBack_s;
  if (part >= 1) {
    state_.returning.erase(found);
    return;
  }
  if (back.of.equilibrium && equilibrium) equilibrium = std::lerp(back.equilibrium_rad, *equilibrium, part);
  if (back.of.preset && preset) preset = std::lerp(back.preset, *preset, part);
}

ByHand Gait::by_hand(std::string_view actuator) const {
  const auto found = by_hand_.find(actuator);
  return found == by_hand_.end() ? ByHand{} : found->second;
}

}  // namespace vsa::motion
