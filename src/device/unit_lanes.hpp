// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The physics of a unit's host step of one segment, and the solution of a joint alone, for one unit or several side by side
// (vsa/lanes.hpp). `State` and `Plan` are UnitState and StepPlan, or what has those of their members that count here, in lanes.
#pragma once

#include "vsa/actuator/actuator_lanes.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::device {

template <class T>
struct UnitPhysics {
  const actuator::Actuator& actuator;
  const drive::Friction& shaft_friction;
  const drive::Friction& tendon;

  /// A step begins where the host put the shaft after the last one.
  template <class State, class Plan>
  void begin(State& s, Plan& plan, double dt_s) const noexcept {
    plan.y = plan.in.angle - 0.5 * dt_s * plan.in.speed;
    plan.free = plan.dy = dt_s * plan.in.speed;
    actuator.settle(s.actuator, plan.y, s.applied_torque, plan.y - s.start_y, s.path_work);
    // All else that moved the joint in the last step goes on, a_other dt²/2 = dt²/2·Δv/dt_last − Σ C τ_last; or the host knows.
    const T told = plan.in.free_acceleration, goes_on = 0.5 * dt_s * dt_s * (plan.in.speed - s.last_speed) / s.last_dt;
    plan.free += lanes::select(told == told, 0.5 * dt_s * dt_s * told, goes_on);
    plan.last_torque = s.applied_torque;
  }

  /// Returned, too: what was stored just now can't be copied as fast as what is still known.
  template <class State, class Plan>
  actuator::LeadOf<T> look_ahead(State& s, Plan& plan, double dt_s) const noexcept {
    actuator::LeadOf<T> lead;
    const T scale = dt_s * dt_s * plan.in.inverse_inertia;
    const elastic::TangentOf<T> tangent = actuator.tangent(s.actuator);
    lead.drift = 0.5 * dt_s * plan.in.speed;
    const T x_squared = scale * tangent.stiffness;
    const auto beyond = [&](double limit) { return (x_squared > limit) & (s.unresolved <= limit); };
    s.unresolved = lanes::select(beyond(kHardlyResolved) | beyond(kUnresolved), x_squared, s.unresolved);
    lead.spring = actuator::lead_weight(x_squared);
    for (std::size_t i = 0; i < 2; ++i)
      lead.tendon[i] = actuator::lead_weight(scale * tendon.stiffness * tangent.tension[i] * tangent.tension[i]);
    plan.shaft_weight = actuator::lead_weight(scale * shaft_friction.stiffness);
    plan.lead = lead;
    return lead;
  }

  template <class State, class Plan>
  [[nodiscard]] drive::FrictionTorqueOf<T> shaft_rub(const State& s, const Plan& plan, T dy) const noexcept {
    return drive::leading_friction(shaft_friction, plan.y - s.actuator.shaft_anchor, dy, plan.lead.drift, plan.shaft_weight);
  }

  template <class State, class Plan>
  [[nodiscard]] ShaftTorqueOf<T> foresee(const State& s, Plan& plan, T dy) const noexcept {
    const drive::FrictionTorqueOf<T> rub = shaft_rub(s, plan, dy);
    const actuator::SegmentResultOf<T> r = actuator.foresee(s.actuator, plan.last);
    const T slope = lanes::max(r.slope, 0.0);
    return {r.torque - slope * dy + rub.torque, slope + rub.slope};
  }

  template <class State, class Plan>
  ShaftTorqueOf<T> attempt(const State& s, Plan& plan, T dy, bool rough, lanes::Truth<T> which) const noexcept {
    const drive::FrictionTorqueOf<T> rub = shaft_rub(s, plan, dy);
    const actuator::SegmentResultOf<T> path = actuator.attempt(s.actuator, plan.last, dy, rough, which);
    plan.dy = lanes::select(which, dy, plan.dy);
    plan.rub = {lanes::select(which, rub.torque, plan.rub.torque), lanes::select(which, rub.slope, plan.rub.slope)};
    plan.path.torque = lanes::select(which, path.torque, plan.path.torque);
    plan.path.slope = lanes::select(which, path.slope, plan.path.slope);
    plan.path.straight = lanes::select(which, path.straight, plan.path.straight);
    plan.path.settled = lanes::select(which, path.settled, plan.path.settled);
    return {path.torque + rub.torque, lanes::max(path.slope, 0.0) + rub.slope, path.settled};
  }

  template <class State, class Plan>
  [[nodiscard]] ShaftTorqueOf<T> carried(const State& s, const Plan& plan, T move, double dt_s) const noexcept {
    constexpr double kRelativeTolerance = 1e-4, kAbsoluteTolerance_Nm = 1e-6, kLeastYield = 1e-2;
    const drive::FrictionTorqueOf<T>& before = plan.rub;
    const drive::FrictionTorqueOf<T> after = shaft_rub(s, plan, plan.dy + move);
    const T c = 0.5 * dt_s * dt_s * plan.in.inverse_inertia, slope = lanes::max(plan.path.slope, 0.0);
    const T change = plan.path.slope * move, yield = lanes::max(T(kLeastYield), 1.0 / (1.0 + c * slope));
    const T slack = kRelativeTolerance * lanes::abs(plan.path.torque) + kAbsoluteTolerance_Nm;
    // The linear correction leaves an error of second order; the stiffer the step (c·slope), the more of it reaches the shaft.
    const lanes::Truth<T> straight =
        (lanes::abs(move) <= yield * plan.path.straight) | (lanes::abs(change) <= yield * yield * slack);
    const lanes::Truth<T> near =
        plan.path.settled & straight & (lanes::abs(after.torque - before.torque + before.slope * move) <= slack);
    return {plan.path.torque - change + after.torque, slope + after.slope, near};
  }

  template <class Plan>
  [[nodiscard]] lanes::Truth<T> has_edge(const Plan& plan, double dt_s) const noexcept {
    return T(shaft_friction.stiffness) * (dt_s * dt_s * plan.in.inverse_inertia) > kEdge;
  }

  template <class State, class Plan>
  void finish(State& s, Plan& plan, T move, T torque, double dt_s) const noexcept {
    actuator.finish(s.actuator, plan.last);
    const T spring_work = plan.path.torque * plan.dy;
    const auto rub = actuator.shaft_friction(s.actuator, plan.dy, plan.lead.drift, plan.shaft_weight);
    s.path_work = s.actuator.ledger.pending = spring_work + rub.torque * plan.dy;
    s.start_y = plan.y;
    s.applied_torque = torque;
    s.last_speed = plan.in.speed;
    s.last_dt = dt_s;
    s.reached.speed = 2.0 * (plan.dy + move) / dt_s - plan.in.speed;
    s.reached.angle = plan.in.angle + dt_s * s.reached.speed;
  }
};

/// Solves a joint alone (device/joint_solver.hpp with n = 1), of one unit or of several side by side, each for itself.
/// `Joint`: free, last_torque; dy() of its last attempt; foresee(dy), attempt(dy, rough, which), carried(move) → ShaftTorqueOf<T>;
/// has_edge() (Unit::has_edge).
template <class T, class Joint>
class AloneSolver {
  using Truth = lanes::Truth<T>;

 public:
  /// `inertia`: 2/dt²/B, 0 where somebody else moves the shaft. Returns who settled.
  Truth solve(Joint& joint, T inertia) noexcept {
    joint_ = &joint;
    inertia_ = inertia;
    const Truth led = !(inertia != 0.0);  // by somebody else
    if (lanes::all(led)) {
      lead(led);
      return led;
    }
    set_out_free();
    if (lanes::any(led)) lead(led);
    Truth settled = search(!led) | led;
    if (!lanes::all(settled)) settled = settled | stay(!settled);
    if (!lanes::all(settled)) settled = settled | close_in(joint_->has_edge() & !settled);
    return lanes::all(settled) ? settled : settled | stay(!settled);
  }
  /// A first Δy, from what the last steps left.
  T predict(Joint& joint, T inertia) noexcept {
    joint_ = &joint;
    inertia_ = inertia;
    set_out_free();
    return dy_;
  }
  T torque = 0.0;                                                               ///< what acts
  [[nodiscard]] T move() const noexcept { return dy_ - joint_->dy() + move_; }  ///< from the last attempt

 private:
  void set_out_free() noexcept {
    dy_ = lanes::clamp(joint_->free, -T(solver::kReach_rad), solver::kReach_rad);
    take(joint_->foresee(dy_), lanes::truth<T>(true));
    guess();
  }
  void lead(Truth which) noexcept {
    dy_ = lanes::select(which, joint_->free, dy_);
    move_ = lanes::select(which, T(0.0), move_);
    torque = lanes::select(which, joint_->attempt(dy_, false, which).torque, torque);
  }
  void take(const ShaftTorqueOf<T>& t, Truth which) noexcept {
    torque_ = lanes::select(which, t.torque, torque_);
    slope_ = lanes::select(which, t.slope, slope_);
  }
  [[nodiscard]] T gradient() const noexcept { return joint_->last_torque - torque_ + inertia_ * (dy_ - joint_->free); }
  void attempt(bool rough, Truth which) noexcept {
    take(joint_->attempt(dy_, rough, which), which);
    gradient_ = lanes::select(which, gradient(), gradient_);
  }
  /// 1/(C⁻¹ + S) where that is positive and finite.
  Truth factor(Truth which) noexcept {
    const T pivot = inertia_ + slope_;
    const Truth good = (pivot > 0.0) & (pivot < std::numeric_limits<double>::infinity());
    factor_ = lanes::select(which, lanes::select(good, 1.0 / pivot, pivot), factor_);
    return good;
  }
  void newton(Truth which) noexcept { move_ = lanes::select(which, -gradient_ * factor_, move_); }
  /// Where move_ may be the last; the torque that it leads to.
  Truth near(Truth which) noexcept {
    const ShaftTorqueOf<T> t = joint_->carried(dy_ - joint_->dy() + move_);
    carried_ = {lanes::select(which, t.torque, carried_.torque), lanes::select(which, t.slope, carried_.slope),
                lanes::select(which, t.settled, carried_.settled)};
    torque = lanes::select(which, t.torque, torque);
    return t.settled;
  }
  /// Newton's way from the last attempt; how long it may be, and the slope along it where it begins.
  void set_out(Truth which) noexcept {
    const T farthest = lanes::abs(move_);
    part_ = lanes::select(which, lanes::select(farthest > solver::kReach_rad, solver::kReach_rad / farthest, T(1.0)), part_);
    dy_ = lanes::select(which, dy_ + part_ * move_, dy_);
    descent_ = lanes::select(which, move_ * gradient_, descent_);
  }
  /// dy_ := a linear step from where the joint would go without new torques, with what torque_ and slope_ tell of there.
  void guess() noexcept {
    gradient_ = gradient();
    const Truth good = factor(lanes::truth<T>(true));
    const T step = -gradient_ * factor_;  // not by way of move_: a number that was just stored comes late
    dy_ = lanes::select(good, lanes::clamp(dy_ + step, -T(solver::kReach_rad), solver::kReach_rad), dy_);
  }
  /// As near as it came: what is left may be little all the same.
  Truth stay(Truth which) noexcept {
    move_ = lanes::select(which, T(0.0), move_);
    attempt(false, which);
    near(which);
    return which & (lanes::abs(gradient_) <= solver::kLeft * lanes::abs(torque_) + solver::kLeft_Nm);
  }
  Truth search(Truth all) noexcept;
  Truth close_in(Truth all) noexcept;

  Joint* joint_ = nullptr;
  T inertia_ = 0.0, dy_ = 0.0, move_ = 0.0, gradient_ = 0.0, torque_ = 0.0, slope_ = 0.0, factor_ = 0.0, part_ = 1.0,
    descent_ = 0.0;
  ShaftTorqueOf<T> carried_;
};

template <class T, class Joint>
lanes::Truth<T> AloneSolver<T, Joint>::search(Truth goes_on) noexcept {
  attempt(true, goes_on);
  goes_on = goes_on & factor(goes_on);
  newton(goes_on);
  Truth settled = goes_on & near(goes_on);
  goes_on = goes_on & !settled;
  if (!lanes::any(goes_on)) return settled;
  set_out(goes_on);
  Truth some = lanes::truth<T>(true);  // may take what `carried` foretold
  for (int iteration = 1; iteration < solver::kMaxIterations && lanes::any(goes_on); ++iteration) {
    const Truth foretold = goes_on & some & carried_.settled, tries = goes_on & !foretold;
    if (lanes::any(tries)) attempt(false, tries);
    take(carried_, foretold);
    gradient_ = lanes::select(goes_on, gradient(), gradient_);
    const T now = move_ * gradient_;
    const double overshoot = iteration < solver::kEarly ? solver::kOvershoot : solver::kOvershootLater;
    const Truth too_far = goes_on & !(now <= -overshoot * descent_);
    const Truth again = too_far & some, shorter = too_far & !some;
    if (lanes::any(again)) {
      // A friction's edge may lie between what a unit foretold and what it finds there: from here on with all that it finds.
      attempt(false, again);
      some = some & !again;
    }
    if (lanes::any(shorter)) {
      const T less = part_ * lanes::clamp(descent_ / (descent_ - now), 0.1, 0.9);
      const Truth finite = lanes::abs(less) < std::numeric_limits<double>::infinity();
      const T back = lanes::select(finite, less - part_, -0.75 * part_);
      dy_ = lanes::select(shorter, dy_ + back * move_, dy_);
      part_ = lanes::select(shorter, part_ + back, part_);
    }
    Truth forward = goes_on & !shorter;
    const Truth good = factor(forward);
    goes_on = goes_on & (shorter | good);
    forward = forward & good;
    newton(forward);
    const Truth found = forward & near(forward);
    settled = settled | found;
    goes_on = goes_on & !found;
    forward = forward & !found;
    set_out(forward);
    some = some & ((part_ == 1.0) | !forward);
  }
  return settled;
}

/// Where the shaft's friction keeps Newton going to and fro over its edge: Newton between two Δy of which one lies too far, else
/// their middle. The torque falls with Δy, so from anywhere the other end is no farther than what acts there would move the joint by
/// itself.
template <class T, class Joint>
lanes::Truth<T> AloneSolver<T, Joint>::close_in(Truth goes_on) noexcept {
  const auto reached = [](T dy) { return lanes::clamp(dy, -T(solver::kReach_rad), solver::kReach_rad); };
  dy_ = lanes::select(goes_on, reached(joint_->free), dy_);
  attempt(false, goes_on);
  T low = dy_, high = dy_, before = std::numeric_limits<double>::infinity();
  const T end = reached(dy_ - gradient_ / inertia_);
  low = lanes::select(gradient_ < 0.0, low, end);
  high = lanes::select(gradient_ < 0.0, end, high);
  Truth settled = lanes::truth<T>(false);
  for (int k = 0; k < solver::kMaxHalvings; ++k) {
    goes_on = goes_on & factor(goes_on);
    newton(goes_on);
    const Truth found = goes_on & near(goes_on);
    settled = settled | found;
    goes_on = goes_on & !found;
    if (!lanes::any(goes_on)) break;
    const T tangent = dy_ + move_, now = lanes::abs(gradient_);
    const Truth newtons = (tangent > low) & (tangent < high) & (now <= 0.5 * before);
    before = now;
    dy_ = lanes::select(goes_on, lanes::select(newtons, tangent, 0.5 * (low + high)), dy_);
    attempt(false, goes_on);
    low = lanes::select(goes_on & (gradient_ < 0.0), dy_, low);
    high = lanes::select(goes_on & (gradient_ > 0.0), dy_, high);
  }
  return settled;
}

/// 2/dt²/B; 0 where somebody else moves the shaft.
template <class T>
[[nodiscard]] T coupled_inertia(T b, double dt) noexcept {
  const lanes::Truth<T> coupled = (b > 0.0) & (b < std::numeric_limits<double>::infinity());
  return lanes::where<T>(coupled, 2.0 / (dt * dt) / b);
}

/// A step of one segment, of joints alone, from where its trials have begun.
template <class T, class State, class Plan>
lanes::Truth<T> solve_whole(const UnitPhysics<T>& physics, State& state, Plan& step, double dt, T& torque) noexcept {
  struct Joint {
    const UnitPhysics<T>& p;
    const State& s;
    Plan& plan;
    double dt_s;
    T free, last_torque;
    [[nodiscard]] T dy() const noexcept { return plan.dy; }
    [[nodiscard]] ShaftTorqueOf<T> foresee(T at) const noexcept { return p.foresee(s, plan, at); }
    ShaftTorqueOf<T> attempt(T at, bool rough, lanes::Truth<T> which) const noexcept {
      return p.attempt(s, plan, at, rough, which);
    }
    [[nodiscard]] ShaftTorqueOf<T> carried(T move) const noexcept { return p.carried(s, plan, move, dt_s); }
    [[nodiscard]] lanes::Truth<T> has_edge() const noexcept { return p.has_edge(plan, dt_s); }
  } joint{physics, state, step, dt, step.free, step.last_torque};
  AloneSolver<T, Joint> solver;
  const auto settled = solver.solve(joint, coupled_inertia<T>(step.in.inverse_inertia, dt));
  torque = solver.torque;
  physics.finish(state, step, solver.move(), torque, dt);
  return settled;
}

template <class T>
UnitPhysics<T> Unit::steps() const noexcept {
  return {actuator_, shaft_friction_, tendon_};
}

}  // namespace vsa::device
