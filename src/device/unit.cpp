// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/unit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vsa::device {
namespace {

using firmware::kTickNs;

constexpr double kRelativeTolerance = 1e-4;
constexpr double kAbsoluteTolerance_Nm = 1e-6;
constexpr double kLeastYield = 1e-2;

double seconds(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }

}  // namespace

void Unit::begin_step(UnitState& s, StepPlan& plan, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) const noexcept {
  const double dt = seconds(dt_ns);
  plan.t_ns = t_ns;
  plan.dt_ns = dt_ns;
  plan.whole = segment_ns(plan, 0) == dt_ns;
  plan.in = in;
  plan.y = in.angle - 0.5 * dt * in.speed;
  plan.free = plan.dy = dt * in.speed;
  plan.last_torque = 0;
  if (!s.started) {
    actuator_.place(s.actuator, plan.y);
  } else if (in.placed) {
    actuator_.relocate(s.actuator, plan.y);
  } else {
    actuator_.settle(s.actuator, plan.y, s.applied_torque, plan.y - s.start_y, s.path_work);
    // All else that moved the joint in the last step goes on: a_other dt²/2 = dt²/2·Δv/dt_last − Σ C τ_last.
    plan.free += 0.5 * dt * dt * (in.speed - s.last_speed) / s.last_dt;
    plan.last_torque = s.applied_torque;
  }
  look_ahead(s, plan, dt);
  plan.walked_ns = 0;
  plan.held_count = 0;
  if (t_ns % kTickNs != 0) plan.held[plan.held_count++] = s.held;
}

void Unit::look_ahead(UnitState& s, StepPlan& plan, double dt) const noexcept {
  const double scale = dt * dt * plan.in.inverse_inertia;
  const elastic::Tangent tangent = config_.actuator.transmission->tangent_of(s.actuator.origin);
  plan.lead.drift = 0.5 * dt * plan.in.speed;
  const double x_squared = scale * tangent.stiffness;
  if (x_squared > 1.0 && s.unresolved == 0.0) s.unresolved = x_squared;
  plan.lead.spring = actuator::lead_weight(x_squared);
  for (std::size_t i = 0; i < 2; ++i)
    plan.lead.tendon[i] = actuator::lead_weight(scale * tendon_.stiffness * tangent.tension[i] * tangent.tension[i]);
  plan.shaft_weight = actuator::lead_weight(scale * shaft_friction_.stiffness);
}

std::int64_t Unit::segment_ns(const StepPlan& plan, std::int64_t walked) const noexcept {
  return std::min({substep_ns_, kTickNs - (plan.t_ns + walked) % kTickNs, plan.dt_ns - walked});
}

firmware::TickInputs Unit::sample(UnitState& s, StepPlan& plan, std::int64_t at_ns) noexcept {
  const std::int64_t until = at_ns - plan.t_ns;
  if (until > 0 && plan.walked_ns == 0) plan.start = s.actuator;
  const double whole = static_cast<double>(plan.dt_ns);
  while (plan.walked_ns < until) {
    const std::int64_t h_ns = std::min(substep_ns_, until - plan.walked_ns);
    actuator::SegmentInput in{0.0, s.held.voltage, s.held.terminal, plan.lead, s.held.supply_V};
    in.lead.before = static_cast<double>(plan.walked_ns) / whole;
    in.lead.share = static_cast<double>(h_ns) / whole;
    in.dq = plan.dy * in.lead.share;
    actuator_.segment(s.actuator, seconds(h_ns), in);
    plan.walked_ns += h_ns;
  }
  // What the host will do with the shaft if the prediction holds: q' = q + dt·v'.
  const double end_speed = 2.0 * plan.dy / seconds(plan.dt_ns) - plan.in.speed;
  return read_sensors(s, plan.in.angle + seconds(plan.walked_ns) * end_speed);
}

double Unit::step(UnitState& s, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) noexcept {
  StepPlan plan;
  begin_step(s, plan, t_ns, dt_ns, in);
  const JointInStep joint{this, &s, &plan};
  alone_.set({&in.inverse_inertia, 1}, dt_ns);
  if (first_tick_ns(t_ns + 1) < t_ns + dt_ns) alone_.predict({&joint, 1});
  for (std::int64_t at = first_tick_ns(t_ns); at < t_ns + dt_ns; at += kTickNs) {
    const firmware::TickInputs sensors = sample(s, plan, at);
    out_.clear();
    if (s.faults.powered) program_.tick(s.program, sensors, at, out_);
    hold(s, plan);
  }
  return end_step(s, plan);
}

double Unit::end_step(UnitState& s, StepPlan& plan) noexcept {
  const JointInStep joint{this, &s, &plan};
  double torque = 0;
  alone_.set({&plan.in.inverse_inertia, 1}, plan.dt_ns);
  alone_.solve({&joint, 1}, {&torque, 1});
  return torque;
}

drive::FrictionTorque Unit::shaft_rub(const UnitState& s, const StepPlan& plan, double dy) const noexcept {
  return drive::leading_friction(shaft_friction_, plan.y - s.actuator.shaft_anchor, dy, plan.lead.drift, plan.shaft_weight);
}

ShaftTorque Unit::expect(const UnitState& s, const StepPlan& plan, double dy) const noexcept {
  const drive::FrictionTorque rub = shaft_rub(s, plan, dy);
  // Where a light shaft stands behind a stiff spring, it moves far less than the last torque would throw it.
  const elastic::SegmentMean& end = s.actuator.end;
  const actuator::Rub& tendons = s.actuator.end_rub;
  const double spring = end.slope.qq - tendons.dx[0] - tendons.dx[1];
  const double slope = std::max(spring * (1.0 + 3.0 * plan.lead.spring) + tendons.dy[0] + tendons.dy[1], 0.0);
  const double shift = -2.0 * plan.lead.spring * plan.lead.drift;
  return {end.torque - spring * shift - slope * dy + rub.torque, slope + rub.slope};
}

void Unit::begin_trials(UnitState& s, StepPlan& plan) noexcept {
  if (plan.walked_ns > 0) {
    s.actuator = plan.start;
  } else if (!plan.whole) {
    plan.start = s.actuator;
  }
  if (plan.whole)
    actuator_.begin(s.actuator, plan.last, seconds(plan.dt_ns),
                    {0.0, plan.held[0].voltage, plan.held[0].terminal, plan.lead, plan.held[0].supply_V});
}

ShaftTorque Unit::foresee(const UnitState& s, StepPlan& plan, double dy) const noexcept {
  if (!plan.whole) return expect(s, plan, dy);
  const drive::FrictionTorque rub = shaft_rub(s, plan, dy);
  const actuator::SegmentResult r = actuator_.foresee(s.actuator, plan.last);
  const double slope = std::max(r.slope, 0.0);
  return {r.torque - slope * dy + rub.torque, slope + rub.slope};
}

ShaftTorque Unit::attempt(UnitState& s, StepPlan& plan, double dy, bool rough) noexcept {
  const drive::FrictionTorque rub = plan.rub = shaft_rub(s, plan, dy);
  plan.dy = dy;
  if (plan.whole) {
    plan.path = actuator_.attempt(s.actuator, plan.last, dy, rough);
  } else {
    s.actuator = plan.start;
    plan.path = {};
    std::size_t interval = 0;
    for (std::int64_t now = 0;;) {
      const std::int64_t h = segment_ns(plan, now);
      const double share = seconds(h) / seconds(plan.dt_ns);
      actuator::SegmentInput in{dy * share, plan.held[interval].voltage, plan.held[interval].terminal, plan.lead,
                                plan.held[interval].supply_V};
      in.lead.before = seconds(now) / seconds(plan.dt_ns);
      in.lead.share = share;
      actuator_.begin(s.actuator, plan.last, seconds(h), in);
      const actuator::SegmentResult r = actuator_.attempt(s.actuator, plan.last, in.dq);
      plan.path.torque += r.torque * share;
      plan.path.slope += r.slope * share;
      now += h;
      if (now == plan.dt_ns) break;
      actuator_.finish(s.actuator, plan.last);
      if ((plan.t_ns + now) % kTickNs == 0) ++interval;
    }
  }
  return {plan.path.torque + rub.torque, std::max(plan.path.slope, 0.0) + rub.slope, plan.path.settled};
}

ShaftTorque Unit::carried(const UnitState& s, const StepPlan& plan, double move) const noexcept {
  if (!plan.path.settled) return {0, 0, false};
  const drive::FrictionTorque &before = plan.rub, after = shaft_rub(s, plan, plan.dy + move);
  const double c = 0.5 * seconds(plan.dt_ns) * seconds(plan.dt_ns) * plan.in.inverse_inertia;
  const double change = plan.path.slope * move, yield = std::max(kLeastYield, 1.0 / (1.0 + c * std::max(plan.path.slope, 0.0)));
  const double slack = kRelativeTolerance * std::abs(plan.path.torque) + kAbsoluteTolerance_Nm;
  // The linear correction leaves an error of second order; the stiffer the step (c·slope), the more of it reaches the shaft.
  const bool straight = std::abs(move) <= yield * plan.path.straight || std::abs(change) <= yield * yield * slack;
  const bool near = straight && std::abs(after.torque - before.torque + before.slope * move) <= slack;
  return {plan.path.torque - change + after.torque, std::max(plan.path.slope, 0.0) + after.slope, near};
}

void Unit::finish(UnitState& s, StepPlan& plan, double move, double torque) noexcept {
  actuator_.finish(s.actuator, plan.last);
  const double spring_work = plan.path.torque * plan.dy;
  const auto rub = actuator_.shaft_friction(s.actuator, plan.dy, plan.lead.drift, plan.shaft_weight);
  s.path_work = s.actuator.ledger.pending = spring_work + rub.torque * plan.dy;
  s.start_y = plan.y;
  s.applied_torque = torque;
  s.last_speed = plan.in.speed;
  s.last_dt = seconds(plan.dt_ns);
  s.started = true;
  s.reached.speed = 2.0 * (plan.dy + move) / s.last_dt - plan.in.speed;
  s.reached.angle = plan.in.angle + s.last_dt * s.reached.speed;
}

}  // namespace vsa::device
