// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "device/numbers.hpp"
#include "device/unit_lanes.hpp"
#include "device/widest.hpp"

namespace vsa::device {
namespace {

using firmware::kTickNs;

std::array<double, 2> gone(const actuator::ActuatorState& from, const actuator::ActuatorState& to) noexcept {
  return {to.motor[0].angle - from.motor[0].angle, to.motor[1].angle - from.motor[1].angle};
}

/// A joint alone whose step has several segments.
struct Alone {
  Unit& unit;
  UnitState& state;
  StepPlan& plan;
  double free, last_torque;
  [[nodiscard]] double dy() const noexcept { return plan.dy; }
  [[nodiscard]] ShaftTorque foresee(double at) const noexcept { return unit.expect(state, plan, at); }
  ShaftTorque attempt(double at, bool rough, bool which) const noexcept {
    return which ? unit.attempt(state, plan, at, rough) : ShaftTorque{};
  }
  [[nodiscard]] ShaftTorque carried(double move) const noexcept { return unit.carried(state, plan, move); }
  [[nodiscard]] bool has_edge() const noexcept { return unit.has_edge(plan); }
};

}  // namespace

bool Unit::has_edge(const StepPlan& plan) const noexcept { return steps<double>().has_edge(plan, seconds(plan.dt_ns)); }

// A step is many small functions, and calls between them cost a tenth of it: each of these is one piece.
[[gnu::flatten]] actuator::Lead Unit::set_out(UnitState& s, StepPlan& plan) const noexcept {
  const ShaftIn& in = plan.in;
  const double dt = seconds(plan.dt_ns);
  if (s.started && !in.placed) {
    steps<double>().begin(s, plan, dt);
  } else {
    plan.y = in.angle - 0.5 * dt * in.speed;
    plan.free = plan.dy = dt * in.speed;
    if (std::isfinite(in.free_acceleration)) plan.free += 0.5 * dt * dt * in.free_acceleration;
    plan.last_torque = 0;
    s.started ? actuator_.relocate(s.actuator, plan.y) : actuator_.place(s.actuator, plan.y);
  }
  actuator::Lead lead = steps<double>().look_ahead(s, plan, dt);
  if (!plan.whole) lead.motors = plan.lead.motors = lead.spring * actuator::motor_weight(actuator_.swing_squared(s.actuator, dt));
  return lead;
}

void Unit::begin_step(UnitState& s, StepPlan& plan, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) const noexcept {
  plan.t_ns = t_ns;
  plan.dt_ns = dt_ns;
  plan.whole = whole(t_ns, dt_ns);
  plan.in = in;
  plan.dy = seconds(dt_ns) * in.speed;
  // The actuator of a whole step sets out with the trials: no tick sees it on its way.
  if (!plan.whole) set_out(s, plan);
  plan.ticked = false;
  plan.walked_ns = 0;
  plan.held_count = 0;
  if (t_ns % kTickNs != 0) plan.held[plan.held_count++] = s.held;
}

std::int64_t Unit::segment_ns(std::int64_t t_ns, std::int64_t dt_ns, std::int64_t walked) const noexcept {
  return std::min({substep_ns_, kTickNs - (t_ns + walked) % kTickNs, dt_ns - walked});
}

/// Where the shaft is at the tick, as foreseen.
double Unit::walk(UnitState& s, StepPlan& plan, std::int64_t at_ns) noexcept {
  const std::int64_t until = at_ns - plan.t_ns;
  if (until <= 0) return plan.in.angle;
  if (plan.walked_ns == 0) plan.start = s.actuator;
  const double whole = static_cast<double>(plan.dt_ns);
  while (plan.walked_ns < until) {
    const std::int64_t h_ns = std::min(substep_ns_, until - plan.walked_ns);
    actuator::SegmentInput in{0.0, s.held.voltage, s.held.terminal, plan.lead, s.held.supply_V};
    in.lead.before = static_cast<double>(plan.walked_ns) / whole;
    in.lead.share = static_cast<double>(h_ns) / whole;
    in.dq = plan.dy * in.lead.share;
    in.lead.gone = gone(plan.start, s.actuator);
    actuator_.segment(s.actuator, seconds(h_ns), in);
    plan.walked_ns += h_ns;
  }
  // What the host will do with the shaft if the prediction holds: q' = q + dt·v'.
  const double end_speed = 2.0 * plan.dy / seconds(plan.dt_ns) - plan.in.speed;
  return plan.in.angle + seconds(plan.walked_ns) * end_speed;
}

firmware::TickInputs Unit::sample(UnitState& s, StepPlan& plan, std::int64_t at_ns) noexcept {
  return read_sensors(s, walk(s, plan, at_ns));
}

double Unit::step(UnitState& s, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) noexcept {
  StepPlan& plan = plan_;
  begin_step(s, plan, t_ns, dt_ns, in);
  if (first_tick_ns(t_ns + 1) < t_ns + dt_ns) {
    Alone joint{*this, s, plan, plan.free, plan.last_torque};
    plan.dy = s.started ? AloneSolver<double, Alone>().predict(joint, coupled_inertia(in.inverse_inertia, seconds(dt_ns)))
                        : std::clamp(plan.free, -solver::kReach_rad, solver::kReach_rad);
  }
  for (std::int64_t at = first_tick_ns(t_ns); at < t_ns + dt_ns; at += kTickNs) {
    if (servo_) {
      run_servo(s, plan, at);
      continue;
    }
    const firmware::TickInputs sensors = sample(s, plan, at);
    out_.clear();
    if (s.faults.powered) program_.tick(s.program, sensors, at, out_);
    hold(s, plan);
  }
  return end_step(s, plan);
}

bool Unit::whole(std::int64_t t_ns, std::int64_t dt_ns) const noexcept { return segment_ns(t_ns, dt_ns, 0) == dt_ns; }

void Unit::tick(UnitState& s, std::int64_t t_ns, double shaft_rad) noexcept {
  if (servo_) return tick_servo(s, shaft_rad);
  const firmware::TickInputs sensors = read_sensors(s, shaft_rad);
  out_.clear();
  if (s.faults.powered) program_.tick(s.program, sensors, t_ns, out_);
  drive_bridges(s);
}

double Unit::step_held(UnitState& s, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) noexcept {
  StepPlan& plan = plan_;
  begin_step(s, plan, t_ns, dt_ns, in);
  plan.held_count = 0;
  plan.held[plan.held_count++] = s.held;
  return end_step(s, plan);
}

/// The usual step, all of it in one function.
[[gnu::flatten]] double Unit::end_whole(UnitState& s, StepPlan& plan) noexcept {
  const auto step = [&] {
    double torque = 0;
    begin_trials(s, plan);
    settled_ = solve_whole<double>(steps<double>(), s, plan, seconds(plan.dt_ns), torque);
    s.started = true;
    return torque;
  };
  return kHasAvx512 ? widest(step) : step();
}

double Unit::end_step(UnitState& s, StepPlan& plan) noexcept {
  if (plan.whole) return end_whole(s, plan);
  begin_trials(s, plan);
  Alone joint{*this, s, plan, plan.free, plan.last_torque};
  AloneSolver<double, Alone> solver;
  settled_ = solver.solve(joint, coupled_inertia(plan.in.inverse_inertia, seconds(plan.dt_ns)));
  finish(s, plan, solver.move(), solver.torque);
  return solver.torque;
}

ShaftTorque Unit::expect(const UnitState& s, const StepPlan& plan, double dy) const noexcept {
  const drive::FrictionTorque rub = steps<double>().shaft_rub(s, plan, dy);
  // Where a light shaft stands behind a stiff spring, it moves far less than the last torque would throw it.
  const elastic::SegmentMean& end = s.actuator.end;
  const actuator::Rub& tendons = s.actuator.end_rub;
  const double spring = end.slope.qq - tendons.dx[0] - tendons.dx[1];
  const double slope = std::max(spring * (1.0 + 3.0 * plan.lead.spring) + tendons.dy[0] + tendons.dy[1], 0.0);
  const double shift = -2.0 * plan.lead.spring * plan.lead.drift;
  return {end.torque - spring * shift - slope * dy + rub.torque, slope + rub.slope};
}

[[gnu::flatten]] void Unit::begin_trials(UnitState& s, StepPlan& plan) noexcept {
  if (plan.walked_ns > 0) {
    s.actuator = plan.start;
  } else if (!plan.whole) {
    plan.start = s.actuator;
  }
  plan.tried = false;
  if (!plan.whole) return;
  const Held& held = plan.held[0];
  const actuator::SegmentInput in{0.0, held.voltage, held.terminal, set_out(s, plan), held.supply_V};
  actuator_.begin(s.actuator, plan.last, seconds(plan.dt_ns), in);
}

[[gnu::flatten]] ShaftTorque Unit::foresee(const UnitState& s, StepPlan& plan, double dy) const noexcept {
  if (!plan.whole) return expect(s, plan, dy);
  return steps<double>().foresee(s, plan, dy);
}

[[gnu::flatten]] ShaftTorque Unit::attempt(UnitState& s, StepPlan& plan, double dy, bool rough) noexcept {
  if (plan.whole) return steps<double>().attempt(s, plan, dy, rough, true);
  const drive::FrictionTorque rub = plan.rub = steps<double>().shaft_rub(s, plan, dy);
  const double before_Nm = plan.path.torque, moved = dy - plan.dy;
  plan.dy = dy;
  s.actuator = plan.start;
  plan.path = {};
  std::size_t interval = 0;
  for (std::int64_t now = 0;;) {
    const std::int64_t h = segment_ns(plan.t_ns, plan.dt_ns, now);
    const double share = seconds(h) / seconds(plan.dt_ns);
    actuator::SegmentInput in{dy * share, plan.held[interval].voltage, plan.held[interval].terminal, plan.lead,
                              plan.held[interval].supply_V};
    in.lead.before = seconds(now) / seconds(plan.dt_ns);
    in.lead.share = share;
    in.lead.gone = gone(plan.start, s.actuator);
    actuator_.begin(s.actuator, plan.last, seconds(h), in);
    const actuator::SegmentResult r = actuator_.attempt(s.actuator, plan.last, in.dq);
    plan.path.torque += r.torque * share;
    plan.path.slope += r.slope * share;
    now += h;
    if (now == plan.dt_ns) break;
    actuator_.finish(s.actuator, plan.last);
    if ((plan.t_ns + now) % kTickNs == 0) ++interval;
  }
  // A segment's slope knows nothing of what the motors did in those before; where that counts, two trials tell it.
  const double secant = (before_Nm - plan.path.torque) / moved;
  const bool far = std::abs(plan.path.slope * moved) > 1e-9 * std::abs(before_Nm);  // else rounding is all there is
  if (plan.tried && plan.lead.motors > 0 && far && std::isfinite(secant)) plan.path.slope = secant;
  plan.tried = true;
  return {plan.path.torque + rub.torque, std::max(plan.path.slope, 0.0) + rub.slope, plan.path.settled};
}

[[gnu::flatten]] ShaftTorque Unit::carried(const UnitState& s, const StepPlan& plan, double move) const noexcept {
  return steps<double>().carried(s, plan, move, seconds(plan.dt_ns));
}

bool Unit::may_go_beside(const UnitState& s, const StepPlan& plan) const noexcept {
  constexpr auto kDriven = drive::Terminal::driven;
  return plan.whole && s.started && !plan.in.placed && plan.held[0].terminal == std::array{kDriven, kDriven};
}

[[gnu::flatten]] void Unit::finish(UnitState& s, StepPlan& plan, double move, double torque) noexcept {
  steps<double>().finish(s, plan, move, torque, seconds(plan.dt_ns));
  s.started = true;
}

}  // namespace vsa::device
