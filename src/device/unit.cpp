// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/unit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace vsa::device {
namespace {

using firmware::kTickNs;

constexpr int kMaxIterations = 80;
constexpr double kRelativeTolerance = 1e-4;
constexpr double kAbsoluteTolerance_Nm = 1e-6;
/// A guess may lie where the spring's exponential law has no numbers left, so it goes no further than this at once.
constexpr double kReach_rad = 0.25;

double seconds(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }

struct Span {
  std::int64_t t_ns, dt_ns, substep_ns;
};

/// Trials of the shaft's path over a step, with voltages that are known. Each begins at the same state; the last one is kept. All
/// but a step's last segment run on the state itself, put back for the next trial; most steps have that one only.
class PathTrials {
 public:
  PathTrials(actuator::Actuator& actuator, actuator::ActuatorState& state, std::span<const Held> held, const Span& span) noexcept
      : actuator_(actuator), state_(state), held_(held), span_(span) {
    if (length(0) < span_.dt_ns) {
      start_ = state_;
    } else {
      begin_last(0, 0);
    }
  }

  /// What the last segment lets expect for dy = 0; none for a step of several segments.
  [[nodiscard]] std::optional<actuator::SegmentResult> foresee() noexcept {
    if (start_) return std::nullopt;
    return actuator_.foresee(state_, last_);
  }

  /// The mean torque along y → y + dy, and its slope. `rough`: of a step with one segment, as Actuator::attempt has it.
  actuator::SegmentResult at(double dy, bool rough) noexcept {
    if (!start_) return actuator_.attempt(state_, last_, dy, rough);
    state_ = *start_;
    actuator::SegmentResult sum;
    std::int64_t now = 0;
    std::size_t interval = 0;
    for (std::int64_t h = length(0); now + h < span_.dt_ns; h = length(now)) {
      const actuator::SegmentInput in{dy * share(h), held_[interval].voltage, held_[interval].terminal};
      add(sum, actuator_.segment(state_, seconds(h), in), now, h);
      now += h;
      if ((span_.t_ns + now) % kTickNs == 0) ++interval;
    }
    begin_last(now, interval);
    add(sum, actuator_.attempt(state_, last_, dy * share(span_.dt_ns - now)), now, span_.dt_ns - now);
    return sum;
  }

  void finish() noexcept { actuator_.finish(state_, last_); }

 private:
  [[nodiscard]] std::int64_t length(std::int64_t now) const noexcept {
    return std::min({span_.substep_ns, kTickNs - (span_.t_ns + now) % kTickNs, span_.dt_ns - now});
  }
  [[nodiscard]] double share(std::int64_t h_ns) const noexcept {
    return static_cast<double>(h_ns) / static_cast<double>(span_.dt_ns);
  }
  void begin_last(std::int64_t now, std::size_t interval) noexcept {
    actuator_.begin(state_, last_, seconds(span_.dt_ns - now), {0.0, held_[interval].voltage, held_[interval].terminal});
  }
  void add(actuator::SegmentResult& sum, const actuator::SegmentResult& r, std::int64_t now, std::int64_t h) const noexcept {
    sum.torque += r.torque * share(h);
    // r.slope is for the segment's own end; with the whole path its start moves too. 1 for a single segment.
    sum.slope += r.slope * share(h) * (2.0 * share(now) + share(h));
  }

  actuator::Actuator& actuator_;
  actuator::ActuatorState& state_;
  std::optional<actuator::ActuatorState> start_;
  std::span<const Held> held_;
  Span span_;
  actuator::Segment last_;
};

double within_reach(double from_rad, double to_rad) noexcept {
  return std::clamp(to_rad, from_rad - kReach_rad, from_rad + kReach_rad);
}

}  // namespace

void Unit::begin_step(UnitState& s, StepPlan& plan, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) const noexcept {
  const double dt = seconds(dt_ns);
  plan.t_ns = t_ns;
  plan.dt_ns = dt_ns;
  plan.in = in;
  plan.y = in.angle - 0.5 * dt * in.speed;
  if (!s.started) {
    actuator_.place(s.actuator, plan.y);
  } else {
    actuator_.settle(s.actuator, plan.y, s.applied_torque, plan.y - s.start_y, s.path_work);
  }
  const double other = s.started ? (in.speed - s.last_speed) / s.last_dt - in.inverse_inertia * s.applied_torque : 0.0;
  plan.c = 0.5 * dt * dt * in.inverse_inertia;
  plan.free = dt * in.speed + 0.5 * dt * dt * other;
  plan.dy = plan.free;
  if (s.started) {
    // τ̄ ≈ end torque − slope·dy: a light shaft behind a stiff spring moves far less than the last torque would throw it.
    const elastic::SegmentMean& end = s.actuator.end;
    const double yield = 1.0 / (1.0 + plan.c * std::max(end.slope.qq, 0.0));
    const double u = plan.y - s.actuator.shaft_anchor;
    plan.dy = drive::solve_friction(shaft_friction_, u, (plan.free + plan.c * end.torque) * yield, plan.c * yield).displacement;
  }
  plan.dy = within_reach(0, plan.dy);
  plan.walked_ns = 0;
  plan.held_count = 0;
  if (t_ns % kTickNs != 0) plan.held[plan.held_count++] = s.held;
}

firmware::TickInputs Unit::sample(UnitState& s, StepPlan& plan, std::int64_t at_ns) noexcept {
  const std::int64_t until = at_ns - plan.t_ns;
  if (until > 0 && plan.walked_ns == 0) plan.start = s.actuator;
  while (plan.walked_ns < until) {
    const std::int64_t h_ns = std::min(substep_ns_, until - plan.walked_ns);
    const double share = static_cast<double>(h_ns) / static_cast<double>(plan.dt_ns);
    actuator_.segment(s.actuator, seconds(h_ns), {plan.dy * share, s.held.voltage, s.held.terminal});
    plan.walked_ns += h_ns;
  }
  // What the host will do with the shaft if the prediction holds: q' = q + dt·v'.
  const double end_speed = 2.0 * plan.dy / seconds(plan.dt_ns) - plan.in.speed;
  return read_sensors(s, plan.in.angle + seconds(plan.walked_ns) * end_speed);
}

double Unit::step(UnitState& s, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) noexcept {
  StepPlan plan;
  begin_step(s, plan, t_ns, dt_ns, in);
  for (std::int64_t at = first_tick_ns(t_ns); at < t_ns + dt_ns; at += kTickNs) {
    const firmware::TickInputs sensors = sample(s, plan, at);
    out_.clear();
    if (s.faults.powered) program_.tick(s.program, sensors, at, out_);
    hold(s, plan);
  }
  return end_step(s, plan);
}

double Unit::end_step(UnitState& s, StepPlan& plan) noexcept {
  if (plan.walked_ns > 0) s.actuator = plan.start;
  const double c = plan.c, u = plan.y - s.actuator.shaft_anchor;
  double dy = plan.dy;
  PathTrials trials(actuator_, s.actuator, {plan.held.data(), plan.held_count}, {plan.t_ns, plan.dt_ns, substep_ns_});
  if (const auto foreseen = trials.foresee()) {
    const double yield = 1.0 / (1.0 + c * std::max(foreseen->slope, 0.0));
    const auto next = drive::solve_friction(shaft_friction_, u, (plan.free + c * foreseen->torque) * yield, c * yield);
    dy = within_reach(dy, next.displacement);
  }
  double low = -std::numeric_limits<double>::infinity(), high = -low, last_move = high;
  double torque = 0;
  actuator::SegmentResult path;
  double walked = dy;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    walked = dy;
    path = trials.at(walked, iteration == 0);
    // Newton on the spring, exact on the friction.
    const double slope = std::max(path.slope, 0.0);
    const double yield = 1.0 / (1.0 + c * slope);
    const auto next = drive::solve_friction(shaft_friction_, u, (plan.free + c * (path.torque + slope * dy)) * yield, c * yield);
    const double move = next.displacement - dy;
    torque = path.torque - slope * move + next.torque;
    // The linear correction leaves an error of second order; the stiffer the step (c·slope), the more of it reaches the shaft.
    const bool near =
        std::abs(slope * move) <= yield * yield * (kRelativeTolerance * std::abs(path.torque) + kAbsoluteTolerance_Nm);
    if (near && path.settled) break;
    // The residual grows with dy, so its sign brackets the root; a hardening spring throws Newton out, bisection calls it back.
    if (path.settled) (move > 0 ? low : high) = dy;
    const bool inside = next.displacement > low && next.displacement < high;
    const bool shrinking = std::abs(move) < 0.7 * last_move;
    last_move = std::abs(move);
    const bool bracketed = std::isfinite(low) && std::isfinite(high);
    if (bracketed)
      dy = inside && shrinking ? next.displacement : 0.5 * (low + high);
    else
      dy = within_reach(dy, next.displacement);
    if (!std::isfinite(dy)) break;
  }
  trials.finish();
  const double spring_work = path.torque * walked;
  const auto rub = actuator_.shaft_friction(s.actuator, walked);
  s.path_work = s.actuator.ledger.pending = spring_work + rub.torque * walked;
  s.start_y = plan.y;
  s.applied_torque = torque;
  s.last_speed = plan.in.speed;
  s.last_dt = seconds(plan.dt_ns);
  s.started = true;
  return torque;
}

}  // namespace vsa::device
